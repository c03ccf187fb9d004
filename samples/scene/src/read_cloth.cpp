#include "tsuya/scene/read_cloth.h"

#include "tsuya/lab/weave_face.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

/// Line and column of a key of `[weave]`.
std::string place_of(const std::filesystem::path &file, const char *key) {
    const Document document(file);
    const auto section = document.root().section("weave");
    return section ? section->where(key) : file.string();
}

lab::Weave weave_of(const ClothWeave &weave, const std::filesystem::path &file) {
    if (!weave.file.empty()) {
        const std::filesystem::path path = file.parent_path() / weave.file;
        if (!std::filesystem::exists(path))
            throw Error({"there is no file '" + path.string() + "'", place_of(file, "file"),
                         "expected a weave (.toml) or a draft (.wif)"});
        return lab::read_weave(path);
    }
    try {
        return lab::weave(weave.preset, "");
    } catch (const Error &error) {
        throw error.at(place_of(file, "preset"));
    }
}

} // namespace

Fabric read_cloth(const std::filesystem::path &file, const Progress &progress) {
    Fabric fabric = read_fabric(file, progress);
    if (fabric.weave)
        fabric.weave->map =
            lab::face_of(weave_of(*fabric.weave, file), lab::kFacePlaces, {}, progress);
    return fabric;
}

} // namespace tsuya::scene
