// The camera of a scene file.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene_reader.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::scene {
namespace {

// A time that is not known, since what is given as `at` is wrong.
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

void check_view(const Section &section, const glm::dvec3 &eye, const glm::dvec3 &target,
                const glm::dvec3 &up) {
    if (!(glm::length(glm::cross(target - eye, up)) > 0))
        section.problem("target", "the camera looks nowhere or along its up direction",
                        "expected eye and target apart, and up not parallel to the view");
}

} // namespace

void SceneReader::read_camera() {
    Framing &framing = file_.framing;
    framing = {.azimuth = 25 * kDegree, .elevation = 3 * kDegree, .vertical_angle = 24 * kDegree};
    const auto camera = root_.section("camera");
    if (!camera)
        return;
    framing.width = camera->integer("width", 1, 32768).value_or(framing.width);
    framing.height = camera->integer("height", 1, 32768).value_or(framing.height);
    framing.vertical_angle = camera->number("vertical_angle_deg", 0.1, 179).value_or(24) * kDegree;
    read_projection(*camera);
    if (camera->has("path"))
        return read_path(*camera);
    const auto eye = camera->vector("eye"), target = camera->vector("target"),
               up = camera->vector("up");
    if (!eye) {
        if (target || up)
            camera->problem(target ? "target" : "up", "the camera has no eye",
                            "expected eye with target and up, or azimuth_deg and elevation_deg");
        return read_framing(*camera);
    }
    for (const char *key : {"azimuth_deg", "elevation_deg", "margin"})
        if (camera->has(key))
            camera->problem(key, std::string(key) + " has no meaning beside eye",
                            "expected eye, target and up, or a camera that frames by itself");
    if (!target)
        camera->problem("target", "'target' is missing", "expected a point beside eye");
    file_.camera = Camera{.eye = *eye,
                          .target = target.value_or(*eye - glm::dvec3(0, 0, 1)),
                          .up = up.value_or(glm::dvec3(0, 1, 0)),
                          .vertical_angle = framing.vertical_angle,
                          .width = framing.width,
                          .height = framing.height,
                          .orthographic_height = framing.orthographic_height,
                          .lens = framing.lens,
                          .shift = framing.shift};
    if (framing.orthographic && !framing.orthographic_height)
        camera->problem("projection", "'orthographic_height' is missing",
                        "expected metres beside eye, such as orthographic_height = 1.8");
    if (target)
        check_view(*camera, *eye, *target, file_.camera->up);
}

CameraKey SceneReader::read_key(const Section &section, const glm::dvec3 &up,
                                double vertical_angle) {
    if (!section.has("at"))
        section.problem("at", "'at' is missing", "expected a number from 0 to 1");
    CameraKey key{.at = section.number("at", 0, 1).value_or(kNoTime)};
    const auto eye = section.vector("eye"), target = section.vector("target");
    for (const auto &[name, given] : {std::pair("eye", &eye), std::pair("target", &target)})
        if (!*given && !section.has(name))
            section.problem(name, "'" + std::string(name) + "' is missing",
                            "expected a point such as [0, 1, 3]");
    key.eye = eye.value_or(key.eye);
    key.target = target.value_or(key.target);
    if (eye && target)
        check_view(section, key.eye, key.target, up);
    const auto angle_deg = section.number("vertical_angle_deg", 0.1, 179);
    key.vertical_angle = angle_deg ? *angle_deg * kDegree : vertical_angle;
    return key;
}

