#pragma once
/// \file
/// The basic anisotropic reflectance distribution of [Takeda]: the reflectance of a fabric for
/// light from straight above, rho0(theta, phi), as a positive smooth surface through a few measured
/// views.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// One measured view and how well the surface meets it.
struct BardView {
    double theta = 0, phi = 0; ///< radians
    double brdf_per_sr = 0;
    double sigma_per_sr = 0;
    double fitted_per_sr = 0; ///< the surface at that view

    bool operator==(const BardView &) const = default;
};

/// Shape of the interpolation: support of its kernel along weft and warp, in units of the
/// hemisphere's radius sqrt(2) sin(theta/2), and the share of noise in the variance of log rho.
struct BardSmoothness {
    double weft_support = 1.0;
    double warp_support = 1.0;
    double noise_share = 1e-6;

    bool operator==(const BardSmoothness &) const = default;
};

/// rho0 of the upper hemisphere. log rho is interpolated by kernels that are mirrored with the
/// declared symmetry, so that rho0 is positive and C1 everywhere, across mirror planes and at the
/// pole.
class Bard {
  public:
    /// Fits the rows with theta_i = 0; the smoothness with the least leave-one-out error is chosen.
    /// Throws Error naming `where`: fewer than 6 views, all nearer than 20 degrees to the normal,
    /// or all in less than a third of the azimuths that the symmetry leaves; views that contradict
    /// the declared symmetry (mirror images above 1 % of the peak that differ by a factor of 1.6,
    /// root mean square weighted by value, beyond their standard errors); values that reflect more
    /// than twice what they receive, which are no BRDF; as check_table.
    /// Throws Interrupted where progress asks to stop.
    static Bard fit(const ReflectanceTable &table, const std::string &where,
                    const Progress &progress = {});
    /// The same with a smoothness found before: no search.
    static Bard fit(const ReflectanceTable &table, const BardSmoothness &smoothness,
                    const std::string &where, const Progress &progress = {});

    /// rho0 in 1/sr for a unit direction with z >= 0.
    double at(const glm::dvec3 &to_viewer) const;

    /// As the table declared it.
    Symmetry symmetry() const { return symmetry_; }
    /// As given, or found by the fit.
    const BardSmoothness &smoothness() const { return smoothness_; }
    /// The views that were fitted.
    const std::vector<BardView> &views() const { return views_; }
    /// Largest measured value, 1/sr.
    double peak() const { return peak_; }
    /// Root mean square of log10 of the ratio of measured views that the symmetry makes equal: what
    /// was averaged away. 0 where no two views are mirrors of each other.
    double asymmetry() const { return asymmetry_; }
    /// Root mean square of log10(fitted / measured).
    double residual() const;
    bool operator==(const Bard &) const = default;

  private:
    struct Node {
        double x, y, weight;
        bool operator==(const Node &) const = default;
    };
    Bard() = default;
    static Bard fit_with(const BardSmoothness *smoothness, const ReflectanceTable &table,
                         const std::string &where, const Progress &progress);
    void take_views(const ReflectanceTable &table, const std::string &where);
    void finish();
    void check_symmetry(const std::string &where) const;
    void check_albedo(const std::string &where) const;
    double log_at(double x, double y) const;

    Symmetry symmetry_ = Symmetry::orthotropic;
    BardSmoothness smoothness_{};
    std::vector<BardView> views_{};
    std::vector<Node> nodes_{};    ///< one a distinct view
    std::vector<Node> mirrored_{}; ///< nodes with their mirror images
    std::vector<double> log_value_{}, relative_sigma_{};
    double mean_log_ = 0, peak_ = 0, asymmetry_ = 0;
    double contradiction_ = 0; ///< the same of views that noise does not explain
};

} // namespace tsuya
