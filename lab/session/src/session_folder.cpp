#include "tsuya/lab/session_run.h"
#include "tsuya/sdk/file.h"

#include <algorithm>

namespace tsuya::lab {
namespace {

namespace fs = std::filesystem;

/// Copies a file that the rig file names, to the same place beside the copy of the rig file.
void copy_named(const fs::path &named, const fs::path &rig_folder, const fs::path &folder,
                Problems &problems) {
    if (named.empty())
        return;
    const fs::path beside = named.lexically_relative(rig_folder.empty() ? "." : rig_folder);
    if (!problems.need(!beside.empty() && *beside.begin() != "..",
                       "the rig file names a file outside of its folder", named.string(),
                       "expected it beside the rig file or below"))
        return;
    fs::create_directories((folder / beside).parent_path());
    write_file(folder / beside, read_file(named));
}

void check_is_new(const fs::path &folder) {
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw Error({"it is a file", folder.string(), "expected a folder"});
    if (fs::exists(folder) && !fs::is_empty(folder))
        throw Error({"the folder is not empty", folder.string(),
                     fs::exists(folder / "journal.jsonl")
                         ? "expected a new one; this session can be resumed"
                         : "expected a new one"});
}

/// The lines that differ, as problems.
void add_differences(const fs::path &was, const fs::path &is, Problems &problems) {
    const auto lines = [](const fs::path &file) {
        std::vector<std::string> split;
        const std::string text = read_file(file);
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            split.push_back(text.substr(at, end - at));
            at = end + 1;
        }
        return split;
    };
    const std::vector<std::string> old_lines = lines(was), new_lines = lines(is);
    const std::string none = "(no line)";
    for (std::size_t i = 0; i < std::max(old_lines.size(), new_lines.size()); ++i) {
        const std::string &before = i < old_lines.size() ? old_lines[i] : none;
        const std::string &now = i < new_lines.size() ? new_lines[i] : none;
        problems.need(before == now, "is now '" + now + "'",
                      is.string() + ":" + std::to_string(i + 1),
                      "expected '" + before + "' as when the session began");
    }
}

} // namespace

void create_session(const fs::path &folder, const fs::path &plan_file, const fs::path &rig_file) {
    check_is_new(folder);
    const Plan plan = read_plan(plan_file);
    const RigFile rig = read_rig_file(rig_file);
    if (!plan.rig_hash.empty() && plan.rig_hash != file_hash(rig_file))
        throw Error({"the rig file is not the one that the plan was made for", rig_file.string(),
                     "expected a new plan"});
    Problems problems;
    fs::create_directories(folder / "frames");
    fs::create_directories(folder / "rejected");
    const fs::path rig_folder = rig_file.parent_path();
    if (const auto *standard = std::get_if<fs::path>(&rig.white.rho_std))
        copy_named(*standard, rig_folder, folder, problems);
    copy_named(rig.camera.response, rig_folder, folder, problems);
    if (!problems.empty())
        fs::remove_all(folder);
    problems.throw_if_any();
    write_file(folder / "rig.toml", read_file(rig_file));
    write_file(folder / "plan.jsonl", read_file(plan_file));
    sync_folder(folder);
}

void check_same_rig_and_plan(const fs::path &folder, const fs::path &rig) {
    Problems problems;
    add_differences(folder / "rig.toml", rig, problems);
    const fs::path plan = folder / "plan.jsonl";
    const fs::path journal = folder / "journal.jsonl";
    const Journal begun = fs::exists(journal) ? read_journal(journal) : Journal{};
    for (const JournalEvent &event : begun.events)
        if (event.kind == EventKind::session &&
            !problems.need(event.text("plan") == file_hash(plan),
                           "the plan was changed after the session began", plan.string(),
                           "expected the plan with the hash " + event.text("plan")))
            break;
    problems.throw_if_any();
}

} // namespace tsuya::lab
