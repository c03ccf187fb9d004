#include "pixel_tolerance.h"

#include <algorithm>
#include <limits>

#include "tsuya/scene/studio.h"
#include "turntable.h"

namespace tsuya::scene {
namespace {

double nearest_in_picture(const Camera &camera, const std::vector<glm::dvec3> &points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3 &p : points) {
        const glm::dvec3 pixel = project_point(camera, p);
        if (pixel.z > 0 && pixel.x >= 0 && pixel.x <= camera.width && pixel.y >= 0 &&
            pixel.y <= camera.height)
            nearest = std::min(nearest, glm::distance(p, camera.eye));
    }
    return nearest;
}

} // namespace

garment::ViewTolerance view_of(const Scene &scene, const std::vector<glm::dvec3> &points,
                               const SceneMesh &mesh) {
    garment::ViewTolerance view{.camera = scene.camera, .pixels = *mesh.tolerance_px};
    const double nearest = nearest_in_picture(scene.camera, points);
    if (nearest < std::numeric_limits<double>::infinity())
        view.nearest = std::max(0.5 * nearest, view.nearest);
    if (scene.camera.orthographic_height) {
        view.farthest = view.nearest;
        for (const Surface &surface : scene.surfaces)
            for (const glm::dvec3 &p : surface.position)
                view.farthest = std::max(view.farthest, glm::distance(p, scene.camera.eye));
    }
    view.camera.eye = mesh.in_mesh(scene.camera.eye);
    view.camera.target = mesh.in_mesh(scene.camera.target);
    view.camera.up = turned(scene.camera.up, glm::dvec3(0.0), -mesh.turn);
    view.light_from_everywhere = scene.environment && scene.environment->picture;
    for (const Light &light : scene.lights)
        if (const auto place = place_of(light))
            view.lights.push_back({.centre = mesh.in_mesh(place->centre), .radius = place->radius});
        else
            view.light_from_everywhere = true; // a sun
    return view;
}

} // namespace tsuya::scene
