#pragma once
// Sessions whose pictures come from the virtual camera, written without the code that runs
// sessions.

#include <set>

#include "tsuya/lab/session.h"
#include "tsuya/lab/virtual_camera.h"

namespace tsuya::test {

struct VirtualSession {
    Directions directions{};
    lab::VirtualScene scene{};
    lab::VirtualCameraSettings camera{.width = 48, .height = 48};
    std::string rig_lines{}; ///< at the end of the rig file: tables of their own
    std::string camera_lines = "exposures_s = [0.1, 1, 10]\n";
    double e_per_dn = 2.5, read_noise_e = 4; ///< of the sensor
    std::string white_lines{};               ///< in [white]
    lab::WhiteUse white = lab::WhiteUse::each_light;
    std::size_t white_every = 50;
    int dark_frames = 2;                   ///< of each exposure, at either end
    std::set<std::size_t> missing_views{}; ///< of the cloth, from 0: their last exposure is missing
    std::optional<std::size_t> glint_view{}; ///< of the cloth, from 0: far too bright
    double seconds_a_view = 5;               ///< besides the exposures
    double jump_at = 1e9, jump = 1; ///< from this view of the cloth on, times the lamp's light
};

/// Number of the view in the plan of the n-th view of the cloth.
std::size_t plan_view(const lab::Plan &plan, std::size_t n);

/// Writes the folder, and reads it as a session.
lab::Session make_virtual_session(const std::filesystem::path &folder,
                                  const VirtualSession &settings);

/// The reflectance in a table, looked up at its own directions.
std::function<double(const DirectionPair &)> looked_up(const ReflectanceTable &table);

} // namespace tsuya::test
