#include "scene_meshes.h"

#include <utility>

#include "pixel_tolerance.h"

namespace tsuya::scene {
namespace {

// How meshes are divided before the camera is known, which frames what this gives.
constexpr int kFramingLevel = 1;

} // namespace

Surface SceneMeshes::add(SceneMesh mesh) {
    if (mesh.tolerance_px)
        mesh.options.subdivide.level = kFramingLevel;
    garment::LoadedGarment loaded = load(mesh);
    add_points(loaded.surface.position);
    meshes_.push_back(std::move(mesh));
    reports_.push_back(std::move(loaded.report));
    return std::move(loaded.surface);
}

void SceneMeshes::add_points(const std::vector<glm::dvec3> &points) {
    points_.insert(points_.end(), points.begin(), points.end());
}

void SceneMeshes::refine(Scene &scene) {
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        SceneMesh &mesh = meshes_[m];
        if (!mesh.tolerance_px)
            continue;
        mesh.options.subdivide.view = view_of(scene, points_, *mesh.tolerance_px, mesh.translate);
        garment::LoadedGarment loaded = load(mesh);
        scene.surfaces[m] = std::move(loaded.surface);
        reports_[m] = std::move(loaded.report);
    }
}

garment::LoadedGarment SceneMeshes::load(const SceneMesh &mesh) const {
    garment::LoadedGarment loaded = garment::load(mesh.file, mesh.options, mesh.where, progress_);
    for (glm::dvec3 &p : loaded.surface.position)
        p += mesh.translate;
    return loaded;
}

} // namespace tsuya::scene
