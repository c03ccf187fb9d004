#include "tsuya/lab/refractive_index.h"

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

TEST(RefractiveIndex, IsThatOfTheTablesAtTheSodiumLine) {
    EXPECT_NEAR(refractive_index(FiberMaterial::polyester, 589), 1.569, 0.0005);
    EXPECT_NEAR(refractive_index(FiberMaterial::silk, 589), 1.560, 0.0006);
    EXPECT_NEAR(refractive_index(FiberMaterial::cellulose, 589), 1.470, 1e-9);
}

TEST(RefractiveIndex, FallsWithWavelength) {
    for (const FiberMaterial material : {FiberMaterial::polyester, FiberMaterial::silk})
        for (double nm = 401; nm <= 780; nm += 1)
            EXPECT_LT(refractive_index(material, nm), refractive_index(material, nm - 1)) << nm;
    EXPECT_EQ(refractive_index(FiberMaterial::polyester, 380),
              refractive_index(FiberMaterial::polyester, 400));
}

TEST(RefractiveIndex, OtherWavelengthsAndMaterialsAreRefused) {
    EXPECT_THROW(refractive_index(FiberMaterial::silk, 379), Error);
    EXPECT_THROW(refractive_index(FiberMaterial::silk, 781), Error);
    EXPECT_THROW(refractive_index(FiberMaterial::silk, 0.0 / 0.0), Error);
    EXPECT_THROW(parse_fiber_material("nylon"), Error);
    for (const std::string &name : fiber_materials())
        EXPECT_EQ(name_of(parse_fiber_material(name)), name);
}

} // namespace
} // namespace tsuya::lab
