#include "gpio_places.h"

#include "gpiod_api.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

namespace tsuya::lab {
namespace {

std::string name_of(const std::string &path) {
    return std::filesystem::path(path).filename().string();
}

std::optional<unsigned> as_number(const std::string &text) {
    unsigned number = 0;
    const char *end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    if (text.empty() || error != std::errc{} || last != end)
        return std::nullopt;
    return number;
}

gpiod_api::ChipInfo info_of(const std::string &path) {
    try {
        return gpiod_api::chip_info(path);
    } catch (const std::system_error &error) {
        throw gpio_error("the GPIO chip cannot be opened", name_of(path), error);
    }
}

/// Names and labels of the chips; chips that cannot be opened have a name only.
struct ChipNames {
    std::vector<std::string> known{};
    std::vector<std::string> with_label{}; ///< paths of the chips that have the label
};

ChipNames look_for_label(const std::string &label) {
    ChipNames names;
    for (const std::string &path : gpio_chip_paths()) {
        names.known.push_back(name_of(path));
        try {
            const std::string its = gpiod_api::chip_info(path).label;
            if (!its.empty())
                names.known.push_back(its);
            if (its == label)
                names.with_label.push_back(path);
        } catch (const std::system_error &) { // one that may not be opened has no label to us
        }
    }
    return names;
}

/// The chip's device without symbolic links. libgpiod 2 opens paths only.
std::string chip_path(const std::string &chip) {
    std::string path = chip;
    if (const auto number = as_number(chip))
        path = "/dev/gpiochip" + std::to_string(*number);
    else if (chip.find('/') == std::string::npos)
        path = "/dev/" + chip;
    std::error_code missing;
    const std::filesystem::path device = std::filesystem::canonical(path, missing);
    if (!missing)
        return device.string();
    const ChipNames names = look_for_label(chip);
    if (names.with_label.size() == 1)
        return names.with_label[0];
    if (names.with_label.size() > 1)
        throw Error(
            {.what = std::to_string(names.with_label.size()) + " GPIO chips have this label",
             .where = chip,
             .accepted = "a chip's name, such as " + name_of(names.with_label[0])});
    throw Error({.what = "there is no such GPIO chip",
                 .where = chip,
                 .accepted = names.known.empty()
                                 ? "expected a computer with GPIO; this one has no chip"
                                 : accepted_names(chip, names.known)});
}

/// The places on one chip where the line could be: by name, or else by offset.
std::vector<GpioPlace> places_on(const std::string &path, const std::string &line,
                                 std::vector<std::string> &names) {
    const std::vector<gpiod_api::LineInfo> lines = info_of(path).lines;
    std::vector<GpioPlace> found;
    for (unsigned offset = 0; offset < lines.size(); ++offset) {
        if (lines[offset].name == line)
            found.push_back({path, name_of(path), offset, lines[offset].consumer});
        if (!lines[offset].name.empty())
            names.push_back(lines[offset].name);
    }
    if (const auto offset = as_number(line); found.empty() && offset && *offset < lines.size())
        found.push_back({path, name_of(path), *offset, lines[*offset].consumer});
    return found;
}

/// The chips in which the line is looked for.
std::vector<std::string> chips_for(const GpioLineSettings &settings) {
    gpiod_api::need_library();
    if (settings.line.empty())
        throw Error({.what = "no GPIO line was named",
                     .where = settings.chip,
                     .accepted = "a line's name or offset"});
    if (!settings.chip.empty())
        return {chip_path(settings.chip)};
    if (as_number(settings.line))
        throw Error({.what = "an offset needs a chip",
                     .where = settings.line,
                     .accepted = "a chip such as gpiochip0, or a line's name"});
    std::vector<std::string> chips = gpio_chip_paths();
    if (chips.empty())
        throw Error({.what = "this computer has no GPIO chip",
                     .where = settings.line,
                     .accepted = "expected a computer with GPIO, or the simulated line"});
    return chips;
}

} // namespace

// /dev itself: iterators of libgpiod give up at the first chip that may not be opened.
std::vector<std::string> gpio_chip_paths() {
    std::vector<std::string> paths;
    std::error_code unreadable;
    for (const auto &entry : std::filesystem::directory_iterator("/dev", unreadable))
        if (entry.path().filename().string().starts_with("gpiochip"))
            paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end(), [](const std::string &a, const std::string &b) {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    });
    return paths;
}

GpioPlace find_gpio_line(const GpioLineSettings &settings) {
    std::vector<std::string> names;
    std::vector<GpioPlace> found;
    for (const std::string &path : chips_for(settings))
        for (GpioPlace &place : places_on(path, settings.line, names))
            found.push_back(std::move(place));
    const std::string where = settings.chip.empty() ? settings.line : settings.chip;
    if (found.empty())
        throw Error({.what = "there is no GPIO line '" + settings.line + "'",
                     .where = where,
                     .accepted = names.empty() ? "an offset: no line here has a name"
                                               : accepted_names(settings.line, names)});
    if (found.size() > 1)
        throw Error(
            {.what = std::to_string(found.size()) + " GPIO lines are named '" + settings.line + "'",
             .where = where,
             .accepted = "chip and offset, such as " + found[0].chip + " and " +
                         std::to_string(found[0].offset)});
    return found[0];
}

Error gpio_error(const std::string &what, const std::string &where, const std::system_error &error,
                 const std::string &consumer) {
    const std::error_code code = error.code();
    std::string accepted;
    if (code == std::errc::permission_denied || code == std::errc::operation_not_permitted)
        accepted = "a user of the group that owns the device, usually `gpio`; where no group does, "
                   "the rule SUBSYSTEM==\"gpio\", GROUP=\"gpio\", MODE=\"0660\" in "
                   "/etc/udev/rules.d/60-gpio.rules";
    else if (code == std::errc::device_or_resource_busy)
        accepted = "a line that no other program holds" +
                   (consumer.empty() ? "" : "; this one is held by '" + consumer + "'");
    else if (code == std::errc::no_such_device)
        accepted = "a chip that stays connected";
    return Error({.what = what + ": " + code.message(), .where = where, .accepted = accepted});
}

} // namespace tsuya::lab
