#include "tsuya/color/palette.h"

#include "color_test.h"
#include "tsuya/color/dye.h"

namespace tsuya {
namespace {

using Texts = std::vector<std::string>;

TEST(Palette, StandsForTheSpectraOfItsFile) {
    const test::Folder folder;
    const std::string file =
        folder.write("range.csv", "nm,navy,moss\n400,0.1,0.2\n550,0.2,0.4\n700,0.1,0.2\n").string();
    const Texts specs{"crimson", file + ":*", file + ":moss"};
    const Texts expanded = expand_palettes(specs);
    EXPECT_EQ(expanded, (Texts{"crimson", file + ":navy", file + ":moss", file + ":moss"}));
    EXPECT_EQ(parse_dye(expanded[2]).at(550), 0.4);
}

TEST(Palette, RefusesAFileThatIsNotThere) {
    const test::Folder folder;
    const std::string absent = (folder / "absent.csv").string();
    const Texts specs{absent + ":*"};
    test::expect_problem([&] { expand_palettes(specs); }, absent, "No such file");
}

} // namespace
} // namespace tsuya
