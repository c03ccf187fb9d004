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
    for (const fs::path &named : files_named_by(rig))
        copy_named(named, rig_folder, folder, problems);
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

/// The copies of the files that the rig file names, beside those of now.
void add_named_differences(const fs::path &folder, const fs::path &rig, Problems &problems) {
    const RigFile begun = read_rig_file(folder / "rig.toml");
    for (const fs::path &was : files_named_by(begun)) {
        const fs::path is = rig.parent_path() / was.lexically_relative(folder);
        if (problems.need(fs::is_regular_file(is), "the file that the rig file names is gone",
                          is.string(), "expected it as when the session began"))
            add_differences(was, is, problems);
    }
}

/// What was hashed when the session began, and what is there now.
void add_changes(const JournalEvent &begun, const fs::path &folder, Problems &problems) {
    const auto same = [&](const char *key, const std::string &hash, const std::string &what,
                          const fs::path &where) {
        const std::string was = begun.text(key);
        problems.need(was.empty() || was == hash, what + " was changed after the session began",
                      where.string(), "expected the hash " + was);
    };
    same("plan", file_hash(folder / "plan.jsonl"), "the plan", folder / "plan.jsonl");
    same("rig", file_hash(folder / "rig.toml"), "the copy of the rig file", folder / "rig.toml");
    same("named", files_hash(files_named_by(read_rig_file(folder / "rig.toml"))),
         "a copy of the files that the rig file names", folder);
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
    problems.throw_if_any();
    add_named_differences(folder, rig, problems);
    for (const JournalEvent &event : read_journal(folder / "journal.jsonl").events)
        if (event.kind == EventKind::session) {
            add_changes(event, folder, problems);
            break;
        }
    problems.throw_if_any();
}

} // namespace tsuya::lab
