#include "project/includes.h"

#include "project/comments.h"

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <set>

namespace tsuya::project {
namespace {

using Folders = std::set<std::string>;

/// Folders that a folder may include, itself included.
const std::map<std::string, Folders> kMayInclude{
    {"sdk", {"sdk"}},
    {"garment", {"garment", "sdk"}},
    {"color", {"color", "sdk"}},
    {"lab", {"lab", "color", "sdk"}},
    {"samples", {"samples", "lab", "garment", "color", "sdk"}},
    {"tests", {"tests", "samples", "lab", "garment", "color", "sdk"}},
};

struct Owned {
    std::string prefix; ///< how the include path starts
    Folders folders;
};

/// Headers of other projects. What `tests/x` tests, it may also use as a second opinion.
const std::vector<Owned> kOwners{
    {"embree3/", {"sdk", "lab"}},
    {"embree4/", {"sdk", "lab"}},
    {"tbb/", {"sdk", "garment", "lab"}},
    {"oneapi/", {"sdk", "garment", "lab"}},
    {"Eigen/", {"sdk"}},
    {"toml++/", {"sdk", "lab", "samples"}},
    {"OpenColorIO/", {"color"}},
    {"OpenImageIO/", {"color"}},
    {"OpenMesh/", {"garment"}},
    {"opensubdiv/", {"garment"}},
    {"tiny_gltf.h", {"garment"}},
    {"gpiod.hpp", {"lab"}},
    {"gpiod.h", {"lab"}},
    {"nlohmann/", {"lab", "samples"}},
    {"CLI/", {"samples"}},
    {"gtest/", {"tests"}},
    {"gmock/", {"tests"}},
    {"benchmark/", {"tests"}},
};

const Folders kSystem{"spawn.h",       "unistd.h",   "fcntl.h",        "time.h",      "signal.h",
                      "pthread.h",     "sched.h",    "immintrin.h",    "xmmintrin.h", "pmmintrin.h",
                      "dlfcn.h",       "stdlib.h",   "glob.h",         "sys/stat.h",  "sys/mman.h",
                      "sys/types.h",   "sys/wait.h", "sys/resource.h", "sys/time.h",  "sys/ioctl.h",
                      "sys/utsname.h", "sys/file.h"};

std::string first_part(const std::string &path) { return path.substr(0, path.find('/')); }

/// The folder of `tsuya/<component>/name.h`.
std::string folder_of_component(const std::string &component) {
    return component == "scene" ? "samples" : component;
}

/// The folders whose rights a file has: of `tests/lab/x.cpp`, tests and lab.
Folders rights_of(const std::string &path, const std::string &folder) {
    if (folder != "tests")
        return {folder};
    const std::string rest = path.substr(path.find('/') + 1);
    return {folder, first_part(rest)};
}

bool meet(const Folders &a, const Folders &b) {
    return std::any_of(a.begin(), a.end(), [&](const std::string &x) { return b.contains(x); });
}

class Checker {
  public:
    explicit Checker(const std::vector<TextFile> &files) {
        for (const TextFile &file : files)
            paths_.insert(file.path);
    }

    /// What is wrong with an include; empty if nothing is.
    std::string problem(const std::string &path, const std::string &target, bool quoted) const {
        const std::string folder = first_part(path);
        if (target.starts_with("tsuya/"))
            return arrow(folder, folder_of_component(first_part(target.substr(6))));
        if (quoted)
            return local(path, folder, target);
        if (target.starts_with("glm/"))
            return "";
        if (target.find_first_of("/.") == std::string::npos)
            return ""; // the standard library
        return third_party(path, folder, target);
    }

  private:
    static std::string arrow(const std::string &from, const std::string &to) {
        if (!kMayInclude.contains(to))
            return "there is no folder '" + to + "'";
        return kMayInclude.at(from).contains(to) ? "" : from + " may not include " + to;
    }

    std::string local(const std::string &path, const std::string &folder,
                      const std::string &target) const {
        const std::filesystem::path own = std::filesystem::path(path).parent_path();
        for (const std::filesystem::path &base :
             {own, std::filesystem::path(folder), std::filesystem::path(folder) / "src"}) {
            const std::string found = (base / target).lexically_normal().generic_string();
            if (!paths_.contains(found))
                continue;
            if (first_part(found) != folder && !tests_of(path, found))
                return folder + " reaches into " + first_part(found) + " by a relative path";
            if (path.find("/include/") != std::string::npos)
                return "a public header includes a private one";
            return "";
        }
        return "no such file in " + folder + "; other projects' headers go in <>";
    }

    /// A test of a folder may look inside it: tests/sdk/x.cpp into sdk/src.
    static bool tests_of(const std::string &path, const std::string &found) {
        return path.starts_with("tests/" + first_part(found) + "/") &&
               found.starts_with(first_part(found) + "/src/");
    }

    static std::string third_party(const std::string &path, const std::string &folder,
                                   const std::string &target) {
        const bool is_public = path.find("/include/") != std::string::npos;
        if (is_public)
            return "a public header may include the standard library, GLM and tsuya/ only";
        if (kSystem.contains(target))
            return "";
        const auto owned = std::find_if(kOwners.begin(), kOwners.end(), [&](const Owned &o) {
            return target.starts_with(o.prefix);
        });
        if (owned == kOwners.end())
            return "no folder owns this header";
        return meet(owned->folders, rights_of(path, folder)) ? ""
                                                             : folder + " does not own this header";
    }

    std::set<std::string> paths_;
};

} // namespace

Findings check_includes(const std::vector<TextFile> &files) {
    static const std::regex kInclude(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    const Checker checker(files);
    Findings findings;
    for (const TextFile &file : files) {
        if (!is_cpp(file.path) || !kMayInclude.contains(first_part(file.path)))
            continue;
        const std::vector<std::string> lines = lines_of(split_cpp(file.text).code);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::smatch match;
            if (!std::regex_search(lines[i], match, kInclude))
                continue;
            const std::string problem = checker.problem(file.path, match[2], match[1] == "\"");
            if (!problem.empty())
                findings.push_back(finding(file, i, match[2].str() + ": " + problem));
        }
    }
    return findings;
}

} // namespace tsuya::project
