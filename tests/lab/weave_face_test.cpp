#include "tsuya/lab/weave_face.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

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

/// The system of the highest filament at each place of a map, of filaments as they are traced: by
/// the balls about the points of their paths, and points between those. 2 where there is none.
std::vector<int> highest_filaments(const FilamentRepeat &repeat, const WeaveMap &map) {
    constexpr int kBetween = 6;
    const int nx = map.size[0], ny = map.size[1];
    const glm::dvec2 size(repeat.size), place = map.repeat / glm::dvec2(nx, ny);
    std::vector<double> top(map.place.size(), -1e9);
    std::vector<int> system(map.place.size(), 2);
    const auto cover = [&](const glm::dvec3 &point, const Filament &filament) {
        const double r = static_cast<double>(filament.radius);
        for (int j = static_cast<int>(std::floor((point.y - r) / place.y));
             j <= static_cast<int>((point.y + r) / place.y) + 1; ++j)
            for (int i = static_cast<int>(std::floor((point.x - r) / place.x));
                 i <= static_cast<int>((point.x + r) / place.x) + 1; ++i) {
                const glm::dvec2 off(place.x * (i + 0.5) - point.x, place.y * (j + 0.5) - point.y);
                const double up = r * r - glm::dot(off, off);
                const auto at =
                    static_cast<std::size_t>((j % ny + ny) % ny * nx + (i % nx + nx) % nx);
                if (up < 0 || point.z + std::sqrt(up) < top[at])
                    continue;
                top[at] = point.z + std::sqrt(up);
                system[at] = filament.system == 0 ? WeavePlace::kWarp : WeavePlace::kWeft;
            }
    };
    for (const Filament &filament : repeat.filaments)
        for (std::size_t k = 0; k < filament.point.size(); ++k) {
            const glm::dvec3 from(filament.point[k]);
            glm::dvec3 to(filament.point[(k + 1) % filament.point.size()]);
            if (k + 1 == filament.point.size())
                (filament.system == 0 ? to.y : to.x) += filament.system == 0 ? size.y : size.x;
            for (int b = 0; b < kBetween; ++b)
                cover(glm::mix(from, to, b / double(kBetween)), filament);
        }
    return system;
}

// The yarns' sections are those of their filaments: what is seen is of the same system.
TEST(WeaveFace, IsThatOfTheFilaments) {
    for (const char *const name : {"black polyester satin", "polyester taffeta", "twill lining"}) {
        const Weave cloth = weave(name);
        const WeaveMap map = face_of(cloth, 24);
        const FilamentRepeat repeat = build_filaments(cloth);
        ASSERT_NEAR(repeat.size.x, map.repeat.x, 1e-12);
        const std::vector<int> system = highest_filaments(repeat, map);
        std::size_t same = 0, seen = 0;
        for (std::size_t i = 0; i < system.size(); ++i) {
            seen += system[i] < 2; // filaments leave gaps that the sections have not
            same += system[i] < 2 && system[i] == map.place[i].system;
        }
        EXPECT_GT(static_cast<double>(seen), 0.9 * static_cast<double>(system.size())) << name;
        EXPECT_GT(static_cast<double>(same), 0.97 * static_cast<double>(seen)) << name;
    }
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

TEST(WeaveFace, IsStopped) {
    const std::atomic<bool> stop{true};
    EXPECT_THROW(face_of(weave("black polyester satin"), kFacePlaces, {}, {.stop = &stop}),
                 Interrupted);
}

} // namespace tsuya::lab