void SceneReader::read_path(const Section &camera) {
    const Framing &framing = file_.framing;
    for (const char *key : {"eye", "target", "azimuth_deg", "elevation_deg", "margin"})
        if (camera.has(key))
            camera.problem(key, std::string(key) + " has no meaning beside a path",
                           "expected it in [[camera.path]], or no path");
    if (framing.orthographic)
        camera.problem("projection", "a camera on a path has a perspective",
                       "expected no projection, or no path");
    const glm::dvec3 up = camera.vector("up").value_or(glm::dvec3(0, 1, 0));
    std::vector<CameraKey> &path = file_.camera_path;
    for (const Section &section : camera.list("path")) {
        const CameraKey key = read_key(section, up, framing.vertical_angle);
        if (!path.empty() && key.at <= path.back().at)
            section.problem("at", "'at' does not rise", "expected keys in the order of their time");
        path.push_back(key);
    }
    if (path.empty())
        return;
    const bool timed =
        std::ranges::none_of(path, [](const CameraKey &key) { return std::isnan(key.at); });
    const bool whole = path.size() >= 2 && path.front().at == 0 && path.back().at == 1;
    if (timed && !whole)
        camera.problem("path", "the path has no beginning or no end",
                       "expected [[camera.path]] twice or more, from at = 0 to at = 1");
    file_.camera = Camera{.eye = path.front().eye,
                          .target = path.front().target,
                          .up = up,
                          .vertical_angle = path.front().vertical_angle,
                          .width = framing.width,
                          .height = framing.height,
                          .lens = framing.lens,
                          .shift = framing.shift};
}

void SceneReader::read_framing(const Section &camera) {
    Framing &framing = file_.framing;
    framing.azimuth = camera.number("azimuth_deg", -360, 360).value_or(25) * kDegree;
    framing.elevation = camera.number("elevation_deg", -89, 89).value_or(3) * kDegree;
    framing.margin = camera.number("margin", 0, 0.9).value_or(framing.margin);
}

void SceneReader::read_projection(const Section &camera) {
    Framing &framing = file_.framing;
    if (const auto projection = camera.text("projection")) {
        framing.orthographic = *projection == "orthographic";
        if (!framing.orthographic && *projection != "perspective")
            camera.problem("projection", "no projection '" + *projection + "'",
                           "expected perspective or orthographic");
    }
    framing.orthographic_height = camera.number("orthographic_height", kSmallest, kLargest);
    if (framing.orthographic_height && !framing.orthographic)
        camera.problem("orthographic_height", "orthographic_height has no meaning in a perspective",
                       "expected projection = \"orthographic\" beside it");
    if (framing.orthographic && camera.has("vertical_angle_deg"))
        camera.problem("vertical_angle_deg", "parallel rays have no angle of view",
                       "expected orthographic_height, or projection = \"perspective\"");
    if (const auto shift = camera.numbers("shift")) {
        if (shift->size() == 2 && std::abs((*shift)[0]) <= 10 && std::abs((*shift)[1]) <= 10)
            framing.shift = {(*shift)[0], (*shift)[1]};
        else
            camera.problem("shift", "'shift' is no shift of the picture",
                           "expected shares of its width and height from -10 to 10, such as "
                           "[0, 0.1]");
    }
    read_lens(camera);
}

void SceneReader::read_lens(const Section &camera) {
    const auto f_number = camera.number("f_number", 0.01, kLargest);
    for (const char *key : {"sensor_height_mm", "focus_distance", "focus", "aperture_blades"})
        if (camera.has(key) && !f_number) {
            camera.problem(key, std::string(key) + " has no meaning without f_number",
                           "expected f_number, such as 2.8");
            // Its value is looked at all the same, so that it is no unknown key
        }
    Lens lens;
    lens.f_number = f_number.value_or(lens.f_number);
    lens.sensor_height = camera.number("sensor_height_mm", 1e-3, kLargest).value_or(36) / 1000;
    lens.focus_distance = camera.number("focus_distance", kSmallest, kLargest);
    file_.focus = camera.vector("focus");
    if (file_.focus && lens.focus_distance)
        camera.problem("focus", "focus and focus_distance are both given", "expected one of them");
    lens.blades = camera.integer("aperture_blades", 0, 16).value_or(0);
    if (lens.blades == 1 || lens.blades == 2)
        camera.problem("aperture_blades", std::to_string(lens.blades) + " blades",
                       "expected 0 for a round aperture, or 3 to 16");
    if (!f_number)
        return;
    if (file_.framing.orthographic)
        camera.problem("f_number", "an orthographic camera has no lens",
                       "expected f_number or projection = \"orthographic\"");
    file_.framing.lens = lens;
}

} // namespace tsuya::scene
