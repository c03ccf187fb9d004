#include "lab/rendered_patch.h"

#include <cmath>

#include "tsuya/sdk/render.h"

namespace tsuya::test {
namespace {

constexpr double kHalf_m = 0.03; // of the patch's side

/// A direction from (weft, warp, normal) into the scene, where the patch looks up along y.
glm::dvec3 in_scene(const glm::dvec3 &d) { return {d.x, d.z, -d.y}; }

Surface patch() {
    const double h = kHalf_m;
    return {.position = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}},
            .normal = std::vector<glm::vec3>(4, {0, 1, 0}),
            .warp = std::vector<glm::vec3>(4, {0, 0, -1}),
            .triangle = {{0, 1, 2}, {0, 2, 3}}};
}

/// A square that lights a surface across its beam with the irradiance pi.
RectangleLight lamp(const glm::dvec3 &to_light, double distance, double angle) {
    const double side = 2 * distance * std::tan(angle / 2);
    const glm::dvec3 helper =
        std::abs(to_light.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = side * glm::normalize(glm::cross(helper, to_light));
    const glm::dvec3 v = glm::cross(u, to_light); // cross(u, v) looks to the patch
    return {.corner = distance * to_light - 0.5 * u - 0.5 * v,
            .edge_u = u,
            .edge_v = v,
            .radiance = kPi * distance * distance / (side * side)};
}

} // namespace

Image RenderedPatch::render(const lab::PlannedFrame &frame, int width, int height) const {
    const DirectionPair &at = frame.directions;
    // Rows of the picture fall towards the camera, as in lattice_in_picture().
    const glm::dvec3 up = direction_of(at.theta_r + kPi / 2, at.phi_r);
    Scene scene;
    scene.surfaces = {patch()};
    scene.fabrics = {frame.kind == lab::FrameKind::white
                         ? Fabric{.name = "white", .colours = {.dye = Spectrum::constant(0.99)}}
                         : cloth};
    scene.objects = {{"patch", {0}, {0}}};
    scene.lights = {lamp(in_scene(at.to_light()), lamp_m, lamp_angle)};
    scene.camera = {.eye = camera_m * in_scene(at.to_viewer()),
                    .target = {0, 0, 0},
                    .up = -in_scene(up),
                    .vertical_angle = 2 * std::atan(height * pixel_m / 2 / camera_m),
                    .width = width,
                    .height = height};
    const SpectralImage seen =
        tsuya::render(scene, {.stop = {.samples_per_pixel = samples},
                              .channels = 8,
                              .max_bounces = 0,
                              .threads = 1,
                              .seed = static_cast<std::uint32_t>(frame.view)})
            .image;
    Image image = Image::make(width, height, {"Y"});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.pixel(x, y)[0] = seen.pixel(0, x, y)[4]; // the cloth is black: all are alike
    return image;
}

} // namespace tsuya::test
