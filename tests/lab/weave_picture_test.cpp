#include "tsuya/lab/weave_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

/// Taffeta with a red warp and a green weft, in another draft.
Weave red_on_green(const Draft &draft) {
    Weave made = weave("polyester taffeta");
    made.draft = draft;
    made.warp.transmission = {0.8, 0.05, 0.05};
    made.weft.transmission = {0.05, 0.8, 0.05};
    return made;
}

WeavePictureSettings small() { return {.width = 160, .height = 120, .samples_per_pixel = 4}; }

/// Calls visit(end, pick, x, y) with the pixel of the middle of each crossing that is in sight.
template <class Visit>
void each_crossing(const Weave &weave, const WeavePictureSettings &settings, Visit visit) {
    const double metre = settings.width / width_of_picture(weave, settings);
    for (int end = 0;; ++end) {
        const auto x = static_cast<int>((end + 0.5) * weave.warp.spacing() * metre);
        if (x >= settings.width)
            return;
        for (int pick = 0;; ++pick) {
            const double up = (pick + 0.5) * weave.weft.spacing() * metre * std::cos(settings.tilt);
            const int y = settings.height - 1 - static_cast<int>(up);
            if (y < 0)
                break;
            visit(end, pick, x, y);
        }
    }
}

/// Crossings of the picture that do not show the yarn that `draft` has above.
int wrong_crossings(const Weave &weave, const Draft &draft, double tilt) {
    WeavePictureSettings settings = small();
    settings.tilt = tilt;
    const Image image = weave_picture(weave, settings);
    int wrong = 0;
    each_crossing(weave, settings, [&](int end, int pick, int x, int y) {
        const float *pixel = image.pixel(x, y);
        wrong += (pixel[0] > pixel[1]) != draft.up(end, pick);
    });
    return wrong;
}

TEST(WeavePicture, ShowsTheYarnThatTheDraftHasAbove) {
    for (const char *name : {"plain", "twill 3/1", "satin 5"}) {
        const Draft draft = parse_draft(name);
        const Weave weave = red_on_green(draft);
        for (const double tilt : {0.0, 0.5})
            EXPECT_EQ(wrong_crossings(weave, draft, tilt), 0) << name << ", tilt " << tilt;
        Draft other = draft; // the twill's line falls, the satin steps the other way
        for (int pick = 0; pick < draft.picks; ++pick)
            for (int end = 0; end < draft.ends; ++end)
                other.warp_up[static_cast<std::size_t>(pick * draft.ends + end)] =
                    draft.up(draft.ends - 1 - end, pick);
        EXPECT_GT(wrong_crossings(weave, other, 0), 0) << name << ", control";
    }
}

TEST(WeavePicture, LaysItsDraftBesideIt) {
    const Weave weave = red_on_green(parse_draft("satin 8"));
    for (const double tilt : {0.0, 1.0}) {
        WeavePictureSettings settings = small();
        settings.tilt = tilt;
        const Image paper = draft_picture(weave, settings);
        each_crossing(weave, settings, [&](int end, int pick, int x, int y) {
            EXPECT_EQ(paper.pixel(x, y)[1] < 0.5f, weave.draft.up(end, pick))
                << end << ", " << pick;
        });
    }
}

TEST(WeavePicture, IsInRangeAndDoesNotDependOnTheNumberOfThreads) {
    WeavePictureSettings settings = small();
    settings.tilt = 0.8;
    settings.threads = 1;
    const Weave silk = weave("shot silk");
    const Image one = weave_picture(silk, settings);
    EXPECT_EQ(one.width, 160);
    EXPECT_EQ(one.height, 120);
    ASSERT_EQ(one.channels.size(), 3u);
    for (const float value : one.data) {
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
    }
    settings.threads = 3;
    EXPECT_EQ(one.data, weave_picture(silk, settings).data);
    settings.tilt = 0;
    EXPECT_NE(one.data, weave_picture(silk, settings).data);
}

TEST(WeavePicture, DrawsBlackYarnsReadably) {
    const Image image = weave_picture(weave("black polyester satin"), small());
    double mean = 0, square = 0;
    for (const float value : image.data) {
        mean += value / static_cast<double>(image.data.size());
        square += value * value / static_cast<double>(image.data.size());
    }
    EXPECT_GT(mean, 0.05);
    EXPECT_LT(mean, 0.5);
    EXPECT_GT(square - mean * mean, 0.005);
}

TEST(WeavePicture, HasABarOfItsLength) {
    const Weave weave = red_on_green(parse_draft("plain"));
    const WeavePictureSettings settings = small();
    const double across = width_of_picture(weave, settings), bar = scale_bar(weave, settings);
    EXPECT_GE(bar, across / 12.5);
    EXPECT_LE(bar, across / 5);
    EXPECT_EQ(scale_bar(weave, {.across = 1e-3}), 2e-4);
    const Image image = weave_picture(weave, settings);
    int longest = 0; // run of black pixels in the lowest rows
    for (int y = settings.height - 10; y < settings.height; ++y)
        for (int x = 0, run = 0; x < settings.width; ++x) {
            run = image.pixel(x, y)[0] == 0.03f ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    EXPECT_NEAR(longest, bar / across * settings.width, 1);
}

TEST(WeavePicture, SeesAWholeRepeatButNotTooMuch) {
    const Weave satin = weave("black polyester satin");
    EXPECT_NEAR(width_of_picture(satin), 5 * satin.weft.spacing(), 1e-12);
    const Weave plain = weave("polyester taffeta");
    EXPECT_NEAR(width_of_picture(plain), 4 * plain.weft.spacing(), 1e-12);
    Weave large = plain;
    large.draft = parse_draft("satin 40/7");
    EXPECT_NEAR(width_of_picture(large), 12 * plain.weft.spacing(), 1e-12);
    EXPECT_EQ(width_of_picture(large, {.across = 0.001}), 0.001);
}

/// Where an error says that it is.
std::string where(const WeavePictureSettings &settings) {
    try {
        draft_picture(weave("polyester taffeta"), settings);
    } catch (const Error &error) {
        return error.problems().front().where;
    }
    return "";
}

TEST(WeavePicture, RefusesWhatItCannotDraw) {
    EXPECT_EQ(where({}), "");
    EXPECT_EQ(where({.width = 4}), "settings.width");
    EXPECT_EQ(where({.height = 100000}), "settings.height");
    EXPECT_EQ(where({.across = -1}), "settings.across");
    EXPECT_EQ(where({.tilt = 1.5}), "settings.tilt");
    EXPECT_EQ(where({.samples_per_pixel = 5}), "settings.samples_per_pixel");
    EXPECT_EQ(where({.threads = -1}), "settings.threads");
    Weave wide = weave("polyester taffeta");
    wide.warp.width = 1;
    EXPECT_THROW(weave_picture(wide, small()), Error);
    EXPECT_THROW(draft_picture(wide, small()), Error);
}

TEST(WeavePicture, StopsWhenItIsAsked) {
    const std::atomic<bool> stop{true};
    EXPECT_THROW(weave_picture(weave("polyester taffeta"), small(), {.stop = &stop}), Interrupted);
}

} // namespace
} // namespace tsuya::lab
