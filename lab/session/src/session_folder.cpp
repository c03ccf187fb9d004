#include "json_line.h"
#include "tsuya/lab/session_run.h"
#include "tsuya/sdk/file.h"

#include <algorithm>

namespace tsuya::lab {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path &folder) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (code)
        throw Error({"the folder cannot be made: " + code.message(), folder.string(),
                     accepted_for_writing(code.value())});
}

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
    make_folder((folder / beside).parent_path());
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

/// Folders for the pictures, and the rig file with what it names.
void fill(const fs::path &folder, const RigFile &rig, const fs::path &rig_file) {
    Problems problems;
    make_folder(folder / "frames");
    make_folder(folder / "rejected");
    const fs::path rig_folder = rig_file.parent_path();
    if (const auto *standard = std::get_if<fs::path>(&rig.white.rho_std))
        copy_named(*standard, rig_folder, folder, problems);
    copy_named(rig.camera.response, rig_folder, folder, problems);
    problems.throw_if_any();
    write_file(folder / "rig.toml", read_file(rig_file));
}

/// Makes lasting what the folder has, and that it is there.
void sync_all(const fs::path &folder) {
    for (const auto &entry : fs::recursive_directory_iterator(folder))
        if (entry.is_directory())
            sync_folder(entry.path());
        else
            sync_file(entry.path());
    sync_folder(folder);
    sync_folder(fs::absolute(folder).lexically_normal().parent_path());
}

/// The line, also where the file does not end with a line break.
std::string line_at(const TextLines &lines, std::size_t i) {
    if (i < lines.whole.size())
        return std::string(lines.whole[i]);
    return i > lines.whole.size() || lines.rest.empty() ? "(no line)" : std::string(lines.rest);
}

/// The lines that differ, as problems.
void add_differences(const fs::path &was, const fs::path &is, Problems &problems) {
    const std::string old_text = read_file(was), new_text = read_file(is);
    const TextLines old_lines = lines_of(old_text), new_lines = lines_of(new_text);
    for (std::size_t i = 0; i <= std::max(old_lines.whole.size(), new_lines.whole.size()); ++i) {
        const std::string before = line_at(old_lines, i), now = line_at(new_lines, i);
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
    try {
        fill(folder, rig, rig_file);
        write_file(folder / "plan.jsonl", read_file(plan_file));
        write_file(folder / "journal.jsonl", ""); // nothing has happened yet
        sync_all(folder);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder, ignored); // it was not there, or empty
        throw;
    }
}

void check_same_rig_and_plan(const fs::path &folder, const fs::path &rig) {
    Problems problems;
    add_differences(folder / "rig.toml", rig, problems);
    const fs::path plan = folder / "plan.jsonl";
    const Journal begun = read_journal(folder / "journal.jsonl");
    for (const JournalEvent &event : begun.events)
        if (event.kind == EventKind::session &&
            !problems.need(event.text("plan") == file_hash(plan),
                           "the plan was changed after the session began", plan.string(),
                           "expected the plan with the hash " + event.text("plan")))
            break;
    problems.throw_if_any();
}

} // namespace tsuya::lab
