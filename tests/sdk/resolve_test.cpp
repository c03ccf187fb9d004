// From a fabric as its author describes it to what the renderer shades with.

#include "tsuya/sdk/fabric.h"

#include <atomic>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/kept_materials.h"

namespace tsuya::test {
namespace {

Fabric satin() {
    return {.name = "satin",
            .specular = CarriedViews{.bard = bard_of(satin_cloth()), .f0 = 0.05},
            .colours = {.dye = {{400, 550, 700}, {0.1, 0.25, 0.9}}}};
}

TEST(Resolve, RefusesWhatIsOutOfRange) {
    const auto expect_refused = [](const Fabric &fabric, const std::string &where) {
        try {
            resolve(fabric, "fabrics.satin");
            ADD_FAILURE() << "expected an Error";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, where);
        }
    };
    Fabric bright = satin(), tinted = satin(), facets = satin(), thin = satin(), shot = satin();
    bright.colours.dye = Spectrum::constant(1.1);
    tinted.colours.specular_tint = Spectrum::constant(-0.1);
    find_specular<CarriedViews>(facets)->f0 = 0;
    expect_refused(bright, "fabrics.satin.dye");
    expect_refused(tinted, "fabrics.satin.specular_tint");
    expect_refused(facets, "fabrics.satin.f0");
    thin.colours.transmittance = Spectrum::constant(0.2); // the dye reaches 0.9
    expect_refused(thin, "fabrics.satin.transmittance");
    shot.colours.warp_tint = Spectrum::constant(2);
    expect_refused(shot, "fabrics.satin.warp_tint");
    shot.colours.warp_tint.reset();
    shot.colours.weft_tint = {{450, 650}, {0.9, 0.2}};
    resolve(shot, "fabrics.satin");
    find_specular<CarriedViews>(shot)->model =
        ViewModel::takeda; // does not tell weft and warp apart
    expect_refused(shot, "fabrics.satin.weft_tint");
    shot.colours.weft_tint.reset();
    shot.colours.warp_dye = Spectrum::constant(0.1);
    expect_refused(shot, "fabrics.satin.warp_dye");
    shot.colours.warp_dye.reset();
    shot.colours.delustre = 0.5;
    expect_refused(shot, "fabrics.satin.delustre");
    shot.colours.delustre = 1;
    resolve(shot, "fabrics.satin");
    shot.colours.delustre = -0.1;
    expect_refused(shot, "fabrics.satin.delustre");
}

TEST(Resolve, TakesTheF0OfFibresWhereTheViewsHaveNone) {
    Fabric fabric = satin();
    const Bard bard = *views_of(fabric);
    const CarriedViews views{.bard = bard, .model = ViewModel::takeda};
    fabric.specular = views;
    const Material material = resolve(fabric, "satin");
    ASSERT_TRUE(material.has_specular());
    const TakedaBrdf expected(bard, f0_of(views));
    const glm::vec3 light = direction(40, 10), view = direction(60, 170);
    EXPECT_EQ(material.specular->evaluate(light, view), expected.evaluate(light, view));
}

// What reflects alike however it is turned needs no yarn directions; all else does, whether or not
// it has views.
TEST(NeedsFrames, FollowsTheSpecularPart) {
    const Bard bard = bard_of(satin_cloth());
    const auto needs = [](const Specular &specular) {
        return needs_frames({.name = "f", .specular = specular});
    };
    EXPECT_FALSE(needs({}));
    EXPECT_FALSE(needs(GgxFacets{.alpha_weft = 0.2, .alpha_warp = 0.2}));
    EXPECT_FALSE(needs(CarriedViews{.bard = bard, .model = ViewModel::lambert}));
    EXPECT_TRUE(needs(GgxFacets{.alpha_weft = 0.05, .alpha_warp = 0.6}));
    EXPECT_TRUE(needs(YarnLobes{}));
    EXPECT_TRUE(needs(TabulatedSpecular{}));
    for (const ViewModel model : {ViewModel::yarn, ViewModel::takeda, ViewModel::takeda_printed,
                                  ViewModel::half_vector, ViewModel::ggx})
        EXPECT_TRUE(needs(CarriedViews{.bard = bard, .model = model}));
    Fabric colourless = satin();
    colourless.colours.specular_tint = Spectrum::constant(0);
    EXPECT_TRUE(needs_frames(colourless)); // its coloured part follows the yarns
    colourless.colours.delustre = 1;
    EXPECT_FALSE(needs_frames(colourless));
}

// Light from one quadrant without a symmetry, taken for light from all sides, made a cloth look
// twice as bright.
TEST(FabricWarnings, NameTheSymmetryThatATableMayHaveForgotten) {
    const auto said = [](Symmetry symmetry, const std::vector<double> &phi_deg) {
        TabulatedSpecular tabulated{.table = {.symmetry = symmetry}};
        for (const double phi : phi_deg)
            tabulated.table.rows.push_back({0.5, phi * kDegree, 0.2, 0, 0.1, 0});
        tabulated.table.rows.push_back({0, 3, 0.2, 0, 0.1, 0}); // the azimuth of the normal is none
        const auto warnings = fabric_warnings({.name = "f", .specular = tabulated}, "fabrics.f");
        if (warnings.empty())
            return std::string();
        EXPECT_EQ(warnings[0].where, "fabrics.f.table");
        const std::string &text = warnings[0].accepted;
        const auto begin = text.find(": ") + 2;
        return text.substr(begin, text.find('`', begin) - begin);
    };
    EXPECT_EQ(said(Symmetry::none, {0, 45, 90}), "orthotropic");
    EXPECT_EQ(said(Symmetry::none, {-30, 20}), "orthotropic"); // beyond the weft
    EXPECT_EQ(said(Symmetry::none, {0, 45, 90, 135}), "half-turn");
    EXPECT_EQ(said(Symmetry::none, {0, 90, 180, 270}), "");
    EXPECT_EQ(said(Symmetry::none, {10, 190}), "");
    EXPECT_EQ(said(Symmetry::none, {}), "");
    EXPECT_EQ(said(Symmetry::orthotropic, {0, 45, 90}), "");
    EXPECT_TRUE(fabric_warnings({.name = "plain"}, "fabrics.plain").empty());
}

// One cloth in two dyes: what was made for the first serves the second to the last bit.
TEST(Resolve, TakesTablesOfTheSameCloth) {
    Fabric red = satin(), pale = satin();
    pale.colours.dye = Spectrum::constant(0.7);
    pale.colours.lustre = Lustre::semi_dull;
    ModelTables tables;
    const Material first = resolve(red, "red", tables);
    const Material taken = resolve(pale, "pale", tables), made = resolve(pale, "pale");
    EXPECT_EQ(taken.specular, first.specular) << "one object";
    EXPECT_EQ(taken.body, first.body);
    const glm::vec3 light = direction(40, 10), view = direction(60, 170);
    EXPECT_EQ(taken.specular->evaluate(light, view), made.specular->evaluate(light, view));
    EXPECT_EQ(taken.body->evaluate(light, view), made.body->evaluate(light, view));
    EXPECT_EQ(taken.dye, made.dye);
    EXPECT_EQ(taken.warp_body, made.warp_body);
    // A colourless surface takes no light from the body below it
    pale.colours.specular_tint = Spectrum::constant(0);
    const Material bare = resolve(pale, "pale", tables);
    EXPECT_GT(bare.body->albedo(view), 1.01f * made.body->albedo(view));
    EXPECT_EQ(resolve(pale, "pale", tables).body, bare.body);
}

// Where nothing is to be tabulated, there is nothing to stop.
TEST(KeptMaterials, TabulateEachClothOnce) {
    Fabric red = satin(), pale = satin(), other = satin();
    pale.colours.dye = Spectrum::constant(0.7);
    find_specular<CarriedViews>(other)->f0 = 0.06;
    const std::atomic<bool> stop{true};
    const Progress stopped{.stop = &stop};
    KeptMaterials kept;
    EXPECT_THROW(kept.resolve(red, "red", stopped), Interrupted);
    EXPECT_EQ(kept.size(), 0u);
    kept.resolve(red, "red");
    const Material taken = kept.resolve(pale, "pale", stopped), made = resolve(pale, "pale");
    const glm::vec3 light = direction(40, 10), view = direction(60, 170);
    EXPECT_EQ(taken.specular->evaluate(light, view), made.specular->evaluate(light, view));
    EXPECT_EQ(taken.body->evaluate(light, view), made.body->evaluate(light, view));
    EXPECT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept.use().made, 1u);
    EXPECT_EQ(kept.use().shared, 1u);
    EXPECT_THROW(kept.resolve(other, "other", stopped), Interrupted) << "another cloth";
    kept.resolve(other, "other");
    EXPECT_EQ(kept.size(), 2u);
    kept.clear();
    EXPECT_THROW(kept.resolve(red, "red", stopped), Interrupted);
}

TEST(Resolve, RefusesTwoDescriptionsOfOneKind) {
    Fabric fabric = satin();
    fabric.spare = {GgxFacets{}, GgxFacets{.alpha_weft = 0.5}};
    try {
        check_fabric(fabric, "f");
        FAIL() << "accepted";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "f.spare");
    }
}

} // namespace
} // namespace tsuya::test
