// libgpiod 2.
#include "gpiod_api.h"

#include <gpiod.hpp>

#include <system_error>

namespace tsuya::lab::gpiod_api {
namespace {

gpiod::line::drive drive_of(Drive drive) {
    switch (drive) {
    case Drive::push_pull:
        return gpiod::line::drive::PUSH_PULL;
    case Drive::open_drain:
        return gpiod::line::drive::OPEN_DRAIN;
    case Drive::open_source:
        return gpiod::line::drive::OPEN_SOURCE;
    }
    return gpiod::line::drive::PUSH_PULL;
}

gpiod::line::bias bias_of(Bias bias) {
    switch (bias) {
    case Bias::as_is:
        return gpiod::line::bias::AS_IS;
    case Bias::disabled:
        return gpiod::line::bias::DISABLED;
    case Bias::pull_up:
        return gpiod::line::bias::PULL_UP;
    case Bias::pull_down:
        return gpiod::line::bias::PULL_DOWN;
    }
    return gpiod::line::bias::AS_IS;
}

gpiod::line_request take(const RequestSettings &settings, const std::string &consumer) {
    gpiod::line_settings line;
    line.set_active_low(settings.active_low).set_bias(bias_of(settings.bias));
    if (settings.output)
        line.set_direction(gpiod::line::direction::OUTPUT)
            .set_drive(drive_of(settings.drive))
            .set_output_value(gpiod::line::value::INACTIVE);
    else
        line.set_direction(gpiod::line::direction::INPUT)
            .set_edge_detection(gpiod::line::edge::BOTH)
            .set_event_clock(gpiod::line::clock::MONOTONIC);
    return gpiod::chip(settings.path)
        .prepare_request()
        .set_consumer(consumer)
        .add_line_settings(settings.offset, line)
        .do_request();
}

class RequestV2 final : public Request {
  public:
    RequestV2(const RequestSettings &settings, const std::string &consumer)
        : offset_(settings.offset), request_(take(settings, consumer)) {}
    void set(bool active) override {
        request_.set_value(offset_,
                           active ? gpiod::line::value::ACTIVE : gpiod::line::value::INACTIVE);
    }
    bool get() override { return request_.get_value(offset_) == gpiod::line::value::ACTIVE; }
    int descriptor() override { return request_.fd(); }
    EdgeEvent read_edge() override {
        request_.read_edge_events(buffer_);
        const gpiod::edge_event &event = buffer_.get_event(0);
        return {std::chrono::nanoseconds(event.timestamp_ns().ns()),
                event.type() == gpiod::edge_event::event_type::RISING_EDGE};
    }

  private:
    gpiod::line::offset offset_;
    gpiod::line_request request_;
    gpiod::edge_event_buffer buffer_{1};
};

} // namespace

void need_library() {}

ChipInfo chip_info(const std::string &path) {
    const gpiod::chip chip(path);
    const gpiod::chip_info chip_info = chip.get_info();
    ChipInfo info{.label = chip_info.label()};
    for (unsigned offset = 0; offset < chip_info.num_lines(); ++offset) {
        const gpiod::line_info line = chip.get_line_info(offset);
        const std::string consumer = line.consumer();
        // The kernel holds some lines without a consumer's name.
        info.lines.push_back({.name = line.name(),
                              .consumer = consumer.empty() && line.used() ? "kernel" : consumer,
                              .output = line.direction() == gpiod::line::direction::OUTPUT});
    }
    return info;
}

std::unique_ptr<Request> request(const RequestSettings &settings, const std::string &consumer) {
    return std::make_unique<RequestV2>(settings, consumer);
}

} // namespace tsuya::lab::gpiod_api
