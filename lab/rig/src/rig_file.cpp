#include "tsuya/lab/rig_file.h"

#include "rig_sections.h"
#include "tsuya/lab/number_text.h"

#include <cmath>
#include <set>

namespace tsuya::lab {
namespace {

constexpr const char *kSchema = "tsuya-rig 1";
constexpr double kLongest = 86400; // seconds, of any time in the file
constexpr double kMaxDn = 65535;
constexpr double kMostPixels = 65535; // along a side of a picture
constexpr Seconds kOperatorMove{20};  // for someone to turn an axis by hand

const std::vector<std::string> kRoleNames{"lamp",      "shutter", "half_press", "busy",
                                          "interlock", "estop",   "heartbeat"};
const std::vector<std::string> kAxisNames{"lamp_theta", "lamp_phi", "camera", "stage"};

/// The file that a key names.
std::filesystem::path existing_file(const Section &section, const std::filesystem::path &folder,
                                    const char *key, const std::string &expected) {
    std::filesystem::path file = folder / section.required_text(key);
    if (!std::filesystem::is_regular_file(file))
        section.problem(key, "there is no file '" + file.string() + "'", "expected " + expected);
    return file;
}

void read_seconds(const Section &section, const char *key, Seconds &field) {
    if (const auto seconds = section.number(key, 0, kLongest))
        field = Seconds(*seconds);
}

GpioLineSettings read_line(const Section &section, LineRole role) {
    GpioLineSettings line{.chip = section.text("chip").value_or("")};
    if (section.has("name") == section.has("offset"))
        section.problem("",
                        "the line has " + std::string(section.has("name")
                                                          ? "both a name and an offset"
                                                          : "neither a name nor an offset"),
                        "expected one of the two");
    if (const auto name = section.text("name"); name) {
        line.line = *name;
        if (name->empty())
            section.problem("name", "the name is empty", "expected a line's name");
    }
    if (const auto offset = section.integer("offset", 0, 1023)) {
        line.line = std::to_string(*offset);
        if (line.chip.empty())
            section.problem("offset", "an offset needs a chip", "expected `chip`");
    }
    line.active_low = section.flag("active_low").value_or(false);
    if (is_output(role))
        line.drive = static_cast<Drive>(
            read_choice(section, "drive", {"push-pull", "open-drain", "open-source"}));
    else if (section.has("drive"))
        section.problem("drive", "an input has no drive", "expected none");
    line.bias = static_cast<Bias>(
        read_choice(section, "bias", {"as-is", "disabled", "pull-up", "pull-down"}));
    return line;
}

void read_lines(const Section &root, RigFile &rig) {
    const auto lines = root.section("lines");
    if (!lines)
        return;
    std::map<std::pair<std::string, std::string>, std::string> seen;
    for (const auto &[name, section] : lines->sections()) {
        const auto role = index_of(name, kRoleNames);
        if (!role) {
            lines->problem(name, "unknown role '" + name + "' of a line",
                           accepted_names(name, kRoleNames));
            continue;
        }
        const auto known = static_cast<LineRole>(*role);
        const GpioLineSettings line = read_line(section, known);
        const auto [other, fresh] = seen.emplace(std::pair(line.chip, line.line), name);
        if (!fresh && !line.line.empty())
            lines->problem(name, "is the same line as " + other->second, "expected another line");
        rig.lines[known] = line;
    }
}

void read_lamp(const Section &root, const std::filesystem::path &folder, RigLamp &lamp) {
    const auto section = required_section(root, "lamp");
    if (!section)
        return;
    lamp.kind = static_cast<LampKind>(
        read_choice(*section, "kind", {"metal-halide", "tungsten", "led"}, true));
    lamp.serial = section->text("serial").value_or("");
    read_seconds(*section, "warm_up_s", lamp.warm_up);
    read_seconds(*section, "restrike_s", lamp.restrike);
    read_seconds(*section, "min_on_s", lamp.min_on);
    read_seconds(*section, "hold_s", lamp.hold);
    if (const auto log = section->text("log"))
        lamp.log = folder / *log;
    lamp.diameter_mm = section->number("diameter_mm", 0, 1e4).value_or(lamp.diameter_mm);
    lamp.distance_mm = section->number("distance_mm", 0, 1e5).value_or(lamp.distance_mm);
    lamp.spot_mm = section->number("spot_mm", 0, 1e4).value_or(lamp.spot_mm);
}

void read_shutter(const Section &root, RigShutter &shutter) {
    const auto section = root.section("shutter");
    if (!section)
        return;
    read_seconds(*section, "min_interval_s", shutter.min_interval);
    read_seconds(*section, "max_open_s", shutter.max_open);
    shutter.max_duty = section->number("max_duty", 0.001, 1).value_or(shutter.max_duty);
    shutter.lag = Seconds(section->number("lag_ms", 0, 1000).value_or(0) / 1000);
}

void read_exposures(const Section &section, const RigFile &rig, std::vector<double> &exposures) {
    exposures = section.numbers("exposures_s").value_or(std::vector<double>{});
    bool good = !exposures.empty();
    for (std::size_t i = 0; i < exposures.size(); ++i)
        good = good && exposures[i] > (i == 0 ? 0 : exposures[i - 1]);
    if (!good)
        section.problem("exposures_s", "the exposures are no ascending times",
                        "expected such as [0.01, 0.1, 1], in seconds");
    else if (exposures.back() + (section.has("command") ? rig.shutter.lag.count() : 0) >
             rig.shutter.max_open.count())
        section.problem("exposures_s",
                        "an exposure is longer than the shutter's max_open_s of " +
                            number_text(rig.shutter.max_open.count()) + " s",
                        "expected shorter ones");
}

/// How the camera is triggered: by its command or by the shutter line.
void read_trigger(const Section &section, const std::filesystem::path &folder, RigFile &rig) {
    RigCamera &camera = rig.camera;
    if (section.has("command") == section.has("trigger"))
        section.problem("",
                        section.has("command") ? "the camera has both a command and a trigger"
                                               : "the camera has neither command nor trigger",
                        "expected one of the two");
    if (section.has("command"))
        camera.command =
            read_command(section, {"file", "exposure"},
                         camera.exposures_s.size() > 1 ? std::set<std::string>{"file", "exposure"}
                                                       : std::set<std::string>{"file"});
    if (section.has("trigger")) {
        read_choice(section, "trigger", {"shutter"}, true);
        camera.watch_folder = folder / section.required_text("watch_folder");
        if (!rig.lines.contains(LineRole::shutter))
            section.problem("trigger", "the rig has no shutter line", "expected [lines.shutter]");
    } else if (section.has("watch_folder")) {
        section.text("watch_folder");
        section.problem("watch_folder", "a folder is watched for trigger = \"shutter\" alone",
                        "expected none");
    }
}

/// The pictures' names, size and encoding.
void read_pictures(const Section &section, const std::filesystem::path &folder, RigCamera &camera) {
    if (const auto extension = section.text("extension")) {
        camera.extension = *extension;
        if (extension->empty() || extension->find_first_not_of(
                                      "abcdefghijklmnopqrstuvwxyz0123456789") != std::string::npos)
            section.problem("extension", "is '" + *extension + "'",
                            "expected small letters and digits, such as cr2");
    }
    read_seconds(section, "transfer_s", camera.transfer);
    camera.frame_mb = section.number("frame_mb", 0.001, 1e4).value_or(camera.frame_mb);
    if (section.has("response"))
        camera.response = existing_file(section, folder, "response", "a response curve as CSV");
}

/// Where in its pictures the camera sees the patch.
void read_patch_places(const Section &section, std::vector<PatchPlace> &places) {
    const auto list = [&](const char *key) {
        return section.numbers(key).value_or(std::vector<double>{});
    };
    const std::vector<double> theta_deg = list("theta_deg"), x = list("x"), y = list("y");
    bool good = !theta_deg.empty() && x.size() == theta_deg.size() && y.size() == x.size();
    for (std::size_t i = 0; good && i < x.size(); ++i) {
        places.push_back({.theta_r_deg = theta_deg[i], .x = x[i], .y = y[i]});
        good = x[i] >= 0 && x[i] <= kMostPixels && y[i] >= 0 && y[i] <= kMostPixels &&
               (i == 0 || theta_deg[i] > theta_deg[i - 1]);
    }
    if (!good)
        section.problem("", "the places of the patch are no list",
                        "expected theta_deg, ascending, and as many x and y, such as [0, 80], "
                        "[1136, 1136], [852, 790]");
}

PictureArea read_monitor(const Section &section) {
    const std::vector<double> corner_size =
        section.numbers("monitor").value_or(std::vector<double>{});
    PictureArea area;
    int *const parts[]{&area.x, &area.y, &area.width, &area.height};
    bool good = corner_size.size() == 4;
    for (std::size_t i = 0; good && i < 4; ++i) {
        const double number = corner_size[i];
        good = number == std::floor(number) && number >= (i < 2 ? 0 : 1) && number <= kMostPixels;
        *parts[i] = good ? static_cast<int>(number) : 0;
    }
    if (!good)
        section.problem("monitor", "is no part of a picture",
                        "expected column, row, width and height in pixels, such as [40, 40, 64, "
                        "64]");
    return area;
}

/// What lies where in the pictures.
void read_places(const Section &section, const std::filesystem::path &folder, RigCamera &camera) {
    if (const auto places = section.section("patch_at"))
        read_patch_places(*places, camera.patch_at);
    if (section.has("flat"))
        camera.flat = existing_file(section, folder, "flat", "a picture of an even surface");
    if (section.has("monitor"))
        camera.monitor = read_monitor(section);
}

void read_camera(const Section &root, const std::filesystem::path &folder, RigFile &rig) {
    const auto section = required_section(root, "camera");
    if (!section)
        return;
    RigCamera &camera = rig.camera;
    read_exposures(*section, rig, camera.exposures_s);
    read_trigger(*section, folder, rig);
    read_seconds(*section, "timeout_s", camera.timeout);
    camera.black = section->required_number("black", 0, kMaxDn);
    camera.saturation = section->required_number("saturation", 1, kMaxDn);
    if (camera.saturation <= camera.black)
        section->problem("saturation", "is not above black", "expected a larger value");
    camera.e_per_dn = section->required_number("e_per_dn", 1e-3, 1e3);
    camera.read_noise_e = section->required_number("read_noise_e", 0, 1e4);
    camera.patch = section->integer("patch", 1, 4096).value_or(camera.patch);
    camera.pixel_mm = section->number("pixel_mm", 0, 10).value_or(camera.pixel_mm);
    camera.aperture_mm = section->number("aperture_mm", 0, 1e3).value_or(camera.aperture_mm);
    camera.distance_mm = section->number("distance_mm", 0, 1e5).value_or(camera.distance_mm);
    read_pictures(*section, folder, camera);
    read_places(*section, folder, camera);
}

void read_limits(const Section &section, RigAxis &axis) {
    const auto limits = section.numbers("limits_deg");
    if (!limits)
        return;
    if (limits->size() == 2 && (*limits)[0] < (*limits)[1])
        axis.limits_deg = {(*limits)[0], (*limits)[1]};
    else
        section.problem("limits_deg", "the limits are no two ascending positions",
                        "expected such as [-90, 90]");
}

void read_controller(const Section &section, RigAxis &axis) {
    axis.port = section.required_text("port");
    const std::vector<std::string> letters{"X", "Y", "Z", "A", "B", "C"};
    axis.letter = letters[read_choice(section, "letter", letters, true)][0];
    axis.feed_deg_per_min =
        section.number("feed_deg_per_min", 1, 1e5).value_or(axis.feed_deg_per_min);
}

RigAxis read_axis(const Section &section) {
    RigAxis axis;
    axis.drive = static_cast<AxisDrive>(
        read_choice(section, "drive", {"operator", "command", "grbl"}, true));
    if (axis.drive == AxisDrive::command)
        axis.command = read_command(section, {"axis", "deg"}, {"deg"});
    if (axis.drive == AxisDrive::grbl)
        read_controller(section, axis);
    if (axis.drive != AxisDrive::by_operator)
        read_seconds(section, "timeout_s", axis.timeout);
    axis.zero_deg = section.number("zero_deg", -720, 720).value_or(axis.zero_deg);
    if (const auto sign = section.integer("sign", -1, 1); sign && *sign != 0)
        axis.sign = *sign;
    else if (sign)
        section.problem("sign", "is 0", "expected 1 or -1");
    read_limits(section, axis);
    read_seconds(section, "settle_s", axis.settle);
    if (axis.drive == AxisDrive::by_operator)
        axis.move = kOperatorMove;
    read_seconds(section, "move_s", axis.move);
    axis.tolerance_deg = section.number("tolerance_deg", 1e-4, 5).value_or(axis.tolerance_deg);
    return axis;
}

void read_axes(const Section &root, RigFile &rig) {
    const auto axes = required_section(root, "axes");
    if (!axes)
        return;
    std::map<std::pair<std::string, char>, std::string> seen;
    for (const auto &[name, section] : axes->sections()) {
        const auto index = index_of(name, kAxisNames);
        if (!index) {
            axes->problem(name, "unknown axis '" + name + "'", accepted_names(name, kAxisNames));
            continue;
        }
        const RigAxis axis = read_axis(section);
        if (axis.drive == AxisDrive::grbl) {
            const auto [other, fresh] = seen.emplace(std::pair(axis.port, axis.letter), name);
            if (!fresh)
                axes->problem(name, "is the same axis of the controller as " + other->second,
                              "expected another letter or port");
        }
        rig.axes[*index] = axis;
    }
    for (const std::string &name : kAxisNames)
        if (!axes->has(name))
            axes->problem("", "there is no axis '" + name + "'", "expected [axes." + name + "]");
}

RigSample read_sample(const Section &section) {
    RigSample sample;
    sample.drive =
        static_cast<AxisDrive>(read_choice(section, "drive", {"operator", "command"}, true));
    if (sample.drive == AxisDrive::command) {
        sample.command = read_command(section, {"sample"}, {"sample"});
        sample.change = Seconds(2);
        read_seconds(section, "timeout_s", sample.timeout);
    }
    read_seconds(section, "change_s", sample.change);
    return sample;
}

void read_white(const Section &root, const std::filesystem::path &folder, RigWhite &white) {
    const auto section = required_section(root, "white");
    if (!section)
        return;
    white.height_mm = section->number("height_mm", -100, 100).value_or(white.height_mm);
    white.sigma = section->number("sigma", 0, 1).value_or(white.sigma);
    if (section->is_text("rho_std"))
        white.rho_std = existing_file(*section, folder, "rho_std",
                                      "a number, a spectrum as CSV, or a table of the standard");
    else
        white.rho_std = section->required_number("rho_std", 0.01, 1);
}

} // namespace

const char *name_of(LineRole role) { return kRoleNames[static_cast<std::size_t>(role)].c_str(); }

const char *name_of(AxisName axis) { return kAxisNames[static_cast<std::size_t>(axis)].c_str(); }

bool is_output(LineRole role) {
    return role == LineRole::lamp || role == LineRole::shutter || role == LineRole::half_press ||
           role == LineRole::heartbeat;
}

RigFile read_rig_file(const std::filesystem::path &file) {
    const Document document(file);
    const Section root = document.root();
    if (const std::string schema = root.required_text("schema"); schema != kSchema)
        root.problem("schema", "the schema is '" + schema + "'",
                     std::string("expected \"") + kSchema + "\"");
    const std::filesystem::path folder = file.parent_path();
    RigFile rig;
    read_lines(root, rig);
    read_lamp(root, folder, rig.lamp);
    read_shutter(root, rig.shutter);
    read_camera(root, folder, rig);
    read_axes(root, rig);
    if (const auto geometry = root.section("geometry"))
        rig.dead_cone_deg = geometry->number("dead_cone_deg", 0, 45).value_or(rig.dead_cone_deg);
    if (const auto sample = root.section("sample"))
        rig.sample = read_sample(*sample);
    read_white(root, folder, rig.white);
    document.finish();
    return rig;
}

} // namespace tsuya::lab
