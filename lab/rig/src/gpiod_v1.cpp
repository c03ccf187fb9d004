// libgpiod 1.6.
#include "gpiod_api.h"

#include <gpiod.hpp>

#include <algorithm>
#include <filesystem>

namespace tsuya::lab::gpiod_api {
namespace {

class RequestV1 final : public Request {
  public:
    RequestV1(const std::string &chip, unsigned offset, bool active_low,
              const std::string &consumer)
        : chip_(chip), line_(chip_.get_line(offset)) {
        const auto flags = active_low ? gpiod::line_request::FLAG_ACTIVE_LOW : std::bitset<32>{};
        line_.request({consumer, gpiod::line_request::DIRECTION_OUTPUT, flags}, 0);
    }
    void set(bool active) override { line_.set_value(active ? 1 : 0); }

  private:
    gpiod::chip chip_; // released with its last reference
    gpiod::line line_;
};

} // namespace

// Not gpiod::make_chip_iter(), which gives up at the first chip that may not be opened.
std::vector<std::string> chips() {
    std::vector<std::string> names;
    std::error_code unreadable;
    for (const auto &entry : std::filesystem::directory_iterator("/dev", unreadable))
        if (const std::string name = entry.path().filename(); name.starts_with("gpiochip"))
            names.push_back(name);
    std::sort(names.begin(), names.end(), [](const std::string &a, const std::string &b) {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    });
    return names;
}

std::vector<LineInfo> lines(const std::string &chip_name) {
    const gpiod::chip chip(chip_name);
    std::vector<LineInfo> infos;
    for (unsigned offset = 0; offset < chip.num_lines(); ++offset) {
        const gpiod::line line = chip.get_line(offset);
        const std::string consumer = line.consumer();
        // The kernel holds some lines without a consumer's name.
        infos.push_back({line.name(), consumer.empty() && line.is_used() ? "kernel" : consumer});
    }
    return infos;
}

std::unique_ptr<Request> request(const std::string &chip, unsigned offset, bool active_low,
                                 const std::string &consumer) {
    return std::make_unique<RequestV1>(chip, offset, active_low, consumer);
}

} // namespace tsuya::lab::gpiod_api
