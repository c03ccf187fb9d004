#pragma once
// Views under one light, and how much each of them counts.

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

struct LitView {
    glm::dvec3 to_viewer; // with a cosine that can be divided by
    double value;
    double solid_angle; // its share of the hemisphere
    // Share of the errors to expect at it that is the model's, not the measurement's: 1 without a
    // standard error, less the larger that is
    double trust = 1;
};

struct LitViews {
    glm::dvec3 to_light;
    std::vector<LitView> views{};

    // \param rows one or more under this light, as if each were
    LitViews(const glm::dvec3 &light, const std::vector<ReflectanceRow> &rows, Symmetry symmetry);
    // The views count as if their standard errors were unknown.
    void forget_sigma();
    // In views without error: the sum of what they are trusted.
    double worth() const;
    // sqrt(sum w (f c - m c)^2 / sum w (m c)^2), as ErrorMeasures::l2_cos, w times the trust.
    double error(const BrdfFunction &model) const;
};

} // namespace tsuya
