// From a fabric as its author describes it to what the renderer shades with.

#include "tsuya/sdk/fabric.h"

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

Fabric satin() {
    return {.name = "satin",
            .bard = bard_of(satin_cloth()),
            .f0 = 0.05,
            .dye = {{400, 550, 700}, {0.1, 0.25, 0.9}}};
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
    bright.dye = Spectrum::constant(1.1);
    tinted.specular_tint = Spectrum::constant(-0.1);
    facets.f0 = 0;
    expect_refused(bright, "fabrics.satin.dye");
    expect_refused(tinted, "fabrics.satin.specular_tint");
    expect_refused(facets, "fabrics.satin.f0");
    thin.transmittance = Spectrum::constant(0.2); // the dye reaches 0.9
    expect_refused(thin, "fabrics.satin.transmittance");
    shot.warp_tint = Spectrum::constant(2);
    expect_refused(shot, "fabrics.satin.warp_tint");
    shot.warp_tint.reset();
    shot.weft_tint = {{450, 650}, {0.9, 0.2}};
    resolve(shot, "fabrics.satin");
    shot.model = "takeda"; // does not tell weft and warp apart
    expect_refused(shot, "fabrics.satin.weft_tint");
}

TEST(Resolve, TakesTheNormalReflectanceForF0) {
    Fabric fabric = satin();
    fabric.model = "takeda";
    fabric.f0.reset();
    const Material material = resolve(fabric, "satin");
    ASSERT_TRUE(material.has_specular());
    const double rho = fabric.bard->at({0, 0, 1});
    const TakedaBrdf expected(*fabric.bard, std::min(1.0, rho));
    const glm::vec3 light = direction(40, 10), view = direction(60, 170);
    EXPECT_EQ(material.specular->evaluate(light, view), expected.evaluate(light, view));
}

} // namespace
} // namespace tsuya::test
