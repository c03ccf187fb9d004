// A material's parts together: the coloured part below the surface, as it is asked for by a dye.

#include "shading.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::test {
namespace {

constexpr int kEvaluations = 60000;
constexpr double kRed = 640, kBlue = 450;

Fabric dyed(std::optional<double> delustre) {
    return {.name = "satin",
            .specular = CarriedViews{.bard = bard_of(satin_cloth()), .f0 = 0.05},
            .colours = {.dye = {{500, 600}, {0.05, 0.6}}, .delustre = delustre}};
}

struct Cloth {
    Material material;
    Shading shading;

    explicit Cloth(const Fabric &fabric)
        : material(resolve(fabric, "satin")),
          shading(material,
                  {.dye = 0.3f,
                   .transmittance = material.transmittance.any_above_zero() ? 0.1f : 0.0f,
                   .specular = 1,
                   .body = 0.3f},
                  false) {}

    // f cos of what was inside the filaments, 1/sr
    double coloured(const glm::vec3 &light, const glm::vec3 &view, double nm) const {
        const Response r = shading.weigh(light, view, shading.view_terms(view)).f_cos;
        return r.diffuse * material.dye.at(nm) + r.warp_body * material.warp_body.at(nm) +
               r.weft_body * material.weft_body.at(nm);
    }
    double reflected(const glm::vec3 &view, double nm) const {
        return integrate([&](const glm::vec3 &l) { return coloured(l, view, nm); }, kEvaluations);
    }
    // As a spectrophotometer with light at 8 degrees and the specular part excluded has it
    double measured(double nm) const {
        return 0.5 * (reflected(glm::vec3(direction(8, 0)), nm) +
                      reflected(glm::vec3(direction(8, 90)), nm));
    }
};

TEST(Shading, ReflectsAtTheSpectrophotometerWhatTheDyeSays) {
    for (const std::optional<double> delustre :
         {std::optional<double>(), std::optional(0.0), std::optional(0.4), std::optional(1.0)}) {
        const Cloth cloth(dyed(delustre));
        EXPECT_NEAR(cloth.measured(kRed), 0.6, 0.004) << delustre.value_or(-1);
        EXPECT_NEAR(cloth.measured(kBlue), 0.05, 0.0004) << delustre.value_or(-1);
    }
    // Control: the surface takes more than the tolerance
    const Cloth cloth(dyed(1));
    EXPECT_GT(cloth.material.dye.at(kRed), 0.61);
}

TEST(Shading, ReflectsNoMoreThanArrives) {
    Fabric white = dyed(0.3);
    white.colours.dye = Spectrum::constant(0.7);
    white.colours.transmittance = Spectrum::constant(0.3);
    const Cloth cloth(white);
    const double through = cloth.material.transmittance.at(kRed);
    for (const double theta : {0.0, 30.0, 60.0, 80.0, 87.0})
        for (const double phi : {0.0, 35.0, 90.0}) {
            const glm::vec3 view(direction(theta, phi));
            const ViewTerms terms = cloth.shading.view_terms(view);
            const auto all = [&](const glm::vec3 &l) {
                const Response front = cloth.shading.weigh(l, view, terms).f_cos;
                const Response behind = cloth.shading.weigh({l.x, l.y, -l.z}, view, terms).f_cos;
                return cloth.coloured(l, view, kRed) + front.weft + front.warp +
                       behind.transmitted * through;
            };
            EXPECT_LE(integrate(all, kEvaluations), 1.02) << theta << " " << phi;
        }
}

// As a function for comparisons it is what is rendered.
TEST(Shading, RendersTheColouredPart) {
    const Cloth cloth(dyed({}));
    const BrdfFunction part = coloured_part(cloth.material, kRed);
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        const double rendered = cloth.coloured(light, view, kRed);
        EXPECT_NEAR(part(light, view) * light.z, rendered, 1e-5 + 1e-5 * rendered);
    }
}

// A delustre of 1 is the Lambertian part below the surface, to the last bit.
TEST(Shading, FullDelustreIsLambertian) {
    const Cloth cloth(dyed(1));
    EXPECT_FALSE(cloth.material.body);
    Material plain = cloth.material;
    plain.dye = Spectrum::constant(0.5);
    const Shading shading(plain, {.dye = 0.3f, .specular = 1, .body = 0.3f}, false);
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        const ViewTerms terms = cloth.shading.view_terms(view);
        const float specular_albedo = cloth.material.specular->albedo_of_light(light);
        const float expected = light.z / kPiF * terms.diffuse_scale * (1 - specular_albedo);
        const Weighed w = cloth.shading.weigh(light, view, terms);
        EXPECT_FLOAT_EQ(w.f_cos.diffuse, expected);
        EXPECT_EQ(w.f_cos.warp_body + w.f_cos.weft_body, 0);
        const Weighed p = shading.weigh(light, view, shading.view_terms(view));
        EXPECT_EQ(w.f_cos.diffuse, p.f_cos.diffuse);
        EXPECT_EQ(w.pdf, p.pdf);
    }
}

// Warp and weft of a shot silk show their own dyes, each along its own yarns.
TEST(Shading, DyesOfWarpAndWeftShowAlongTheirYarns) {
    Fabric shot = dyed(0.1);
    shot.colours.warp_dye = {{500, 600}, {0.02, 0.5}}; // red
    shot.colours.weft_dye = {{500, 600}, {0.5, 0.02}}; // blue
    const Cloth cloth(shot);
    const auto redness = [&](const glm::vec3 &light, const glm::vec3 &view) {
        return cloth.coloured(light, view, kRed) / cloth.coloured(light, view, kBlue);
    };
    const auto low = [](double theta, double phi) { return glm::vec3(direction(theta, phi)); };
    // Half vectors tilted along the weft lie in the plane across the warp
    EXPECT_GT(redness(low(50, 0), low(5, 0)), 2 * redness(low(50, 90), low(5, 90)));
}

// What is sampled has the density that it is weighed with.
TEST(Shading, SamplesFollowTheirDensity) {
    const Cloth cloth(dyed(0.2));
    Random random(9);
    for (const double theta : {10.0, 60.0, 85.0}) {
        const glm::vec3 view(direction(theta, 30));
        const ViewTerms terms = cloth.shading.view_terms(view);
        EXPECT_GT(terms.body_share, 0);
        double sampled = 0;
        constexpr int kSamples = 200000;
        for (int i = 0; i < kSamples; ++i) {
            const glm::vec3 u = random.point();
            if (const auto s =
                    cloth.shading.sample(view, terms, {u.x, random.number()}, {u.y, u.z}))
                sampled += s->weighed.f_cos.sum() / s->weighed.pdf / kSamples;
        }
        const double expected = integrate(
            [&](const glm::vec3 &l) {
                return double(cloth.shading.weigh(l, view, terms).f_cos.sum());
            },
            kEvaluations);
        EXPECT_NEAR(sampled, expected, 0.02 * expected);
    }
}

} // namespace
} // namespace tsuya::test
