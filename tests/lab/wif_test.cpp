#include "tsuya/lab/wif.h"

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

/// An 8-end satin, counter 3, straight threading: the n-th pick sinks shaft 3 (n - 1) mod 8 + 1.
constexpr const char *kHead = "; made by hand\n[WIF]\nVersion=1.1\nDate=April 20, 1997\n"
                              "Developers=wif@mhsoft.com\nSource Program=hand\n"
                              "[CONTENTS]\nTHREADING=true\n[Notes]\n1=ignored\n"
                              "[TEXT]\nTitle=Hand satin\n";
constexpr const char *kSatinYarns = "[WARP]\nThreads=16\nUnits=centimeters\nSpacing=0.025\n"
                                    "[WEFT]\nThreads=8\nUnits=decipoints\nSpacing=14.4\n"
                                    "[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=5\n6=6\n7=7\n8=8\n9=1\n"
                                    "10=2\n11=3\n12=4\n13=5\n14=6\n15=7\n16=8\n";
constexpr const char *kTreadled =
    "[WEAVING]\nShafts=8\nTreadles=8\nRising Shed=true\n"
    "[TIEUP]\n1=2,3,4,5,6,7,8\n2=1,3,4,5,6,7,8\n3=1,2,4,5,6,7,8\n4=1,2,3,5,6,7,8\n"
    "5=1,2,3,4,6,7,8\n6=1,2,3,4,5,7,8\n7=1,2,3,4,5,6,8\n8=1,2,3,4,5,6,7\n"
    "[TREADLING]\n1=1\n2=4\n3=7\n4=2\n5=5\n6=8\n7=3\n8=6\n";
constexpr const char *kLifted =
    "[WEAVING]\r\nShafts=8\r\n[LIFTPLAN]\r\n1=2,3,4,5,6,7,8\r\n2=1, 2, 3, 5, 6, 7, 8\r\n"
    "3=1,2,3,4,5,6,8\r\n4=1,3,4,5,6,7,8\r\n5=1,2,3,4,6,7,8\r\n6=1,2,3,4,5,6,7\r\n"
    "7=1,2,4,5,6,7,8\r\n8=1,2,3,4,5,7,8\r\n";
constexpr const char *kSunk = "[weaving]\nshafts=8\nrising shed=FALSE\n[liftplan]\n"
                              "1=1\n2=4\n3=7\n4=2\n5=5\n6=8\n7=3\n8=6\n";

std::string satin_text(const char *how) { return std::string(kHead) + kSatinYarns + how; }

std::vector<Problem> problems_of(const std::string &text) {
    try {
        parse_wif(text, "d.wif");
    } catch (const Error &error) {
        return error.problems();
    }
    return {};
}

