#include "tsuya/color/adaptation.h"

#include <glm/matrix.hpp>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// [Lam] XYZ to sharpened cones, rows as printed.
glm::dmat3 bradford() {
    return glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
}

// [CIE159] CAT02, the transform of CIECAM02, rows as printed.
glm::dmat3 cat02() {
    return glm::transpose(
        glm::dmat3(0.7328, 0.4296, -0.1624, -0.7036, 1.6975, 0.0061, 0.0030, 0.0136, 0.9834));
}

} // namespace

std::vector<std::string> adaptation_names() { return {"none", "bradford", "cat02"}; }

Adaptation parse_adaptation(std::string_view name) {
    for (const Adaptation a : {Adaptation::none, Adaptation::bradford, Adaptation::cat02})
        if (name == to_string(a))
            return a;
    const std::vector<std::string> known = adaptation_names();
    throw Error({"there is no adaptation '" + std::string(name) + "'", "adapt",
                 accepted_names(name, known)});
}

std::string to_string(Adaptation adaptation) {
    switch (adaptation) {
    case Adaptation::bradford:
        return "bradford";
    case Adaptation::cat02:
        return "cat02";
    case Adaptation::none:
        break;
    }
    return "none";
}

glm::dmat3 cone_matrix(Adaptation adaptation) {
    switch (adaptation) {
    case Adaptation::bradford:
        return bradford();
    case Adaptation::cat02:
        return cat02();
    case Adaptation::none:
        break;
    }
    return glm::dmat3(1.0);
}

bool can_adapt(Adaptation adaptation, const glm::dvec3 &from_white) {
    if (adaptation == Adaptation::none)
        return true;
    const glm::dvec3 from = cone_matrix(adaptation) * from_white;
    return from.x > 0 && from.y > 0 && from.z > 0;
}

glm::dmat3 adaptation_matrix(Adaptation adaptation, const glm::dvec3 &from_white,
                             const glm::dvec3 &to_white, double degree) {
    if (!(degree >= 0 && degree <= 1))
        throw Error(
            {"the degree of adaptation is " + std::to_string(degree), "degree", "expected 0 to 1"});
    if (adaptation == Adaptation::none)
        return glm::dmat3(1.0);
    const glm::dmat3 cones = cone_matrix(adaptation);
    const glm::dvec3 from = cones * from_white, to = cones * to_white;
    if (!can_adapt(adaptation, from_white))
        throw Error({"no eye can adapt to this lamp: a cone signal of its white is not positive",
                     "adapt", "expected the adaptation none for so narrow a lamp"});
    glm::dmat3 scale(0.0);
    for (int i = 0; i < 3; ++i)
        scale[i][i] = degree * to[i] / from[i] + 1 - degree;
    return glm::inverse(cones) * scale * cones;
}

} // namespace tsuya
