// A camera as a program: `virtual_camera RIG.toml STATE FILE EXPOSURE_S`. It sees the rig in the
// files of the folder STATE, as lines and drives left them: `lamp_theta`, `lamp_phi`, `camera` and
// `stage` hold the positions of the axes, `sample` what lies under the camera, `lamp` and
// `shutter` 1 or 0. `faults` has lines `N FAULT`: what goes wrong with the N-th exposure, from 0.

#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <unistd.h>

#include "lab/virtual_cloth.h"
#include "tsuya/lab/virtual_camera.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace {

using namespace tsuya;
namespace fs = std::filesystem;

/// What stands in a file of the state; empty where there is none.
std::string state_of(const fs::path &file) {
    std::istringstream text(fs::exists(file) ? read_file(file) : "");
    std::string word;
    text >> word;
    return word;
}

double number_in(const fs::path &file) {
    const std::string word = state_of(file);
    double value = 0;
    if (std::from_chars(word.data(), word.data() + word.size(), value).ec != std::errc())
        throw Error({"'" + word + "' is no position", file.string(), "expected degrees"});
    return value;
}

/// How many exposures there were, and one more from now on.
long count_exposure(const fs::path &state) {
    const long before = std::atol(state_of(state / "exposures").c_str());
    write_file(state / "exposures", std::to_string(before + 1));
    return before;
}

std::string fault_of(const fs::path &state, long exposure) {
    std::istringstream lines(fs::exists(state / "faults") ? read_file(state / "faults") : "");
    std::string fault;
    for (long n; lines >> n >> fault;)
        if (n == exposure)
            return fault;
    return "";
}

/// [Takeda]'s goniometer backwards: where light and view are, seen from the cloth.
DirectionPair directions_of(const lab::RigFile &rig, const fs::path &state) {
    const auto angle = [&](lab::AxisName name) {
        const lab::RigAxis &axis = rig.axis(name);
        return axis.sign * (number_in(state / name_of(name)) - axis.zero_deg) * kDegree;
    };
    const double phi_r = -angle(lab::AxisName::stage);
    return {.theta_i = angle(lab::AxisName::lamp_theta),
            .phi_i = angle(lab::AxisName::lamp_phi) + phi_r,
            .theta_r = angle(lab::AxisName::camera),
            .phi_r = phi_r};
}

lab::FrameKind kind_of(const fs::path &state) {
    if (state_of(state / "lamp") != "1" || state_of(state / "shutter") != "1")
        return lab::FrameKind::dark;
    const std::string sample = state_of(state / "sample");
    return sample == "cloth"   ? lab::FrameKind::cloth
           : sample == "white" ? lab::FrameKind::white
                               : lab::FrameKind::trap;
}

std::optional<lab::CameraFault> fault_in_file(const std::string &fault) {
    return fault == "empty_file"       ? std::optional(lab::CameraFault::empty_file)
           : fault == "cut_file"       ? std::optional(lab::CameraFault::cut_file)
           : fault == "wrong_exposure" ? std::optional(lab::CameraFault::wrong_exposure)
                                       : std::nullopt;
}

/// The picture of a frame is the same whenever it is taken: its name is the seed of its noise.
void take(const lab::RigFile &rig, const fs::path &state, const fs::path &file, double exposure_s,
          const std::string &fault) {
    const std::size_t number = std::hash<std::string>()(file.stem().string()) % 1000000000;
    lab::VirtualCamera camera(
        {.cloth = test::virtual_cloth, .drift = 0, .flicker = 0, .repeat_mm = {0.4, 0.4}},
        rig.camera,
        {.width = 48, .height = 48, .fault = [&](std::uint64_t) { return fault_in_file(fault); }});
    const lab::Shot shot{.number = number,
                         .planned = {.kind = kind_of(state),
                                     .view = number,
                                     .directions = directions_of(rig, state),
                                     .exposure_s = exposure_s},
                         .file = file,
                         .time_s = static_cast<double>(number)};
    camera.expose(shot);
    camera.collect(shot);
}

int run(const fs::path &rig_file, const fs::path &state, const fs::path &file, double exposure_s) {
    const std::string fault = fault_of(state, count_exposure(state));
    if (fault == "busy")
        throw Error({"the camera is busy", "virtual camera", ""});
    if (fault == "hang") {
        write_file(state / "hangs", std::to_string(getpid()));
        for (;;)
            pause();
    }
    if (fault == "no_file")
        return 0;
    if (fault == "old_file") {
        fs::copy_file(read_file(state / "last"), file);
        return 0;
    }
    take(lab::read_rig_file(rig_file), state, file, exposure_s, fault);
    if (fault.empty())
        write_file(state / "last", file.string());
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    try {
        if (argc != 5)
            throw Error({"there are " + std::to_string(argc - 1) + " arguments", "virtual_camera",
                         "expected RIG.toml STATE FILE EXPOSURE_S"});
        return run(argv[1], argv[2], argv[3], std::atof(argv[4]));
    } catch (const Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
