// libgpiod 1.6.
#include "gpiod_api.h"

#include <gpiod.hpp>

namespace tsuya::lab::gpiod_api {
namespace {

std::bitset<32> flags_of(const RequestSettings &settings) {
    std::bitset<32> flags;
    if (settings.active_low)
        flags |= gpiod::line_request::FLAG_ACTIVE_LOW;
    if (settings.output && settings.drive == Drive::open_drain)
        flags |= gpiod::line_request::FLAG_OPEN_DRAIN;
    if (settings.output && settings.drive == Drive::open_source)
        flags |= gpiod::line_request::FLAG_OPEN_SOURCE;
    switch (settings.bias) {
    case Bias::as_is:
        break;
    case Bias::disabled:
        flags |= gpiod::line_request::FLAG_BIAS_DISABLE;
        break;
    case Bias::pull_up:
        flags |= gpiod::line_request::FLAG_BIAS_PULL_UP;
        break;
    case Bias::pull_down:
        flags |= gpiod::line_request::FLAG_BIAS_PULL_DOWN;
        break;
    }
    return flags;
}

class RequestV1 final : public Request {
  public:
    RequestV1(const RequestSettings &settings, const std::string &consumer)
        : chip_(settings.path, gpiod::chip::OPEN_BY_PATH), line_(chip_.get_line(settings.offset)) {
        line_.request({consumer,
                       settings.output ? gpiod::line_request::DIRECTION_OUTPUT
                                       : gpiod::line_request::EVENT_BOTH_EDGES,
                       flags_of(settings)},
                      0);
    }
    void set(bool active) override { line_.set_value(active ? 1 : 0); }
    bool get() override { return line_.get_value() != 0; }
    int descriptor() override { return line_.event_get_fd(); }
    EdgeEvent read_edge() override {
        const gpiod::line_event event = line_.event_read();
        return {event.timestamp, event.event_type == gpiod::line_event::RISING_EDGE};
    }

  private:
    gpiod::chip chip_; // released with its last reference
    gpiod::line line_;
};

} // namespace

void need_library() {}

ChipInfo chip_info(const std::string &path) {
    const gpiod::chip chip(path, gpiod::chip::OPEN_BY_PATH);
    ChipInfo info{.label = chip.label()};
    for (unsigned offset = 0; offset < chip.num_lines(); ++offset) {
        const gpiod::line line = chip.get_line(offset);
        const std::string consumer = line.consumer();
        // The kernel holds some lines without a consumer's name.
        info.lines.push_back({.name = line.name(),
                              .consumer = consumer.empty() && line.is_used() ? "kernel" : consumer,
                              .output = line.direction() == gpiod::line::DIRECTION_OUTPUT});
    }
    return info;
}

std::unique_ptr<Request> request(const RequestSettings &settings, const std::string &consumer) {
    return std::make_unique<RequestV1>(settings, consumer);
}

} // namespace tsuya::lab::gpiod_api
