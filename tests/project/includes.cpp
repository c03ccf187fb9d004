#include "project/includes.h"

#include "project/comments.h"

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace tsuya::project {
namespace {

using Folders = std::set<std::string>;

/// A folder of the layering, and the layers that it may include besides itself.
struct Layer {
    std::string folder;
    Folders below;
};

/// From the ground up: a layer knows only layers that stand before it.
const std::vector<Layer> kLayers{
    {"sdk/values", {}},
    {"sdk/reflectance", {"sdk/values"}},
    {"sdk/render", {"sdk/values", "sdk/reflectance"}},
    {"garment", {"sdk/values"}},
    {"color", {"sdk/values"}},
    {"lab/rig", {"sdk/values"}},
    {"lab/session", {"sdk/values", "lab/rig"}},
    {"lab/weave", {"sdk/values", "color"}},
    {"lab/goniometer", {"sdk/values", "color", "lab/weave"}},
    {"lab/measure", {"sdk/values", "color", "lab/rig", "lab/session"}},
    {"samples/scene",
     {"sdk/values", "sdk/reflectance", "sdk/render", "garment", "color", "lab/rig", "lab/session",
      "lab/weave", "lab/goniometer", "lab/measure"}},
    {"samples",
     {"sdk/values", "sdk/reflectance", "sdk/render", "garment", "color", "lab/rig", "lab/session",
      "lab/weave", "lab/goniometer", "lab/measure", "samples/scene"}},
    {"tests",
     {"sdk/values", "sdk/reflectance", "sdk/render", "garment", "color", "lab/rig", "lab/session",
      "lab/weave", "lab/goniometer", "lab/measure", "samples/scene", "samples"}},
};

/// Rooms of a layer's `src`, from the ground up: a room includes rooms that stand before it.
const std::map<std::string, std::vector<std::string>> kRooms{
    {"sdk/reflectance", {"views", "tables", "models", "fabric"}},
    {"garment", {"mesh", "files", "repair", "limit"}},
};

struct Owned {
    std::string prefix; ///< how the include path starts
    Folders layers;
};

/// Headers of other projects. What `tests/x` tests, it may also use as a second opinion.
const std::vector<Owned> kOwners{
    {"embree3/", {"sdk/render", "lab/goniometer"}},
    {"embree4/", {"sdk/render", "lab/goniometer"}},
    {"tbb/", {"sdk/values", "sdk/reflectance", "sdk/render", "garment", "color", "lab/goniometer"}},
    {"oneapi/",
     {"sdk/values", "sdk/reflectance", "sdk/render", "garment", "color", "lab/goniometer"}},
    {"Eigen/", {"sdk/values", "sdk/reflectance", "color"}},
    {"toml++/", {"sdk/values"}},
    {"OpenColorIO/", {"color"}},
    {"lcms2.h", {"color"}},
    {"pugixml.hpp", {"color"}},
    {"OpenImageIO/", {"color"}},
    {"zlib.h", {"color"}},
    {"png.h", {"color"}},
    {"ft2build.h", {"color"}},
    {"Imf", {"color"}},
    {"OpenMesh/", {"garment"}},
    {"assimp/", {"garment"}},
    {"opensubdiv/", {"garment"}},
    {"draco/", {"garment"}},
    {"meshoptimizer.h", {"garment"}},
    {"tiny_gltf.h", {"garment"}},
    {"gpiod.hpp", {"lab/rig"}},
    {"gpiod.h", {"lab/rig"}},
    {"nlohmann/", {"garment", "lab/session", "samples"}},
    {"CLI/", {"samples"}},
    {"gtest/", {"tests"}},
    {"gmock/", {"tests"}},
    {"benchmark/", {"tests"}},
};

const Folders kSystem{"spawn.h",        "unistd.h",   "fcntl.h",     "poll.h",        "time.h",
                      "signal.h",       "pthread.h",  "sched.h",     "immintrin.h",   "xmmintrin.h",
                      "pmmintrin.h",    "dlfcn.h",    "link.h",      "stdlib.h",      "glob.h",
                      "sys/stat.h",     "sys/mman.h", "sys/prctl.h", "sys/types.h",   "sys/wait.h",
                      "sys/resource.h", "sys/time.h", "sys/ioctl.h", "sys/utsname.h", "sys/file.h",
                      "sys/mount.h",    "termios.h"};

std::string first_part(const std::string &path) { return path.substr(0, path.find('/')); }

/// The layer that a file belongs to; null outside of them.
const Layer *layer_of(const std::string &path) {
    const auto layer = std::find_if(kLayers.begin(), kLayers.end(), [&](const Layer &l) {
        return path.starts_with(l.folder + "/");
    });
    return layer == kLayers.end() ? nullptr : &*layer;
}

/// The path of a source below the `src` of its layer; empty for other files.
std::string below_src(const std::string &path, const Layer &layer) {
    const std::string src = layer.folder + "/src/";
    return path.starts_with(src) ? path.substr(src.size()) : "";
}

/// Position of a source's room in its layer; past the last for what stands above the rooms.
std::size_t room_of(const std::string &path, const Layer &layer,
                    const std::vector<std::string> &rooms) {
    const std::string below = below_src(path, layer);
    return static_cast<std::size_t>(std::find(rooms.begin(), rooms.end(), first_part(below)) -
                                    rooms.begin());
}

/// `tests/lab/x.cpp` looks into `lab/rig` and the other layers of lab.
bool tests_of(const std::string &path, const std::string &layer) {
    return path.starts_with("tests/" + first_part(layer) + "/");
}

class Checker {
  public:
    explicit Checker(const std::vector<TextFile> &files) {
        for (const TextFile &file : files)
            paths_.insert(file.path);
    }

    /// What is wrong with an include; empty if nothing is.
    std::string problem(const std::string &path, const std::string &target, bool quoted) const {
        const Layer &layer = *layer_of(path);
        if (target.starts_with("tsuya/"))
            return arrow(layer, target);
        if (quoted)
            return local(path, layer, target);
        if (target.starts_with("glm/"))
            return "";
        if (target.find_first_of("/.") == std::string::npos)
            return ""; // the standard library
        return third_party(path, layer, target);
    }

  private:
    std::string arrow(const Layer &from, const std::string &target) const {
        const auto owner = std::find_if(kLayers.begin(), kLayers.end(), [&](const Layer &l) {
            return paths_.contains(l.folder + "/include/" + target);
        });
        if (owner == kLayers.end())
            return "no layer has this header";
        const bool known = owner->folder == from.folder || from.below.contains(owner->folder);
        return known ? "" : from.folder + " may not include " + owner->folder;
    }

    std::string local(const std::string &path, const Layer &layer,
                      const std::string &target) const {
        std::vector<std::filesystem::path> bases{std::filesystem::path(path).parent_path(),
                                                 layer.folder,
                                                 std::filesystem::path(layer.folder) / "src"};
        for (const Layer &other : kLayers)
            if (tests_of(path, other.folder))
                bases.push_back(std::filesystem::path(other.folder) / "src");
        for (const std::filesystem::path &base : bases) {
            const std::string found = (base / target).lexically_normal().generic_string();
            if (paths_.contains(found))
                return inside(path, layer, found);
        }
        return "no such file in " + layer.folder + "; other projects' headers go in <>";
    }

    /// What is wrong with including a file that is no public header.
    static std::string inside(const std::string &path, const Layer &layer,
                              const std::string &found) {
        const Layer *const owner = layer_of(found);
        if (!owner || (owner->folder != layer.folder &&
                       !(tests_of(path, owner->folder) && !below_src(found, *owner).empty())))
            return layer.folder + " reaches into " + first_part(found) + " by a relative path";
        if (path.find("/include/") != std::string::npos)
            return "a public header includes a private one";
        const auto rooms = kRooms.find(layer.folder);
        if (rooms != kRooms.end() &&
            room_of(found, layer, rooms->second) > room_of(path, layer, rooms->second))
            return "the room of " + found + " stands above";
        return "";
    }

    static std::string third_party(const std::string &path, const Layer &layer,
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
            return "no layer owns this header";
        const bool may =
            std::any_of(owned->layers.begin(), owned->layers.end(), [&](const std::string &l) {
                return l == layer.folder || tests_of(path, l);
            });
        return may ? "" : layer.folder + " does not own this header";
    }

    std::set<std::string> paths_;
};

} // namespace

Findings check_includes(const std::vector<TextFile> &files) {
    static const std::regex kInclude(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    const Checker checker(files);
    Findings findings;
    for (const TextFile &file : files) {
        if (!is_cpp(file.path) || !layer_of(file.path))
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
