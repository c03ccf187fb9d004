#include "tsuya/lab/draft.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

/// Rows from the first pick on, X where the warp is above.
Draft drawn(const std::vector<std::string> &rows) {
    Draft draft{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
    for (const std::string &row : rows)
        for (const char c : row)
            draft.warp_up.push_back(c == 'X' ? 1 : 0);
    return draft;
}

std::string problem_of(const Draft &draft) {
    try {
        check_draft(draft, "cloth");
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "cloth");
        return error.problems()[0].what;
    }
    return "";
}

TEST(Draft, NamedDraftsHoldAndHaveTheFloatsOfTheirNames) {
    struct Row {
        const char *name;
        int size, warp_float, weft_float;
        double warp_share;
    };
    const Row rows[] = {{"plain", 2, 1, 1, 0.5},
                        {"twill 2/2", 4, 2, 2, 0.5},
                        {"twill 3/1", 4, 3, 1, 0.75},
                        {"satin 5", 5, 4, 1, 0.8},
                        {"satin 8", 8, 7, 1, 0.875}};
    ASSERT_EQ(draft_names().size(), std::size(rows));
    for (const Row &row : rows) {
        SCOPED_TRACE(row.name);
        const Draft draft = parse_draft(row.name);
        check_draft(draft, row.name);
        EXPECT_EQ(draft.ends, row.size);
        EXPECT_EQ(draft.picks, row.size);
        EXPECT_DOUBLE_EQ(warp_share(draft), row.warp_share);
        for (const int length : warp_floats(draft))
            EXPECT_EQ(length, row.warp_float);
        for (const int length : weft_floats(draft))
            EXPECT_EQ(length, row.weft_float);
        EXPECT_EQ(warp_floats(draft).size(), weft_floats(draft).size());
        EXPECT_EQ(smallest_repeat(draft), draft);
    }
}

TEST(Draft, ASatinBindsEachYarnOnceAndNoTwoBindingsTouch) {
    for (const char *name : {"satin 5", "satin 8", "satin 7/3", "satin 12/5"}) {
        SCOPED_TRACE(name);
        const Draft draft = parse_draft(name);
        for (int e = 0; e < draft.ends; ++e) {
            int bindings = 0;
            for (int p = 0; p < draft.picks; ++p) {
                bindings += !draft.up(e, p);
                for (int de = -1; de <= 1; ++de)
                    for (int dp = -1; dp <= 1; ++dp)
                        EXPECT_TRUE(draft.up(e, p) || draft.up(e + de, p + dp) ||
                                    (de == 0 && dp == 0))
                            << e << " " << p;
            }
            EXPECT_EQ(bindings, 1);
        }
    }
    EXPECT_FALSE(parse_draft("satin 8").up(3, 1)); // counter 3
    EXPECT_FALSE(parse_draft("satin 5").up(2, 1)); // counter 2
}

TEST(Draft, ATwillRisesToTheRight) {
    const Draft draft = parse_draft("twill 2/2");
    for (int e = 0; e < 4; ++e)
        for (int p = 0; p < 4; ++p)
            EXPECT_EQ(draft.up(e, p), draft.up(e + 1, p + 1));
    EXPECT_EQ(draft, drawn({"XX..", ".XX.", "..XX", "X..X"}));
}

TEST(Draft, NamesThatDoNotExistAreRefused) {
    for (const char *name : {"", "satin", "satin 6", "satin 6/2", "satin 5/4", "satin 5/1",
                             "twill 1/1", "twill 0/3", "twill 2", "twill 2/x", "twill 600/600"}) {
        SCOPED_TRACE(name);
        try {
            parse_draft(name, "cloth.toml:2:9");
            ADD_FAILURE() << "accepted";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].where, "cloth.toml:2:9");
            EXPECT_FALSE(error.problems()[0].accepted.empty());
        }
    }
    try {
        parse_draft("satin5");
        ADD_FAILURE();
    } catch (const Error &error) {
        EXPECT_NE(error.problems()[0].accepted.find("did you mean satin 5"), std::string::npos)
            << error.what();
    }
}

TEST(Draft, YarnsThatFloatForEverAreRefused) {
    EXPECT_EQ(problem_of(drawn({"X.X", ".XX"})), "warp end 3 floats for ever");
    EXPECT_EQ(problem_of(drawn({"X..", ".X."})), "warp end 3 floats for ever");
    EXPECT_EQ(problem_of(drawn({"X.", "XX", ".X"})), "weft pick 2 floats for ever");
    EXPECT_EQ(problem_of(drawn({"X."})), "a repeat of 2 ends and 1 pick");
    EXPECT_EQ(problem_of({2, 2, {1, 0, 0}}), "the draft has 3 crossings");
}

// Two plain weaves, one lying on the other: each yarn is bound, the cloth is not.
TEST(Draft, ClothThatFallsApartIsRefused) {
    const Draft two = drawn({"X.XX", ".XXX", "..X.", "...X"});
    EXPECT_NE(problem_of(two).find("falls apart"), std::string::npos) << problem_of(two);
    const Draft stitched = drawn({"X.X.", ".XXX", "..X.", "...X"});
    EXPECT_EQ(problem_of(stitched), "");
}

TEST(Draft, FloatsRunOnIntoTheNextRepeat) {
    const Draft draft = drawn({"X.", "X.", ".X", "X."});
    std::vector<int> floats = warp_floats(draft);
    EXPECT_EQ(floats, (std::vector<int>{3, 1}));
}

TEST(Draft, TheSmallestRepeatIsTheSameCloth) {
    const Draft satin5 = satin(5, 2);
    Draft large{15, 10, {}};
    for (int p = 0; p < 10; ++p)
        for (int e = 0; e < 15; ++e)
            large.warp_up.push_back(satin5.up(e, p) ? 1 : 0);
    EXPECT_EQ(smallest_repeat(large), satin5);
    large.warp_up[0] ^= 1;
    EXPECT_EQ(smallest_repeat(large), large);
}

} // namespace
} // namespace tsuya::lab
