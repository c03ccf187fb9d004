#include "tsuya/sdk/model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

Fabric satin() { return {.name = "satin", .bard = bard_of(satin_cloth()), .f0 = 0.05}; }

TEST(Models, AreNamedAndMade) {
    const Fabric fabric = satin();
    for (const ModelName &model : model_names()) {
        EXPECT_FALSE(model.description.empty());
        const BrdfFunction f = make_model(std::string(model.name), fabric, "satin");
        EXPECT_GT(f(direction(30, 90), direction(40, -90)), 0.0) << model.name;
    }
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
    Fabric mirror = satin();
    mirror.f0 = 2;
    EXPECT_NE(refused("half_vector", mirror).find("f.toml.f0"), std::string::npos);
}

// The truth is a half-vector model itself, with another masking: where facets up to 45 degrees tell
// all, the model must be much nearer to it than the great circles are.
TEST(HalfVector, FindsTheFacetsOfAMicrofacetCloth) {
    const Cloth cloth{.yarns = {{.alpha_weft = 0.3, .alpha_warp = 0.1}}};
    const Fabric fabric{.name = "facets", .bard = bard_of(cloth), .f0 = cloth.f0};
    ReflectanceTable table{.symmetry = Symmetry::orthotropic};
    constexpr double kDegree = 0.017453292519943295;
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
