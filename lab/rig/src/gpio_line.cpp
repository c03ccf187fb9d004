#include "tsuya/lab/gpio_line.h"

#include "gpiod_api.h"
#include "tsuya/sdk/error.h"

#include <charconv>
#include <optional>
#include <system_error>

namespace tsuya::lab {

struct GpioLine::Held {
    std::unique_ptr<gpiod_api::Request> request;
};

namespace {

constexpr const char *kConsumer = "tsuya";

struct Place {
    std::string chip{};
    unsigned offset = 0;
    std::string consumer{};
};

/// An Error that says what to do about the system's answer.
Error system_problem(const std::string &what, const std::string &where,
                     const std::system_error &error, const std::string &consumer = "") {
    const std::error_code code = error.code();
    std::string accepted;
    if (code == std::errc::permission_denied || code == std::errc::operation_not_permitted)
        accepted = "a user of the group that owns the device, usually `gpio`";
    else if (code == std::errc::device_or_resource_busy)
        accepted = "a line that no other program holds" +
                   (consumer.empty() ? "" : "; this one is held by '" + consumer + "'");
    return Error({.what = what + ": " + code.message(), .where = where, .accepted = accepted});
}

std::vector<gpiod_api::LineInfo> lines_of(const std::string &chip) {
    try {
        return gpiod_api::lines(chip);
    } catch (const std::system_error &error) {
        if (error.code() == std::errc::no_such_file_or_directory)
            throw Error({.what = "there is no such GPIO chip",
                         .where = chip,
                         .accepted = gpiod_api::chips().empty()
                                         ? "a computer with GPIO; this one has no chip"
                                         : accepted_names(chip, gpiod_api::chips())});
        throw system_problem("the GPIO chip cannot be opened", chip, error);
    }
}

std::optional<unsigned> as_offset(const std::string &text) {
    unsigned offset = 0;
    const char *end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, offset);
    if (text.empty() || error != std::errc{} || last != end)
        return std::nullopt;
    return offset;
}

/// The places on one chip where the line could be: by name, or else by offset.
std::vector<Place> places_on(const std::string &chip, const std::string &line,
                             std::vector<std::string> &names) {
    const std::vector<gpiod_api::LineInfo> lines = lines_of(chip);
    std::vector<Place> found;
    for (unsigned offset = 0; offset < lines.size(); ++offset) {
        if (lines[offset].name == line)
            found.push_back({chip, offset, lines[offset].consumer});
        if (!lines[offset].name.empty())
            names.push_back(lines[offset].name);
    }
    if (const auto offset = as_offset(line); found.empty() && offset && *offset < lines.size())
        found.push_back({chip, *offset, lines[*offset].consumer});
    return found;
}

std::string accepted_lines(const std::string &line, const std::vector<std::string> &names) {
    return names.empty() ? "an offset: no line here has a name" : accepted_names(line, names);
}

Place find(const GpioLineSettings &settings) {
    if (settings.line.empty())
        throw Error({.what = "no GPIO line was named",
                     .where = settings.chip,
                     .accepted = "a line's name or offset"});
    if (settings.chip.empty() && as_offset(settings.line))
        throw Error({.what = "an offset needs a chip",
                     .where = settings.line,
                     .accepted = "a chip such as gpiochip0, or a line's name"});
    std::vector<std::string> chips{settings.chip};
    if (settings.chip.empty())
        chips = gpiod_api::chips();
    if (chips.empty())
        throw Error({.what = "this computer has no GPIO chip",
                     .where = settings.line,
                     .accepted = "a computer with GPIO, or the simulated line"});
    std::vector<std::string> names;
    std::vector<Place> found;
    for (const std::string &chip : chips)
        for (Place &place : places_on(chip, settings.line, names))
            found.push_back(std::move(place));
    const std::string where = settings.chip.empty() ? settings.line : settings.chip;
    if (found.empty())
        throw Error({.what = "there is no GPIO line '" + settings.line + "'",
                     .where = where,
                     .accepted = accepted_lines(settings.line, names)});
    if (found.size() > 1)
        throw Error(
            {.what = std::to_string(found.size()) + " GPIO lines are named '" + settings.line + "'",
             .where = where,
             .accepted = "chip and offset, such as " + found[0].chip + " and " +
                         std::to_string(found[0].offset)});
    return found[0];
}

} // namespace

GpioLine::GpioLine(const GpioLineSettings &settings) : held_(std::make_unique<Held>()) {
    const Place place = find(settings);
    name_ = place.chip + ':' + settings.line;
    try {
        held_->request =
            gpiod_api::request(place.chip, place.offset, settings.active_low, kConsumer);
    } catch (const std::system_error &error) {
        throw system_problem("the GPIO line cannot be taken as output", name_, error,
                             place.consumer);
    }
}

GpioLine::~GpioLine() {
    try {
        held_->request->set(false);
    } catch (...) { // the line's device is gone; nothing more can be done
    }
}

void GpioLine::set(bool active) {
    try {
        held_->request->set(active);
    } catch (const std::system_error &error) {
        throw system_problem("the GPIO line cannot be set", name_, error);
    }
}

std::vector<GpioLineInfo> gpio_lines() {
    std::vector<GpioLineInfo> infos;
    for (const std::string &chip : gpiod_api::chips()) {
        try {
            const std::vector<gpiod_api::LineInfo> lines = gpiod_api::lines(chip);
            for (unsigned offset = 0; offset < lines.size(); ++offset)
                infos.push_back({chip, offset, lines[offset].name, lines[offset].consumer});
        } catch (const std::system_error &) { // not ours to open
        }
    }
    return infos;
}

} // namespace tsuya::lab
