#include "tsuya/sdk/model.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

Fabric satin() {
    return {.name = "satin", .specular = CarriedViews{.bard = bard_of(satin_cloth()), .f0 = 0.05}};
}

TEST(Models, AreNamedAndMade) {
    Fabric fabric = satin();
    fabric.spare = {TabulatedSpecular{.table = paper_table(satin_cloth(), 15, 30)}};
    for (const ModelName &model : model_names()) {
        EXPECT_FALSE(model.description.empty());
        const BrdfFunction f = make_model(std::string(model.name), fabric, "satin");
        EXPECT_GT(f(direction(30, 90), direction(40, -90)), 0.0) << model.name;
    }
}

// What is asked to stop before stops at once; what is asked while it works, soon after.
TEST(Models, StopOnRequest) {
    Fabric fabric = satin();
    fabric.spare = {TabulatedSpecular{.table = paper_table(satin_cloth(), 15, 30)}};
    std::atomic<bool> stop{true};
    const Progress progress{.stop = &stop};
    for (const ModelName &model : model_names()) {
        const Fabric made = with_model(fabric, std::string(model.name), "satin");
        stop = true;
        EXPECT_THROW(make_brdf(made, "satin", progress), Interrupted) << model.name;
        EXPECT_THROW(resolve(made, "satin", progress), Interrupted) << model.name;
        stop = false;
        std::chrono::steady_clock::time_point asked{};
        std::thread asking([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            asked = std::chrono::steady_clock::now();
            stop = true;
        });
        std::chrono::steady_clock::time_point stopped{};
        try {
            make_brdf(made, "satin", progress);
        } catch (const Interrupted &) {
            stopped = std::chrono::steady_clock::now();
        }
        asking.join();
        if (stopped.time_since_epoch().count() > 0)
            std::cout << model.name << " stopped after "
                      << std::chrono::duration<double>(stopped - asked).count() << " s\n";
    }
    stop = true;
    const ReflectanceTable views = normal_table(satin_cloth(), even_grid(5, 10));
    EXPECT_THROW(Bard::fit(views, "views", progress), Interrupted);
    EXPECT_THROW(fit_yarn_lobes(*views_of(fabric), 0.05, progress), Interrupted);
    EXPECT_THROW(fit_yarn_lobes(*views_of(fabric), paper_table(satin_cloth(), 15, 30), 0.05,
                                "table", progress),
                 Interrupted);
}

TEST(Models, HaveOneReflectanceOfFacets) {
    CarriedViews views{.bard = bard_of(satin_cloth())};
    for (const ViewModel model : view_models()) {
        views.model = model;
        views.f0.reset();
        EXPECT_EQ(f0_of(views), model == ViewModel::takeda_printed
                                    ? std::min(1.0, views.bard.at({0, 0, 1})) // as [Takeda] has it
                                    : 0.05)
            << name_of(model);
        views.f0 = 0.3;
        EXPECT_EQ(f0_of(views), 0.3);
    }
}

// What is not chosen is kept, and can be chosen again.
TEST(Models, AreChosenFromWhatTheFabricHas) {
    Fabric fabric = satin();
    fabric.spare = {GgxFacets{.alpha_weft = 0.1}};
    EXPECT_EQ(models_of(fabric), (std::vector<std::string>{"yarn", "takeda", "takeda_printed",
                                                           "half_vector", "ggx", "lambert"}));
    const Fabric facets = with_model(fabric, "ggx", "f");
    EXPECT_EQ(facets.specular, Specular(GgxFacets{.alpha_weft = 0.1}));
    EXPECT_EQ(model_of(facets), "ggx");
    ASSERT_EQ(facets.spare.size(), 1u);
    const Fabric back = with_model(facets, "takeda", "f");
    EXPECT_EQ(model_of(back), "takeda");
    EXPECT_EQ(with_model(back, "yarn", "f"), fabric);
}

// The views themselves come back from every model that is made of them.
TEST(Models, MeetTheViewsTheyAreMadeOf) {
    const Fabric fabric = satin();
    const ReflectanceTable table = normal_table(satin_cloth(), even_grid(6, 15));
    const auto error = [&](const char *model) {
        return measure_accuracy(table, make_model(model, fabric, "satin")).mean;
    };
    for (const char *model : {"takeda", "half_vector"}) {
        EXPECT_LT(error(model).l2_cos.value(), 0.02) << model;
        EXPECT_NEAR(error(model).albedo_ratio.value(), 1, 0.01) << model;
    }
    EXPECT_GT(error("lambert").l2_cos.value(), 0.3);
    EXPECT_NEAR(error("lambert").albedo_ratio.value(), 1, 0.01);
}

