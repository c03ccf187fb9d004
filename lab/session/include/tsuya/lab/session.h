#pragma once
/// \file
/// A session's folder: `plan.jsonl`, `rig.toml`, `journal.jsonl`, `frames/`, `rejected/`.

#include "tsuya/lab/journal.h"
#include "tsuya/lab/plan.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// In a journal, what stands for the start of the computer in a dry run.
inline constexpr const char *kDryRunBoot = "dry run";

/// A picture that passed every check.
struct CountedFrame {
    /// Its number in the plan; none for a white frame that was taken beside the plan to tell
    /// whether the lamp is warm.
    std::optional<std::size_t> number{};
    PlannedFrame planned{};
    std::filesystem::path file{}; ///< usable as it is
    std::string hash{};           ///< of the file's bytes
    double time_s = 0;            ///< the middle of the exposure, seconds since 1970
    double exposure_s = 0;        ///< as the picture says, or as planned where it says nothing
    int strike = 0;               ///< which lighting of the lamp, from 1 for the lamp's first
    double lamp_hours = 0;        ///< lit until then
};

/// A picture that did not pass.
struct RejectedFrame {
    std::optional<std::size_t> number{}; ///< in the plan
    std::filesystem::path file{};        ///< empty where no picture came
    std::string why{};
};

/// What a session has so far.
struct Session {
    std::filesystem::path folder{};
    RigFile rig{}; ///< as it was at the first run; of a dry run with its camera
    Plan plan{};
    std::vector<CountedFrame> frames{};    ///< by number; each number once at most
    std::vector<CountedFrame> warm_up{};   ///< white frames beside the plan, by time
    std::vector<RejectedFrame> rejected{}; ///< in order of time
    std::vector<std::size_t> missing{};    ///< numbers of frames that are not there yet
    std::string plan_hash{}, rig_hash{}, journal_hash{}; ///< of the files' bytes, 16 hex digits
    std::string named_hash{};                            ///< of the files that the rig file names
    bool dry_run = false; ///< the pictures are those of a simulated camera
};

/// A rig's camera as a dry run has it: its pictures are small, linear TIFF files with the patch in
/// the middle, without vignetting and monitor.
RigCamera dry_run_camera(RigCamera camera);

/// Reads a session, also one that is not finished; changes nothing. Throws what read_plan,
/// read_rig_file and read_journal throw, and Error with file:line of the journal for a frame that
/// the plan does not have or whose file is gone.
Session read_session(const std::filesystem::path &folder);

/// The hash of a file's bytes that plan, journal and frames are known by: 16 hex digits.
std::string file_hash(const std::filesystem::path &file);

/// The same of the bytes of several files in order; of one file it is file_hash().
std::string files_hash(const std::vector<std::filesystem::path> &files);

/// The files that a rig file names and a session keeps copies of: the table or spectrum of its
/// white standard, its camera's response and flat field, where it has them.
std::vector<std::filesystem::path> files_named_by(const RigFile &rig);

} // namespace tsuya::lab
