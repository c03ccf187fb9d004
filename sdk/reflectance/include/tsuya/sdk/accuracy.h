#pragma once
/// \file
/// How far a reflectance model lies from a measured or simulated table: several measures, because
/// each of them alone can be small while the cloth looks wrong.
///
///     const Accuracy accuracy = measure_accuracy(table, [&](const auto &l, const auto &v) {
///         return brdf.evaluate(glm::vec3(l), glm::vec3(v));
///     });
///     std::cout << *accuracy.mean.l2_cos;

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// Reflectance in 1/sr, without the cosine, for unit directions with z >= 0. Called from several
/// threads at once.
using BrdfFunction = std::function<double(const glm::dvec3 &to_light, const glm::dvec3 &to_viewer)>;

/// The measures of one light direction, or their means. All are numbers without a unit. Empty where
/// the table cannot tell.
///
/// Let m be the measured value of a view, f the model's, w the view's solid angle and c the cosine
/// of theta_r. Views on the horizon have no part in the measures without a cosine.
struct ErrorMeasures {
    /// mean |f - m| over the views / largest m: the measure of [Takeda]. A huge peak makes it
    /// small.
    std::optional<double> mean_over_peak{};
    /// The same mean over the ring theta_r = 60 degrees alone (within half a degree), over the same
    /// largest m. Where no view lies on it, f - m is interpolated between the nearest rings below
    /// and above; empty where one is missing or they are more than 20 degrees apart.
    std::optional<double> ring_over_peak{};
    /// sqrt(sum w (f c - m c)^2 / sum w (m c)^2)
    std::optional<double> l2_cos{};
    /// sum w f c / sum w m c
    std::optional<double> albedo_ratio{};
    /// 95th percentile (nearest rank) of |log10(f / m)| over the views with m > 0.1 % of the
    /// largest. Infinite where the model is 0 at more than 5 % of them.
    std::optional<double> log_p95{};
    /// What the standard errors alone would make of l2_cos, sqrt(sum w (sigma c)^2 / sum w (m
    /// c)^2): no model can be told from the truth below it. Empty where no view has a standard
    /// error.
    std::optional<double> noise_floor{};
};

/// A measure with its published name.
struct NamedMeasure {
    std::string_view name;
    std::optional<double> ErrorMeasures::*value;
};

/// All measures, in the order of reports.
std::span<const NamedMeasure> error_measures();

/// The accuracy for the views of one light direction.
struct LightAccuracy {
    double theta_i = 0, phi_i = 0; ///< radians; phi from the weft, in [0, 2 pi)
    std::size_t views = 0;
    ErrorMeasures error{};
};

/// The error measures of a model against a table.
struct Accuracy {
    ErrorMeasures mean{}; ///< of the light directions that have the measure, equally weighted
    std::vector<LightAccuracy> directions{}; ///< by theta_i, then phi_i
};

/// Solid angle in sr of each view's share of the hemisphere: what is nearer to it than to any other
/// view. On an even grid this is sin(theta) dtheta dphi, half a ring at the horizon and the cap
/// at the pole. Where the declared symmetry maps the light on itself, as for light from straight
/// above, a view also owns what is nearest to its mirror images; so a measured quadrant is enough,
/// and the sum is always 2 pi. Views in one direction share alike. Areas are counted on a grid of a
/// quarter of a degree: views nearer to each other than that have an error of that order.
/// \param to_viewer unit, z >= 0; at least one
std::vector<double> solid_angles(std::span<const glm::dvec3> to_viewer, const glm::dvec3 &to_light,
                                 Symmetry symmetry);

/// Compares models with every row of a table, light direction by light direction. What does not
/// depend on the model, such as solid angles, is found once.
class TableAccuracy {
  public:
    /// Throws Error for a table without rows; Interrupted where progress asks to stop.
    explicit TableAccuracy(const ReflectanceTable &table, const Progress &progress = {});

    /// Throws Error naming both directions where the model is not finite or negative; Interrupted
    /// where progress asks to stop.
    Accuracy of(const BrdfFunction &model, const Progress &progress = {}) const;
    /// All light is from straight above. A model that is an interpolant of these views looks better
    /// than it is under other light.
    bool only_from_above() const;

  private:
    struct Light {
        std::vector<ReflectanceRow> rows;
        std::vector<double> solid_angle; // of each row's view
    };
    std::vector<Light> lights_{};
};

/// The accuracy of one model. Throws Error as TableAccuracy.
Accuracy measure_accuracy(const ReflectanceTable &table, const BrdfFunction &model,
                          const Progress &progress = {});

} // namespace tsuya
