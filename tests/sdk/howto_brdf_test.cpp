// The example of sdk/docs/howto/brdf.md: a model that Tsuya does not need, the modified Phong lobe.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "models/facets.h"
#include "sdk/brdf_checks.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/frame.h"

namespace tsuya {

// [doc:phong_header]
class PhongCore {
  public:
    static constexpr bool kReciprocal = true;
    static constexpr bool kEnergyLimited = true;

    /// \param reflectance in [0, 1]: an upper bound of the albedo
    /// \param exponent in (0, 10]: the larger, the narrower
    PhongCore(float reflectance, float exponent);
    /// From a file of tables.
    explicit PhongCore(detail::TableReader &from) { each_part(from, *this); }

    WeighedLight weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    glm::vec3 draw(const glm::vec3 &fixed, const glm::vec3 &u) const;
    float albedo(const glm::vec3 &direction) const { return albedo_.at(direction); }

  private:
    template <class F, detail::MaybeConst<PhongCore> T> friend void each_part(F &&f, T &t) {
        auto &[reflectance, exponent, of_albedo] = t;
        f(reflectance, exponent, of_albedo);
    }

    float reflectance_, exponent_;
    AlbedoTable albedo_{};
};

using PhongBrdf = Model<PhongCore>;
// [/doc:phong_header]

// [doc:phong_source]
namespace {
constexpr float kLeastCosine = 1e-3f; // below, the lobe would be denormal and have no digits

glm::vec3 mirrored(const glm::vec3 &d) { return {-d.x, -d.y, d.z}; }
} // namespace

PhongCore::PhongCore(float reflectance, float exponent)
    : reflectance_(reflectance), exponent_(exponent) {
    albedo_ = AlbedoTable(Symmetry::orthotropic, [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, {});
    });
}

// f = reflectance (n + 2) / (2 pi) cos^n a, with a between L and the mirror direction of V:
// [Lafortune]. The density is that of `draw`.
WeighedLight PhongCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const float cosine = glm::dot(to_light, mirrored(to_viewer));
    if (cosine < kLeastCosine)
        return {};
    const float lobe = std::pow(cosine, exponent_) / (2 * kPiF);
    return {reflectance_ * (exponent_ + 2) * lobe * to_light.z, (exponent_ + 1) * lobe};
}

// Around the mirror direction, in proportion to cos^n a. What lies below the horizon is a null
// sample: Model leaves it out.
glm::vec3 PhongCore::draw(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const float cosine = std::pow(u.x, 1 / (exponent_ + 1));
    const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f)), turn = 2 * kPiF * u.y;
    const Frame frame = make_frame(mirrored(fixed));
    return frame.to_world({sine * std::cos(turn), sine * std::sin(turn), cosine});
}

template class Model<PhongCore>;
// [/doc:phong_source]

namespace test {
namespace {

// [doc:phong_test]
TEST(Phong, MeetsTheContract) {
    const AnyBrdf phong = any_brdf(PhongBrdf(0.8f, 8));
    EXPECT_TRUE(check_values(phong).passed);
    EXPECT_TRUE(check_horizon(phong).passed);
    EXPECT_TRUE(check_weights(phong).passed);
    EXPECT_TRUE(check_reciprocity(phong).passed);
    const Energy energy = check_energy(phong, 0.02, 30000);
    EXPECT_TRUE(energy.limit.passed) << energy.limit.where;
    EXPECT_TRUE(energy.albedo.passed) << energy.albedo.worst << " at " << energy.albedo.where;
    EXPECT_TRUE(check_draws(phong, {}, 1).passed);
}
// [/doc:phong_test]

} // namespace
} // namespace test
} // namespace tsuya