/// The text with one line replaced; the number of that line.
std::pair<std::string, int> with(std::string text, const std::string &line,
                                 const std::string &replacement) {
    const std::size_t at = text.find("\n" + line + "\n") + 1;
    EXPECT_NE(at, 0u) << line;
    const int number = 1 + static_cast<int>(std::count(
                               text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    return {text.replace(at, line.size(), replacement), number};
}

TEST(Wif, ASatinComesOutOfTieUpLiftplanAndSinkingShed) {
    for (const char *how : {kTreadled, kLifted, kSunk}) {
        const Wif wif = parse_wif(satin_text(how), "d.wif");
        EXPECT_EQ(wif.title, "Hand satin");
        EXPECT_EQ(wif.drawdown.ends, 16);
        EXPECT_EQ(wif.drawdown.picks, 8);
        EXPECT_EQ(wif.draft, satin(8, 3)) << how;
        check_draft(wif.draft, "d.wif");
        EXPECT_NEAR(wif.warp.spacing.value(), 0.25e-3, 1e-12);
        EXPECT_NEAR(wif.weft.spacing.value(), 14.4 * 0.0254 / 720, 1e-12);
        EXPECT_TRUE(wif.warp.color.empty());
    }
}

constexpr const char *kTwill =
    "[WIF]\nVersion=1.1\n[WARP]\nThreads=8\nColor=1\nUnits=inches\n[WEFT]\nThreads=4\nColor=2,1,2,"
    "3\n"
    "[WEAVING]\nShafts=4\nTreadles=4\n[COLOR PALETTE]\nRange=0,100\nEntries=3\n"
    "[COLOR TABLE]\n1=100,0,0\n2=0,100,50\n3=25,25,25\n"
    "[WARP COLORS]\n2=3\n[WARP SPACING]\n1=0.02\n2=0.04\n"
    "[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n6=2\n7=3\n8=4\n"
    "[TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n";

TEST(Wif, AColouredTwillHasItsColoursAndSpacings) {
    const Wif wif = parse_wif(kTwill, "d.wif");
    EXPECT_EQ(wif.draft, twill(2, 2));
    ASSERT_EQ(wif.warp.color.size(), 8u);
    ASSERT_EQ(wif.weft.color.size(), 4u);
    EXPECT_EQ(wif.warp.color[0], glm::dvec3(1, 0, 0));
    EXPECT_EQ(wif.warp.color[1], glm::dvec3(0.25));
    EXPECT_EQ(wif.weft.color[3], glm::dvec3(0, 1, 0.5));
    EXPECT_NEAR(wif.warp.spacing.value(), 0.03 * 0.0254, 1e-12);
    EXPECT_FALSE(wif.weft.spacing.has_value());
}

// Two treadles at once lift what either lifts; a thread without shaft stays down.
TEST(Wif, TreadlesAddUpAndShaftNoneStaysDown) {
    const Wif wif = parse_wif("[WIF]\n[WARP]\nThreads=3\n[WEFT]\nThreads=2\n[WEAVING]\nShafts=2\n"
                              "Treadles=2\n[THREADING]\n1=1\n2=2\n3=0\n[TIEUP]\n1=1\n2=2\n"
                              "[TREADLING]\n1=1,2\n2=2\n",
                              "d.wif");
    EXPECT_EQ(wif.drawdown.warp_up, (std::vector<unsigned char>{1, 1, 0, 0, 1, 0}));
    EXPECT_THROW(check_draft(wif.draft, "d.wif"), Error);
}

TEST(Wif, WrongValuesAreToldWithLineAndColumn) {
    struct Row {
        const char *line, *bad;
        int column;
        const char *what;
    };
    const Row rows[] = {
        {"Threads=8", "Threads=eight", 9, "threads is \"eight\""},
        {"Threads=8", "Threads=0", 9, "threads is \"0\""},
        {"Threads=8", "Threads=5000", 9, "threads is \"5000\""},
        {"Threads=8", "Thread=8", 1, "[WARP] has no threads"},
        {"Shafts=4", "Shafts = 257", 10, "shafts is \"257\""},
        {"Treadles=4", "Treadles=", 10, "treadles is \"\""},
        {"Color=1", "Color=4", 7, "colour \"4\" is not in the colour table"},
        {"Units=inches", "Units=feet", 7, "unknown unit \"feet\""},
        {"Range=0,100", "Range=100,0", 7, "range is \"100,0\""},
        {"2=0,100,50", "2=0,100,500", 9, "\"500\" in 2"},
        {"1=0.02", "1=-0.02", 3, "1 is \"-0.02\""},
        {"1=0.02", "1=nan", 3, "1 is \"nan\""},
        {"1=1,2", "1=1,5", 5, "\"5\" in 1"},
        {"8=4", "9=4", 1, "key \"9\""},
        {"8=4", "  x = 4", 3, "key \"x\""},
        {"8=4", "8:4", 1, "a line without `=`"},
        {"[TIEUP]", "[TIEUP", 1, "a section without its closing bracket"},
        {"[WEFT]", "[WOOF]", 1, "section [weft] is missing"},
    };
    ASSERT_TRUE(problems_of(kTwill).empty());
    for (const Row &row : rows) {
        SCOPED_TRACE(row.bad);
        const auto [text, line] = with(kTwill, row.line, row.bad);
        const std::vector<Problem> problems = problems_of(text);
        ASSERT_FALSE(problems.empty());
        EXPECT_EQ(problems[0].what, row.what);
        EXPECT_FALSE(problems[0].accepted.empty());
        const int told = std::string(row.what).starts_with("[WARP]")      ? 3
                         : std::string(row.what).starts_with("section [") ? 1
                                                                          : line;
        EXPECT_EQ(problems[0].where,
                  "d.wif:" + std::to_string(told) + ":" + std::to_string(row.column));
    }
    EXPECT_EQ(problems_of("1=2\n[WIF]\n")[0].where, "d.wif:1:1");
}

TEST(Wif, FilesOfOldProgramsAreRead) {
    std::string text = satin_text(kLifted);
    text.replace(text.find("Hand satin"), 4, "H\xE4nd");
    std::replace(text.begin(), text.end(), '\n', '\r');
    const auto path = std::filesystem::path(testing::TempDir()) / "old.wif";
    write_file(path, "\xEF\xBB\xBF" + text);
    const Wif wif = read_wif(path);
    std::filesystem::remove(path);
    EXPECT_EQ(wif.title, "H\\xE4nd satin");
    EXPECT_EQ(wif.draft, satin(8, 3));
}

TEST(Wif, ProblemsAreCollectedUpToTwenty) {
    std::string text(kTwill);
    text += "[WEFT COLORS]\n";
    for (int i = 0; i < 30; ++i)
        text += "1=7\n";
    EXPECT_EQ(problems_of(text).size(), kMaxProblems);
    EXPECT_EQ(problems_of("").size(), 4u); // WIF, WARP, WEFT, WEAVING
    EXPECT_EQ(problems_of(std::string((4u << 20) + 1, ' ')).size(), 1u);
    EXPECT_THROW(read_wif("no/such/file.wif"), Error);
}

} // namespace
} // namespace tsuya::lab
