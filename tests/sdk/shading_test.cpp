// A material's parts together: the coloured part below the surface, as it is asked for by a dye.

#include "shading.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/stressed_pairs.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/model.h"

namespace tsuya::test {
namespace {

constexpr int kEvaluations = 60000;
constexpr double kRed = 640, kBlue = 450;

Fabric dyed(std::optional<double> delustre) {
    return {.name = "satin",
            .specular = CarriedViews{.bard = bard_of(satin_cloth()), .f0 = 0.05},
            .colours = {.dye = {{500, 600}, {0.05, 0.6}}, .delustre = delustre}};
}

struct ShadedCloth {
    Material material;
    Shading shading;

    explicit ShadedCloth(const Fabric &fabric)
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
    // To a viewer, of uniform light from both sides
    double scattered(const glm::vec3 &view, double nm) const {
        const ViewTerms terms = shading.view_terms(view);
        const double through = material.transmittance.at(nm);
        const auto all = [&](const glm::vec3 &l) {
            const Response front = shading.weigh(l, view, terms).f_cos;
            const Response behind = shading.weigh({l.x, l.y, -l.z}, view, terms).f_cos;
            return coloured(l, view, nm) + front.weft + front.warp + behind.transmitted * through;
        };
        return integrate(all, kEvaluations);
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
        const ShadedCloth cloth(dyed(delustre));
        EXPECT_NEAR(cloth.measured(kRed), 0.6, 0.004) << delustre.value_or(-1);
        EXPECT_NEAR(cloth.measured(kBlue), 0.05, 0.0004) << delustre.value_or(-1);
    }
    // Control: the surface takes more than the tolerance
    const ShadedCloth cloth(dyed(1));
    EXPECT_GT(cloth.material.dye.at(kRed), 0.61);
}

TEST(Shading, ReflectsNoMoreThanArrives) {
    Fabric white = dyed(0.3);
    white.colours.dye = Spectrum::constant(0.7);
    white.colours.transmittance = Spectrum::constant(0.3);
    const ShadedCloth cloth(white);
    for (const double theta : {0.0, 30.0, 60.0, 80.0, 87.0})
        for (const double phi : {0.0, 35.0, 90.0}) {
            const glm::vec3 view(direction(theta, phi));
            EXPECT_LE(cloth.scattered(view, kRed), 1.02) << theta << " " << phi;
        }
}

// As a function for comparisons it is what is rendered.
TEST(Shading, RendersTheColouredPart) {
    const ShadedCloth cloth(dyed({}));
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
    const ShadedCloth cloth(dyed(1));
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
    const ShadedCloth cloth(shot);
    const auto redness = [&](const glm::vec3 &light, const glm::vec3 &view) {
        return cloth.coloured(light, view, kRed) / cloth.coloured(light, view, kBlue);
    };
    const auto low = [](double theta, double phi) { return glm::vec3(direction(theta, phi)); };
    // Half vectors tilted along the weft lie in the plane across the warp
    EXPECT_GT(redness(low(50, 0), low(5, 0)), 2 * redness(low(50, 90), low(5, 90)));
}

// What is sampled has the density that it is weighed with.
TEST(Shading, SamplesFollowTheirDensity) {
    const ShadedCloth cloth(dyed(0.2));
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

// Of all models the Lambertian part lies below the surface as a viewer at the port sees it.
TEST(Shading, ReflectsTheDyeBelowEveryModel) {
    for (const ModelName &model : model_names()) {
        if (model.name == "tabulated")
            continue; // the fabric has no table
        Fabric fabric = with_model(dyed(1), std::string(model.name), "satin");
        if (auto *const views = find_specular<CarriedViews>(fabric))
            views->f0 = 0.3;
        EXPECT_NEAR(ShadedCloth(fabric).measured(kRed), 0.6, 0.004) << model.name;
    }
}

// A cloth of two dyes, one of all light and one of none, with what it lets through.
TEST(Shading, TwoDyesReflectNoMoreThanArrives) {
    for (const double thin : {0.0, 0.4})
        for (const bool pale_weft : {false, true}) {
            Fabric shot = dyed({});
            shot.colours.weft_dye = Spectrum::constant(pale_weft ? 1 - thin : 0);
            shot.colours.warp_dye = Spectrum::constant(pale_weft ? 0 : 1 - thin);
            shot.colours.transmittance = Spectrum::constant(thin);
            const ShadedCloth cloth(shot);
            for (const double theta : {0.0, 45.0, 75.0, 87.0})
                for (const double phi : {0.0, 90.0})
                    EXPECT_LE(cloth.scattered(glm::vec3(direction(theta, phi)), kRed), 1.02)
                        << theta << " " << phi;
        }
}

// Filaments that reflect all light, and a model that is not limited and reflects more.
Fabric mirror_yarns() {
    YarnLobes lobes{.f0 = 1, .roughness = 0.1};
    lobes.surface[1].fill(2);
    lobes.surface[0].fill(2);
    return {.name = "mirrors",
            .specular = lobes,
            .colours = {.dye = Spectrum::constant(0.6),
                        .lustre = Lustre::semi_dull,
                        .transmittance = Spectrum::constant(0.4)}};
}

Fabric brighter_than_mirrors() {
    Cloth cloth = isotropic_cloth();
    for (YarnSystem &yarn : cloth.yarns)
        yarn.cover *= 23; // the most that the check of views lets pass
    return {.name = "printed",
            .specular =
                CarriedViews{.bard = bard_of(cloth), .model = ViewModel::takeda_printed, .f0 = 1},
            .colours = {.dye = Spectrum::constant(0.6)}};
}

TEST(Shading, NothingIsLeftForADyeBelowMirrors) {
    for (const Fabric &fabric : {mirror_yarns(), brighter_than_mirrors()}) {
        const Material material = resolve(fabric, fabric.name);
        for (const Spectrum *const colour :
             {&material.dye, &material.transmittance, &material.weft_body, &material.warp_body})
            EXPECT_TRUE(colour->at(kRed) >= 0 && colour->at(kRed) <= 1) << colour->at(kRed);
        const BrdfFunction part = coloured_part(material, kRed);
        for (const double theta : {0.0, 40.0, 89.0}) {
            const double f = part(direction(theta, 20), direction(8, 0));
            EXPECT_TRUE(std::isfinite(f) && f >= 0 && f < 1) << fabric.name << " " << f;
        }
    }
}

// Yarns of which the views show no filament have no direction to follow.
TEST(Shading, ClothWithoutFilamentsIsLambertian) {
    const ShadedCloth cloth({.name = "even",
                             .specular = YarnLobes{.even = 0.2},
                             .colours = {.dye = Spectrum::constant(0.5)}});
    EXPECT_FALSE(cloth.material.body);
    EXPECT_NEAR(cloth.measured(kRed), 0.5, 0.004);
}

std::vector<Fabric> stressed_cloths() {
    Fabric shot = dyed({}), thin = dyed(0.0);
    shot.colours.weft_dye = Spectrum::constant(1);
    shot.colours.warp_dye = Spectrum::constant(0);
    thin.colours.dye = Spectrum::constant(0.7);
    thin.colours.transmittance = Spectrum::constant(0.3);
    Fabric leaning = dyed(0.3), colourless = dyed(0.3), undyed = dyed({});
    leaning.specular = CarriedViews{.bard = bard_of(leaning_cloth()), .f0 = 0.05};
    colourless.colours.specular_tint = Spectrum::constant(0);
    undyed.colours.dye = Spectrum::constant(0);
    return {dyed({}),   shot,   thin,           leaning,
            colourless, undyed, mirror_yarns(), brighter_than_mirrors()};
}

bool is_sound(float v) { return std::isfinite(v) && v >= 0; }

bool is_sound(const Weighed &w) {
    const Response &r = w.f_cos;
    for (const float part :
         {r.diffuse, r.transmitted, r.weft, r.warp, r.weft_body, r.warp_body, w.pdf})
        if (!is_sound(part))
            return false;
    return true;
}

// What is wrong with a pair, or nothing.
std::string wrong_with(const Shading &shading, const glm::vec3 &l, const glm::vec3 &v,
                       const glm::vec3 &u, float choice) {
    const ViewTerms terms = shading.view_terms(v);
    if (!(is_sound(terms.diffuse_scale) && is_sound(terms.specular_share) &&
          is_sound(terms.body_share) && terms.diffuse_share() > -1e-6f))
        return "a share of the samples is none";
    for (const glm::vec3 &light : {l, glm::vec3(l.x, l.y, -l.z)})
        if (!is_sound(shading.weigh(light, v, terms)))
            return "no finite number";
    const auto s = shading.sample(v, terms, {choice, u.z}, {u.x, u.y});
    if (!s)
        return {};
    if (!(is_sound(s->weighed) && s->weighed.pdf > 0))
        return "a sample without density";
    const float pdf = shading.weigh(s->to_light, v, terms).pdf;
    return std::abs(pdf - s->weighed.pdf) > 1e-4f * pdf ? "the density of a sample differs" : "";
}

TEST(Shading, IsSoundAtEveryPair) {
    int cloths = 0;
    for (const Fabric &fabric : stressed_cloths()) {
        const ShadedCloth cloth(fabric);
        Random random(11);
        int wrong = 0;
        const auto check = [&](const glm::vec3 &l, const glm::vec3 &v) {
            const std::string what =
                wrong_with(cloth.shading, l, v, random.point(), random.number());
            if (!what.empty() && ++wrong < 4)
                ADD_FAILURE() << "cloth " << cloths << ": " << what << " at light " << l.x << " "
                              << l.y << " " << l.z << ", view " << v.x << " " << v.y << " " << v.z;
        };
        for (int i = 0; i < 200000; ++i) {
            const auto [l, v] = stressed_pair(random);
            check(l, v);
        }
        for (const auto &[l, v] : directed_pairs())
            check(l, v);
        ++cloths;
    }
}

// No light is sampled for a viewer behind the cloth.
TEST(Shading, SamplesNothingForAViewerBehind) {
    const ShadedCloth cloth(dyed(0.0));
    for (const float z : {0.0f, -1e-6f, -0.5f}) {
        const glm::vec3 view(std::sqrt(1 - z * z), 0, z);
        const ViewTerms terms = cloth.shading.view_terms(view);
        for (float choice = 0.01f; choice < 1; choice += 0.07f)
            EXPECT_FALSE(cloth.shading.sample(view, terms, {choice, 0.5f}, {0.3f, 0.4f}));
    }
}

} // namespace
} // namespace tsuya::test
