#include "tsuya/lab/gpio_line.h"

#include "gpio_places.h"
#include "gpiod_api.h"
#include "tsuya/lab/clock.h"

#include <algorithm>
#include <map>
#include <utility>

#include <poll.h>

namespace tsuya::lab {

struct GpioLine::Held {
    std::unique_ptr<gpiod_api::Request> request;
};

struct GpioInput::Held {
    std::unique_ptr<gpiod_api::Request> request;
    SteadyClock clock{};
};

namespace {

constexpr const char *kConsumer = "tsuya";

/// Takes the line and returns its name.
std::unique_ptr<gpiod_api::Request> take(const GpioLineSettings &settings, bool output,
                                         std::string &name) {
    const GpioPlace place = find_gpio_line(settings);
    name = place.chip + ':' + settings.line;
    try {
        return gpiod_api::request({.path = place.path,
                                   .offset = place.offset,
                                   .output = output,
                                   .active_low = settings.active_low,
                                   .drive = settings.drive,
                                   .bias = settings.bias},
                                  kConsumer);
    } catch (const std::system_error &error) {
        throw gpio_error("the GPIO line cannot be taken as " +
                             std::string(output ? "output" : "input"),
                         name, error, place.consumer);
    }
}

/// Calls `use`; a failure of the system becomes an Error.
template <typename Use> auto translated(const char *what, const std::string &name, const Use &use) {
    try {
        return use();
    } catch (const std::system_error &error) {
        throw gpio_error(what, name, error);
    }
}

/// Whether there is an edge to read within the time. Throws std::system_error if the device is
/// gone, which only a new call of poll() notices: the kernel wakes nobody up.
bool edge_within(int descriptor, std::chrono::nanoseconds time) {
    pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
    const timespec timeout{seconds.count(), (time - seconds).count()};
    if (ppoll(&watched, 1, &timeout, nullptr) <= 0)
        return false;
    if ((watched.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0)
        throw std::system_error(std::make_error_code(std::errc::no_such_device));
    return true;
}

bool is_of(Edge edge, bool active) {
    return edge == Edge::any || active == (edge == Edge::to_active);
}

} // namespace

void check_gpio_lines(std::span<const NamedGpioLine> lines) {
    Problems problems;
    std::map<std::pair<std::string, unsigned>, std::string> roles;
    for (const NamedGpioLine &line : lines) {
        try {
            const GpioPlace place = find_gpio_line(line.settings);
            const auto [at, fresh] = roles.emplace(std::pair(place.path, place.offset), line.role);
            problems.need(fresh,
                          "is the same line as " + at->second + ", number " +
                              std::to_string(place.offset) + " of " + place.chip,
                          line.role, "another line");
        } catch (const Error &error) {
            problems.add(error.within(line.role));
        }
    }
    problems.throw_if_any();
}

GpioLine::GpioLine(const GpioLineSettings &settings) : held_(std::make_unique<Held>()) {
    held_->request = take(settings, true, name_);
}

GpioLine::~GpioLine() {
    try {
        held_->request->set(false);
    } catch (...) { // the line's device is gone; nothing more can be done
    }
}

void GpioLine::set(bool active) {
    translated("the GPIO line cannot be set", name_, [&] { held_->request->set(active); });
}

void GpioLine::check() {
    translated("the GPIO line is gone", name_, [&] { held_->request->get(); });
}

GpioInput::GpioInput(const GpioLineSettings &settings) : held_(std::make_unique<Held>()) {
    held_->request = take(settings, false, name_);
}

GpioInput::~GpioInput() = default;

bool GpioInput::active() {
    return translated("the GPIO line cannot be read", name_, [&] { return held_->request->get(); });
}

std::optional<EdgeEvent> GpioInput::wait(Edge edge, std::chrono::nanoseconds deadline,
                                         const std::atomic<bool> *stop) {
    return translated("the GPIO line cannot be watched", name_, [&]() -> std::optional<EdgeEvent> {
        while (!(stop && stop->load())) {
            const auto left = std::max(deadline - held_->clock.now(), std::chrono::nanoseconds(0));
            if (edge_within(held_->request->descriptor(),
                            std::min<std::chrono::nanoseconds>(left, SteadyClock::kStopLatency))) {
                const EdgeEvent event = held_->request->read_edge();
                if (is_of(edge, event.active))
                    return event;
            } else if (left <= std::chrono::nanoseconds(0)) {
                return std::nullopt;
            }
        }
        return std::nullopt;
    });
}

GpioListing gpio_lines() {
    gpiod_api::need_library();
    GpioListing listing;
    for (const std::string &path : gpio_chip_paths()) {
        const std::string chip = path.substr(path.rfind('/') + 1);
        try {
            const gpiod_api::ChipInfo info = gpiod_api::chip_info(path);
            for (unsigned offset = 0; offset < info.lines.size(); ++offset)
                listing.lines.push_back({.chip = chip,
                                         .label = info.label,
                                         .offset = offset,
                                         .name = info.lines[offset].name,
                                         .consumer = info.lines[offset].consumer,
                                         .output = info.lines[offset].output});
        } catch (const std::system_error &error) {
            const Error why = gpio_error("the GPIO chip cannot be opened", chip, error);
            listing.unreadable.push_back(why.problems()[0]);
        }
    }
    return listing;
}

} // namespace tsuya::lab
