#include "tsuya/sdk/model_choice.h"

#include <atomic>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/model.h"
#include "tsuya/sdk/yarn.h"

namespace tsuya::test {
namespace {

CarriedViews views_of(const ReflectanceTable &table) {
    return {.bard = Bard::fit(table, BardSmoothness{}, "t")};
}

std::vector<ModelScore> scores_of(const ReflectanceTable &table) {
    return cross_validate(views_of(table), "t");
}

// Views that the yarn model itself would show.
ReflectanceTable yarn_table() {
    const YarnBrdf brdf(views_of(normal_table(satin_cloth(), even_grid(5, 10))).bard, kFibreF0);
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(5, 10));
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr = static_cast<double>(brdf.evaluate({0, 0, 1}, glm::vec3(row.to_viewer())));
    return table;
}

TEST(ModelChoice, FindsTheModelThatMadeTheViews) {
    const auto yarn = scores_of(yarn_table());
    EXPECT_EQ(chosen(yarn), ViewModel::yarn);
    ASSERT_EQ(yarn.size(), 2u);
    EXPECT_LT(yarn[0].l2_cos, 0.05);
    EXPECT_GT(yarn[1].l2_cos, 2 * yarn[0].l2_cos);
    // One GGX lobe with Smith's masking and Schlick's term: the formula of the model ggx
    const auto facets = scores_of(normal_table(isotropic_cloth(), even_grid(5, 10)));
    EXPECT_EQ(chosen(facets), ViewModel::ggx);
    ASSERT_EQ(facets.size(), 2u);
    EXPECT_EQ(facets[1].model, ViewModel::ggx);
    EXPECT_LT(facets[1].l2_cos, 0.02);
    EXPECT_GT(facets[0].l2_cos, 2 * facets[1].l2_cos);
}

// The views of a fold are predicted by the others alone: no fit can follow their noise of 20 %,
// which is 0.2 / sqrt(1 + 0.2^2) of what they show.
TEST(ModelChoice, ShowsNoiseAsTheErrorOfViewsLeftOut) {
    ReflectanceTable noisy = normal_table(isotropic_cloth(), even_grid(5, 10));
    for (std::size_t i = 0; i < noisy.rows.size(); ++i)
        noisy.rows[i].brdf_per_sr *= i % 2 == 0 ? 1.2 : 0.8;
    for (const ModelScore &score : scores_of(noisy))
        EXPECT_GT(score.l2_cos, 0.19) << name_of(score.model);
}

// A view whose mirror image stays in the fit would not be left out.
TEST(ModelChoice, LeavesMirrorImagesOutTogether) {
    const ReflectanceTable quadrant = normal_table(satin_cloth(), even_grid(5, 15));
    ReflectanceTable whole = quadrant;
    for (const ReflectanceRow &row : quadrant.rows) {
        ReflectanceRow mirrored = row;
        mirrored.phi_r = -row.phi_r;
        whole.rows.push_back(mirrored);
    }
    const auto once = scores_of(quadrant), twice = scores_of(whole);
    ASSERT_EQ(once.size(), twice.size());
    for (std::size_t i = 0; i < once.size(); ++i)
        EXPECT_NEAR(once[i].l2_cos, twice[i].l2_cos, 0.1 * once[i].l2_cos);
}

TEST(ModelChoice, IsTheDefaultWhereNothingIsKnown) {
    EXPECT_EQ(chosen({}), ViewModel::yarn);
    // The measured woven shade of sdk/docs/REFLECTANCE_STUDY.md, which yarn predicts better
    EXPECT_EQ(chosen({{ViewModel::yarn, 0.0503}, {ViewModel::ggx, 0.0356}}), ViewModel::yarn);
    EXPECT_EQ(chosen({{ViewModel::yarn, 0.1672}, {ViewModel::ggx, 0.0009}}), ViewModel::ggx);
    ReflectanceTable few{.symmetry = Symmetry::orthotropic};
    for (const double theta : {0.0, 0.5, 1.0})
        for (const double phi : {0.0, 1.5})
            few.rows.push_back({0, 0, theta, phi, 0.1});
    EXPECT_TRUE(cross_validate(views_of(few), "t").empty());
}

TEST(ModelChoice, StopsOnRequest) {
    const ReflectanceTable table = normal_table(satin_cloth(), even_grid(5, 10));
    std::atomic<bool> stop{true};
    EXPECT_THROW(cross_validate(views_of(table), "t", Progress{.stop = &stop}), Interrupted);
}

} // namespace
} // namespace tsuya::test
