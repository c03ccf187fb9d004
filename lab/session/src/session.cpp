#include "tsuya/lab/session.h"

#include "tsuya/sdk/detail/hasher.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

#include <cstdio>
#include <map>

namespace tsuya::lab {
namespace {

/// Takes the events of a journal in order.
class SessionReader {
  public:
    explicit SessionReader(Session &session) : session_(session) {}

    void take(const JournalEvent &event, const std::string &where) {
        if (event.frame && *event.frame >= session_.plan.frames.size())
            throw Error({"the plan has no frame " + std::to_string(*event.frame), where,
                         "expected one below " + std::to_string(session_.plan.frames.size())});
        if (event.kind == EventKind::session)
            session_.dry_run = event.text("boot") == kDryRunBoot;
        if (event.kind == EventKind::ok)
            count(event, where);
        if (event.kind == EventKind::reject)
            session_.rejected.push_back(
                {.number = event.frame, .file = file_of(event), .why = event.text("why")});
    }

    void finish() {
        for (std::size_t number = 0; number < session_.plan.frames.size(); ++number) {
            const auto at = counted_.find(number);
            if (at == counted_.end())
                session_.missing.push_back(number);
            else
                session_.frames.push_back(at->second);
        }
    }

  private:
    std::filesystem::path file_of(const JournalEvent &event) const {
        const std::string name = event.text("file");
        return name.empty() ? std::filesystem::path() : session_.folder / name;
    }

    void count(const JournalEvent &event, const std::string &where) {
        const CountedFrame frame = counted(event);
        if (!std::filesystem::is_regular_file(frame.file))
            throw Error({"the picture '" + frame.file.string() + "' is gone", where,
                         "expected the file of a frame that counts"});
        if (!event.frame)
            session_.warm_up.push_back(frame);
        else if (!counted_.emplace(*event.frame, frame).second)
            throw Error({"the frame " + std::to_string(*event.frame) + " counts a second time",
                         where, "expected each frame once"});
    }

    CountedFrame counted(const JournalEvent &event) const {
        CountedFrame frame{.number = event.frame,
                           .file = file_of(event),
                           .hash = event.text("hash"),
                           .time_s = event.number("middle_s"),
                           .exposure_s = event.number("exposure_s"),
                           .strike = static_cast<int>(event.number("strike")),
                           .lamp_hours = event.number("lamp_hours")};
        if (event.frame)
            frame.planned = session_.plan.frames[*event.frame];
        else
            frame.planned = {.kind = FrameKind::white,
                             .directions = {.theta_i = event.number("theta_i_deg") * kDegree,
                                            .phi_i = event.number("phi_i_deg") * kDegree,
                                            .theta_r = event.number("theta_r_deg") * kDegree,
                                            .phi_r = event.number("phi_r_deg") * kDegree},
                             .exposure_s = event.number("planned_s")};
        return frame;
    }

    Session &session_;
    std::map<std::size_t, CountedFrame> counted_{};
};

} // namespace

std::vector<std::filesystem::path> files_named_by(const RigFile &rig) {
    std::vector<std::filesystem::path> files;
    if (const auto *standard = std::get_if<std::filesystem::path>(&rig.white.rho_std))
        files.push_back(*standard);
    for (const std::filesystem::path &file : {rig.camera.response, rig.camera.flat})
        if (!file.empty())
            files.push_back(file);
    return files;
}

std::string file_hash(const std::filesystem::path &file) { return files_hash({file}); }

std::string files_hash(const std::vector<std::filesystem::path> &files) {
    detail::Hasher hasher;
    for (const std::filesystem::path &file : files)
        hasher.text(read_file(file));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hasher.result()));
    return text;
}

RigCamera dry_run_camera(RigCamera camera) {
    camera.extension = "tif";
    camera.response.clear();
    camera.patch_at.clear();
    camera.flat.clear();
    camera.monitor = {};
    return camera;
}

Session read_session(const std::filesystem::path &folder) {
    const std::filesystem::path plan = folder / "plan.jsonl", rig = folder / "rig.toml",
                                journal = folder / "journal.jsonl";
    Session session{.folder = folder,
                    .rig = read_rig_file(rig),
                    .plan = read_plan(plan),
                    .plan_hash = file_hash(plan),
                    .rig_hash = file_hash(rig),
                    .journal_hash = file_hash(journal)};
    session.named_hash = files_hash(files_named_by(session.rig));
    SessionReader reader(session);
    for (const JournalEvent &event : read_journal(journal).events)
        reader.take(event, journal.string() + ":" + std::to_string(event.seq + 1));
    reader.finish();
    if (session.dry_run)
        session.rig.camera = dry_run_camera(session.rig.camera);
    return session;
}

} // namespace tsuya::lab
