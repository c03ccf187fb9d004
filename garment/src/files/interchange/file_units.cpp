#include "files/interchange/file_units.h"

#include <array>
#include <cmath>
#include <sstream>

#include <assimp/scene.h>

namespace tsuya::garment {
namespace {

std::string text_of(double metres) {
    std::ostringstream text;
    text.precision(4);
    text << metres << " m";
    return text.str();
}

constexpr const char *kDone = "read in metres with y up";

FileUnits units_with(double metres, const std::string &up) {
    if (std::abs(metres - 1.0) < 1e-9 && up == "y")
        return {};
    return {.stated = "the file is in units of " + text_of(metres) + " with " + up + " up",
            .action = kDone};
}

/// A direction that the file's settings name by the number and the sign of an axis; 0 where they
/// name none.
glm::dvec3 axis_of(const aiMetadata &settings, const char *axis) {
    std::int32_t number = -1, sign = 1;
    settings.Get(axis, number);
    settings.Get(std::string(axis) + "Sign", sign);
    glm::dvec3 direction(0.0);
    if (number >= 0 && number < 3)
        direction[number] = sign < 0 ? -1.0 : 1.0;
    return direction;
}

/// FBX states centimetres a unit, and which axes are right, up and front; Assimp leaves both as
/// they are.
FileUnits units_of_fbx(const aiScene &scene) {
    double centimetres = 1.0;
    glm::dvec3 right(1, 0, 0), up(0, 1, 0), front(0, 0, 1);
    if (const aiMetadata *const settings = scene.mMetaData) {
        float narrow = 0;
        if (!settings->Get("UnitScaleFactor", centimetres) &&
            settings->Get("UnitScaleFactor", narrow))
            centimetres = static_cast<double>(narrow);
        const glm::dmat3 stated(axis_of(*settings, "CoordAxis"), axis_of(*settings, "UpAxis"),
                                axis_of(*settings, "FrontAxis"));
        if (glm::determinant(stated) != 0.0) {
            right = stated[0];
            up = stated[1];
            front = stated[2];
        }
    }
    if (!(centimetres > 0.0) || !std::isfinite(centimetres))
        centimetres = 1.0;
    const double metres = 0.01 * centimetres;
    FileUnits units = units_with(metres, up.x != 0.0 ? "x" : up.y != 0.0 ? "y" : "z");
    units.to_metres = glm::dmat4(metres * glm::transpose(glm::dmat3(right, up, front)));
    return units;
}

/// Assimp's root turns and scales as the file's asset says.
FileUnits units_of_collada(const aiScene &scene) {
    if (!scene.mRootNode)
        return {};
    const aiMatrix4x4 &root = scene.mRootNode->mTransformation;
    const double metres = std::cbrt(std::abs(static_cast<double>(root.Determinant())));
    const std::array<double, 3> up{std::abs(static_cast<double>(root.b1)),
                                   std::abs(static_cast<double>(root.b2)),
                                   std::abs(static_cast<double>(root.b3))};
    return units_with(metres, up[1] >= up[0] && up[1] >= up[2] ? "y" : up[2] >= up[0] ? "z" : "x");
}

} // namespace

FileUnits units_of(const aiScene &scene, const std::string &extension) {
    if (extension == ".fbx")
        return units_of_fbx(scene);
    if (extension == ".dae")
        return units_of_collada(scene);
    return {.stated = "STL states no unit and no axis",
            .action =
                std::string(kDone) + "; state others by --unit and --up, in a scene unit and up"};
}

} // namespace tsuya::garment