TEST(Models, AreRefusedWithAPlace) {
    const auto refused = [](const std::string &name, const Fabric &fabric) {
        try {
            make_model(name, fabric, "f.toml");
        } catch (const Error &error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    EXPECT_NE(refused("takedo", satin()).find("did you mean takeda"), std::string::npos);
    EXPECT_NE(refused("takeda", {}).find("f.toml.views"), std::string::npos);
    EXPECT_NE(refused("ggx", {}).find("f.toml.views"), std::string::npos);
    EXPECT_NE(refused("tabulated", satin()).find("f.toml.table"), std::string::npos);
    Fabric rough = satin();
    rough.spare = {GgxFacets{.alpha_weft = 2}};
    EXPECT_NE(refused("ggx", rough).find("f.toml.ggx.alpha_weft"), std::string::npos);
    Fabric thin = satin();
    thin.spare = {TabulatedSpecular{.table = normal_table(satin_cloth(), even_grid(10, 30))}};
    EXPECT_NE(refused("tabulated", thin).find("light from 1 "), std::string::npos);
    Fabric mirror = satin();
    find_specular<CarriedViews>(mirror)->f0 = 2;
    EXPECT_NE(refused("half_vector", mirror).find("f.toml.f0"), std::string::npos);
}

// f0 of 0 is refused by every model that divides by it, and the ends of its range are taken.
TEST(Models, TakeEveryReflectanceOfFacetsButZero) {
    const Bard bard = bard_of(isotropic_cloth());
    for (const double f0 : {0.0, -0.1, 1.001, std::nan("")}) {
        EXPECT_THROW(TakedaBrdf(bard, f0), Error);
        EXPECT_THROW(TakedaPrintedBrdf(bard, f0), Error);
        EXPECT_THROW(HalfVectorBrdf(bard, f0), Error);
        EXPECT_THROW(GgxBrdf(GgxFacets{.f0 = f0}), Error);
    }
    EXPECT_THROW(GgxBrdf(GgxFacets{.refractive_index = 1.0}), Error);
    EXPECT_NO_THROW(TakedaBrdf(bard, 1));
    EXPECT_NO_THROW(GgxBrdf(GgxFacets{.f0 = 1}));
}

// GGX facets are found again from the views that they make.
TEST(Ggx, IsFittedToViews) {
    const Cloth cloth{.yarns = {{.alpha_weft = 0.35, .alpha_warp = 0.15}}, .f0 = 0.08};
    const GgxFacets facets = fit_ggx(Bard::fit(normal_table(cloth, even_grid(4, 15)), {}, "cloth"));
    EXPECT_NEAR(facets.alpha_weft, 0.35, 0.01);
    EXPECT_NEAR(facets.alpha_warp, 0.15, 0.01);
    EXPECT_NEAR(facets.f0, 0.08, 0.004);
}

// The model against the same formulas in double, masking and Fresnel term written as they are in
// the sources: [Heitz] Eqs. 72, 85, 99.
TEST(Ggx, MeetsThePlainFormulaInDouble) {
    const Cloth cloth{.yarns = {{.alpha_weft = 0.35, .alpha_warp = 0.15}}, .f0 = 0.08};
    const GgxBrdf schlick({.alpha_weft = 0.35, .alpha_warp = 0.15, .f0 = 0.08});
    for (double theta_i = 0; theta_i < 90; theta_i += 8)
        for (double theta = 0; theta < 90; theta += 7)
            for (double phi = 0; phi < 360; phi += 33) {
                const glm::vec3 l = direction(theta_i, 20), v = direction(theta, phi);
                const double expected = reflectance(cloth, glm::normalize(glm::dvec3(l)),
                                                    glm::normalize(glm::dvec3(v)));
                EXPECT_NEAR(schlick.evaluate(l, v), expected, 1e-4 * expected)
                    << theta_i << " " << theta << " " << phi;
            }
    // A mirror-like pole: F = ((n - 1)/(n + 1))^2 against f0 of the same value
    const GgxBrdf glass({.alpha_weft = 0.2, .alpha_warp = 0.2, .refractive_index = 1.5});
    const GgxBrdf same({.alpha_weft = 0.2, .alpha_warp = 0.2, .f0 = 0.04});
    const glm::vec3 up(0, 0, 1);
    EXPECT_NEAR(glass.evaluate(up, up), same.evaluate(up, up), 1e-5);
    // At Brewster's angle half of the light is s-polarised: F = ((n^2 - 1)/(n^2 + 1))^2 / 2
    const double brewster = std::atan(1.5) / 0.017453292519943295;
    const glm::vec3 l = direction(brewster, 0), v = direction(brewster, 180);
    const GgxBrdf mirror({.alpha_weft = 0.2, .alpha_warp = 0.2, .f0 = 1});
    EXPECT_NEAR(glass.evaluate(l, v) / mirror.evaluate(l, v), std::pow(1.25 / 3.25, 2) / 2, 1e-5);
}

// [Takeda] Eqs. 16-17 by hand: light at 45 degrees in the weft plane.
TEST(TakedaPrinted, MovesAViewAsThePaperPrintsIt) {
    const glm::vec3 light = direction(45, 180); // R = +x
    // In the plane of incidence: beta = 30 degrees, beta0/beta = 2, theta0 = 90 - 2 (90 - 60)
    EXPECT_LT(glm::length(printed_basic(light, direction(60, 0)) - glm::vec3(direction(30, 0))),
              1e-5f);
    // phi_r = 20 degrees on the horizon: beta = 20 degrees, so phi0 = 40
    EXPECT_LT(glm::length(printed_basic(light, direction(90, 20)) - glm::vec3(direction(90, 40))),
              1e-5f);
    // beta = 90 degrees: beta0/beta = 4/3, theta0 = 90 - 4/3 * 60, phi0 = 4/3 * 90
    EXPECT_LT(glm::length(printed_basic(light, direction(30, 90)) - glm::vec3(direction(10, 120))),
              1e-5f);
    EXPECT_EQ(printed_basic({0, 0, 1}, light), light);
}

// Truth: rows come back as they are, mirror images too.
TEST(Tabulated, MeetsItsRowsAndWhatLiesBetween) {
    const Cloth cloth = satin_cloth();
    const ReflectanceTable table = paper_table(cloth, 3, 5);
    const TabulatedBrdf brdf(table, "table");
    const auto f = [&](const glm::dvec3 &l, const glm::dvec3 &v) {
        return double(brdf.evaluate(glm::vec3(l), glm::vec3(v)));
    };
    EXPECT_LT(measure_accuracy(table, f).mean.l2_cos.value(), 1e-4);
    const glm::dvec3 l = direction(45, 90), v = direction(60, 250), mirror(-1, 1, 1);
    EXPECT_NEAR(f(l, v), f(mirror * l, mirror * v), 1e-4 * f(l, v));
    // Between the lights of the table, where the highlight must move and not fade over
    ReflectanceTable between{.symmetry = cloth.symmetry};
    for (double theta = 0; theta < 88; theta += 4)
        for (double phi = 0; phi < 360; phi += 10)
            between.rows.push_back({37 * kDegree, 20 * kDegree, theta * kDegree, phi * kDegree,
                                    reflectance(cloth, direction(37, 20), direction(theta, phi))});
    EXPECT_LT(measure_accuracy(between, f).mean.l2_cos.value(), 0.1);
}

// The truth is a half-vector model itself, with another masking: where facets up to 45 degrees tell
// all, the model must be much nearer to it than the great circles are.
TEST(HalfVector, FindsTheFacetsOfAMicrofacetCloth) {
    const Cloth cloth{.yarns = {{.alpha_weft = 0.3, .alpha_warp = 0.1}}};
    const Fabric fabric{.name = "facets",
                        .specular = CarriedViews{.bard = bard_of(cloth), .f0 = cloth.f0}};
    ReflectanceTable table{.symmetry = Symmetry::orthotropic};
    for (double theta = 0; theta <= 75; theta += 5)
        for (double phi = 0; phi < 360; phi += 10)
            table.rows.push_back({45 * kDegree, 45 * kDegree, theta * kDegree, phi * kDegree,
                                  reflectance(cloth, direction(45, 45), direction(theta, phi))});
    const auto error = [&](const char *model) {
        return measure_accuracy(table, make_model(model, fabric, "facets")).mean.l2_cos.value();
    };
    EXPECT_LT(error("half_vector"), 0.12);
    EXPECT_LT(error("half_vector"), 0.5 * error("takeda"));
}

TEST(HalfVector, MarksWhatItExtrapolates) {
    const auto marked = [](const glm::dvec3 &l, const glm::dvec3 &v) {
        return HalfVectorBrdf::is_extrapolated(glm::vec3(l), glm::vec3(v));
    };
    EXPECT_FALSE(marked({0, 0, 1}, direction(89, 30))); // the BARD's own views
    EXPECT_FALSE(marked(direction(70, 0), direction(70, 180)));
    EXPECT_FALSE(marked(direction(44, 0), direction(44, 0)));
    EXPECT_TRUE(marked(direction(46, 0), direction(46, 0)));
    // Beyond, D falls: straight back at the light the value is D F / cos^2
    const BrdfFunction f = make_model("half_vector", satin(), "satin");
    const auto facets = [&](double theta) {
        return f(direction(theta, 90), direction(theta, 90)) *
               std::pow(std::cos(theta * 0.017453292519943295), 2);
    };
    EXPECT_GT(facets(44.9), facets(55));
    EXPECT_GT(facets(55), facets(65));
    EXPECT_NEAR(facets(44.9) / facets(45.1), 1, 0.05);
}

} // namespace
} // namespace tsuya::test
