#include "tsuya/lab/weave_face.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

const WeavePlace &at(const WeaveMap &map, double x, double y) {
    const auto i = static_cast<std::size_t>(x * kFacePlaces),
               j = static_cast<std::size_t>(y * kFacePlaces);
    return map.place[j * static_cast<std::size_t>(map.size[0]) + i];
}

// The report counts the same by another grid.
TEST(WeaveFace, HasTheSharesOfTheReport) {
    for (const std::string &name : weave_names()) {
        const Weave cloth = weave(name);
        const WeaveMap map = face_of(cloth, 40);
        const WeaveReport report = report_weave(cloth);
        check_weave_map(map, name);
        EXPECT_NEAR(map.share(WeavePlace::kWarp), report.warp_on_face, 0.015) << name;
        EXPECT_NEAR(map.share(WeavePlace::kWeft), report.weft_on_face, 0.015) << name;
        EXPECT_NEAR(map.repeat.x, cloth.draft.ends * cloth.warp.spacing(), 1e-12) << name;
        EXPECT_NEAR(map.spacing().y, cloth.weft.spacing(), 1e-12) << name;
    }
}

// At the middle of a crossing lies what the draft says; a float is counted along its yarn.
TEST(WeaveFace, ShowsTheDraft) {
    const Weave cloth = weave("twill lining"); // 2/2
    const WeaveMap map = face_of(cloth);
    for (int end = 0; end < 4; ++end)
        for (int pick = 0; pick < 4; ++pick) {
            const WeavePlace &place = at(map, end + 0.5, pick + 0.5);
            const bool up = cloth.draft.up(end, pick);
            EXPECT_EQ(place.system, up ? WeavePlace::kWarp : WeavePlace::kWeft);
            EXPECT_EQ(place.thread, up ? end : pick);
            EXPECT_LT(std::abs(place.across), 0.2);
            const bool starts = up ? !cloth.draft.up(end, pick - 1) : cloth.draft.up(end - 1, pick);
            EXPECT_NEAR(place.along, starts ? 0.25 : 0.75, 0.03) << end << " " << pick;
        }
}

// A yarn rises from below its neighbour at the start of a float and dives at its end; between the
// two slopes of a place its path goes up as far as it comes down.
TEST(WeaveFace, SlopesRiseAlongTheirYarns) {
    const WeaveMap map = face_of(weave("polyester taffeta"));
    double rising = 0, falling = 0, sum = 0;
    for (const WeavePlace &place : map.place) {
        if (place.system == WeavePlace::kGap)
            continue;
        (place.along < 0.5f ? rising : falling) += static_cast<double>(std::tan(place.slope));
        sum += static_cast<double>(std::tan(place.slope));
    }
    EXPECT_GT(rising, 0);
    EXPECT_LT(falling, 0);
    EXPECT_NEAR(sum / rising, 0, 0.01);
}

TEST(WeaveFace, KeepsLargeDraftsSmall) {
    Weave cloth = weave("polyester taffeta");
    cloth.draft = twill(6, 6);
    const WeaveMap map = face_of(cloth);
    EXPECT_LE(map.place.size(), static_cast<std::size_t>(kMostFacePlaces));
    EXPECT_EQ(map.size[0], 12 * 15);
}

TEST(WeaveFace, RefusesPlacesOutOfRange) {
    for (const int places : {1, 65})
        EXPECT_THROW(face_of(weave("polyester taffeta"), places), Error);
}

} // namespace
} // namespace tsuya::lab
