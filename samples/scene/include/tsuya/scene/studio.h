#pragma once
/// \file
/// A photographer's studio: a backdrop, softboxes, and a camera that frames what it is shown.

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/scene.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::scene {

/// A floor that bends smoothly into a wall, so that no horizon shows. Seen from the azimuth, the
/// wall stands behind the centre. Lengths in metres.
struct Cyclorama {
    glm::dvec3 centre{0, 0, 0}; ///< a point of the floor
    double azimuth = 0;         ///< radians about +y from +z to +x: where the open side looks
    double width = 10;          ///< > 0
    double front = 4;           ///< of the floor before the centre, > 0
    double back = 2.5;          ///< from the centre to the wall, > radius
    double height = 6;          ///< of the wall, > radius
    double radius = 1.2;        ///< of the bend, > 0
};

/// The surface of a cyclorama: smooth normals, no yarn directions, triangles that look at the
/// centre. Throws Error at `backdrop` for lengths out of range.
Surface make_cyclorama(const Cyclorama &cyclorama);

/// A rectangle of light that faces its target.
struct Softbox {
    glm::dvec3 centre{-2, 2.5, 2};
    glm::dvec3 target{0, 1, 0};
    glm::dvec3 up{0, 1, 0}; ///< the height runs along it as far as it can
    double width = 1;       ///< metres, > 0
    double height = 1;      ///< metres, > 0
    /// Transport of a perfect white diffuser at the target that faces the light: its irradiance
    /// over pi. >= 0
    double strength = 1;
    LightGroupIndex group{};
};

/// The light of a softbox. Throws Error at `softbox`: no distance to the target, `up` along the
/// direction, a length or strength out of range.
RectangleLight make_light(const Softbox &softbox);

/// How a camera looks at what it frames.
struct Framing {
    double azimuth = 0;          ///< radians about +y from +z to +x: where the camera stands
    double elevation = 0;        ///< radians, above the horizon, in (-pi/2, pi/2)
    double vertical_angle = 0.4; ///< full angle of view, radians, in (0, pi)
    double margin = 0.08;        ///< share of half the picture left free on each side, 0 to 0.9
    int width = 800;
    int height = 1000;
    /// Parallel rays, see Camera::orthographic_height: the camera stands clear of all points.
    bool orthographic = false;
    std::optional<double> orthographic_height{}; ///< metres; empty: as the points need
    std::optional<Lens> lens{};                  ///< see Camera
    glm::dvec2 shift{0, 0};                      ///< see Camera: the points are framed with it
};

/// The nearest camera of that direction that sees all points inside its margins, an orthographic
/// one with the least height; its target lies at their distance. Throws Error at `camera` for no
/// point or values out of range.
Camera frame_points(const std::vector<glm::dvec3> &points, const Framing &framing);

/// Where a camera sees a point: x to the right and y downwards, in pixels. z is the distance along
/// the view, not above 0 behind the camera.
glm::dvec3 project_point(const Camera &camera, const glm::dvec3 &point);

/// The unit direction of an azimuth and elevation as used above; of polar angles, see
/// tsuya::direction_of.
glm::dvec3 direction_at(double azimuth, double elevation);

} // namespace tsuya::scene
