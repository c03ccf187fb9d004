#pragma once
/// \file
/// From where a scene is looked at.

#include <optional>

#include <glm/glm.hpp>

namespace tsuya {

/// A thin lens: what lies at one distance is sharp, the rest is blurred to disks. The picture is as
/// bright as without a lens, and its angle of view stays, wherever the lens is focused.
struct Lens {
    double f_number = 2.8;        ///< focal length over the diameter of the aperture, 0.01 to 1e6
    double sensor_height = 0.036; ///< of the picture on the sensor, metres, 1e-6 to 1e6
    /// Along the view from the eye to the plane that is sharp, metres, above 0; empty: the
    /// target's.
    std::optional<double> focus_distance{};
    int blades = 0; ///< of the aperture: 0 for a disk, 3 to 16 for a polygon with a corner above
};

/// A camera: perspective through a pinhole or a lens, or orthographic.
struct Camera {
    glm::dvec3 eye{0, 1, 3};
    glm::dvec3 target{0, 1, 0};
    glm::dvec3 up{0, 1, 0};
    double vertical_angle = 0.6; ///< full angle of view, radians, in (0, pi); of a perspective
    int width = 800;
    int height = 1000;
    /// Metres of the scene from the lower to the upper edge of the picture, above 0: rays are
    /// parallel, and begin in the plane through the eye. Empty: a perspective.
    std::optional<double> orthographic_height{};
    std::optional<Lens> lens{}; ///< of a perspective; empty: a pinhole, everything is sharp
    /// Shares of the picture's width and height, within -10 and 10, by which its frame is moved to
    /// the right and upwards. The view stays: upright edges seen by a level camera stay parallel.
    glm::dvec2 shift{0, 0};
};

/// Unit directions of a picture, orthonormal.
struct CameraAxes {
    glm::dvec3 right, up, forward;
};

/// The axes of a camera that looks somewhere.
CameraAxes axes_of(const Camera &camera);

/// Metres of the scene that a pixel in the middle of a picture without shift sees, at a distance
/// from the eye.
double pixel_width(const Camera &camera, double distance);

/// From the eye to the plane of a point, along the view, metres; not above 0 behind the camera.
double distance_along_view(const Camera &camera, const glm::dvec3 &point);

/// The distance at which a camera with a lens is sharp, metres.
double focus_distance(const Camera &camera);

/// Half the diameter of the aperture, metres; 0 without a lens. The focal length f is that of a
/// lens which, focused at the distance s, has the camera's angle of view: 1/f = 1/s + 1/b with the
/// sensor's height over 2 b the tangent of half the angle.
double aperture_radius(const Camera &camera);

} // namespace tsuya
