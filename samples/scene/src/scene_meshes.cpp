#include "scene_meshes.h"

#include <utility>

#include "pixel_tolerance.h"
#include "turntable.h"

namespace tsuya::scene {
namespace {

// How meshes are divided before the camera is known, which frames what this gives.
constexpr int kFramingLevel = 1;

} // namespace

glm::dvec3 SceneMesh::in_scene(const glm::dvec3 &point) const {
    return turned(point, glm::dvec3(0.0), turn) + translate;
}

glm::dvec3 SceneMesh::in_mesh(const glm::dvec3 &point) const {
    return turned(point - translate, glm::dvec3(0.0), -turn);
}

void SceneMesh::stand(Surface &surface) const {
    if (turn != 0)
        surface = turned(surface, glm::dvec3(0.0), turn);
    for (glm::dvec3 &p : surface.position)
        p += translate;
}

Surface SceneMeshes::add(SceneMesh mesh) {
    if (mesh.tolerance_px)
        mesh.options.subdivide.level = kFramingLevel;
    meshes_.push_back(std::move(mesh));
    moving_.emplace_back();
    garment::LoadedGarment loaded = load(meshes_.size() - 1);
    add_points(loaded.surface.position);
    add_further_points(meshes_.back());
    reports_.push_back(std::move(loaded.report));
    return std::move(loaded.surface);
}

void SceneMeshes::add_points(const std::vector<glm::dvec3> &points) {
    points_.insert(points_.end(), points.begin(), points.end());
}

void SceneMeshes::add_further_points(const SceneMesh &mesh) {
    const garment::PolygonMesh &faces = mesh.file.mesh;
    std::vector<bool> used(faces.position.size());
    for (const std::uint32_t v : faces.corner_position)
        used[v] = true;
    for (const std::vector<glm::dvec3> &shape : mesh.further)
        for (std::size_t v = 0; v < shape.size(); ++v)
            if (used[v])
                points_.push_back(mesh.in_scene(garment::in_metres(mesh.options, shape[v])));
}

void SceneMeshes::refine(Scene &scene) {
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        SceneMesh &mesh = meshes_[m];
        if (!mesh.tolerance_px)
            continue;
        mesh.options.subdivide.view = view_of(scene, points_, mesh);
        garment::LoadedGarment loaded = load(m);
        scene.surfaces[m] = std::move(loaded.surface);
        reports_[m] = std::move(loaded.report);
    }
}

garment::LoadedGarment SceneMeshes::load(std::size_t m) {
    const SceneMesh &mesh = meshes_[m];
    garment::LoadedGarment loaded;
    const bool last = !mesh.tolerance_px || mesh.options.subdivide.view;
    if (mesh.further.empty() || !last) {
        loaded = garment::load(mesh.file, mesh.options, mesh.where, progress_);
    } else {
        moving_[m].emplace(mesh.file, mesh.options, mesh.where, progress_);
        loaded = moving_[m]->first();
    }
    mesh.stand(loaded.surface);
    return loaded;
}

void SceneMeshes::show(std::size_t m, std::size_t frame, Surface &surface) {
    if (frame == 0)
        surface = moving_[m]->first().surface;
    else
        moving_[m]->frame(meshes_[m].further[frame - 1], surface);
    meshes_[m].stand(surface);
}

} // namespace tsuya::scene
