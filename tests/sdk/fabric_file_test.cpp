// F.fabric.toml: what is written is read back, and what is wrong is told with its place.

#include "tsuya/sdk/fabric.h"

#include <clocale>
#include <cmath>
#include <locale>

#include <gtest/gtest.h>

#include "sdk/files_fixture.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::test {
namespace {

using FabricFile = FilesTest;
using WholeFile = FilesTest;

Fabric read_it(const std::filesystem::path &file) { return read_fabric(file); }

Fabric satin() {
    Fabric fabric{.name = "black \"satin\" \\ 5 ends"};
    fabric.keys = {{"instrument", "made up"}, {"a key", "a value"}};
    fabric.specular = CarriedViews{.bard = bard_of(satin_cloth()), .f0 = 0.05};
    fabric.colours.dye = {{400, 550, 700}, {0.1, 0.25, 0.9}};
    fabric.colours.transmittance = {{450, 650}, {0.02, 0.1}};
    fabric.colours.specular_tint = Spectrum::constant(0.8);
    return fabric;
}

TEST_F(FabricFile, IsReadBackAsWritten) {
    Fabric fabric = satin();
    fabric.colours.weft_tint = {{450, 650}, {0.9, 0.2}};
    fabric.colours.warp_dye = {{450, 650}, {0.1, 0.2}};
    fabric.colours.lustre = Lustre::semi_dull;
    fabric.colours.delustre = 0.35;
    write_fabric(fabric, file("satin.fabric.toml"));
    const Fabric back = read_fabric(file("satin.fabric.toml"));
    EXPECT_EQ(back.name, fabric.name);
    EXPECT_EQ(back.keys, fabric.keys);
    EXPECT_EQ(back.colours, fabric.colours);
    EXPECT_TRUE(back.spare.empty());
    const auto *const views = std::get_if<CarriedViews>(&back.specular);
    ASSERT_TRUE(views);
    EXPECT_EQ(views->model, ViewModel::yarn);
    EXPECT_EQ(views->f0, 0.05);
    const Bard &bard = *views_of(fabric);
    EXPECT_EQ(views->bard.views().size(), bard.views().size());
    for (double theta = 0; theta < 90; theta += 7)
        for (double phi = 0; phi < 360; phi += 23) {
            const double a = bard.at(direction(theta, phi));
            EXPECT_NEAR(views->bard.at(direction(theta, phi)), a, 1e-3 * a);
        }
}

TEST_F(FabricFile, YarnsAreReadBackAsWritten) {
    Fabric fabric{.name = "yarns"};
    YarnLobes lobes{.f0 = 0.0479, .roughness = 0.08, .pit = {0.125, 0.05}, .even = 0.003};
    lobes.surface[0][24] = 0.75;
    lobes.surface[1][20] = 0.5;
    fabric.specular = lobes;
    write_fabric(fabric, file("y.fabric.toml"));
    const Fabric back = read_fabric(file("y.fabric.toml"));
    EXPECT_EQ(back, fabric);
    const Material material =
        resolve(back, "yarns"); // without views, slopes not as their opposites
    const YarnBrdf expected(lobes, Symmetry::none);
    const glm::vec3 light = direction(40, 10), view = direction(60, 170);
    EXPECT_EQ(material.specular->evaluate(light, view), expected.evaluate(light, view));
    for (const auto &[from, to] : {std::pair{"pit_warp = 0.05", "pit_warp = -0.05"},
                                   {"pit_weft = 0.125", ""},
                                   {"roughness = 0.08", "roughness = 0"},
                                   {"even = 0.003", "even = 2"},
                                   {"surface_warp = [0,", "surface_warp = ["},
                                   {"surface_weft = [0,", "surface_weft = [-1,"},
                                   {"pit_weft = 0.125", "pit_weft = 0.125\npits = 1"}}) {
        std::string text = read_file(file("y.fabric.toml"));
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, std::string(from).size(), to);
        EXPECT_EQ(problems_of(read_it, file("bad.fabric.toml", text)).size(), 1u) << to;
    }
}

TEST_F(FabricFile, AWeaveIsReadBackAsWritten) {
    Fabric fabric{.name = "woven", .specular = YarnLobes{}};
    for (const ClothWeave &weave : {ClothWeave{.preset = "polyester taffeta"},
                                    ClothWeave{.file = "dupion\n\"silk\".weave.toml",
                                    .irregularity = {.thickness = 0.125,
                                                    .filament = 0.0625,
                                                    .slubs_per_m = 12,
                                                    .slub_length = 0.03125,
                                                    .slub_gain = 1.5,
                                                    .seed = 7}}}) {
        fabric.weave = weave;
        write_fabric(fabric, file("w.fabric.toml"));
        EXPECT_EQ(read_fabric(file("w.fabric.toml")).weave, weave);
    }
}

TEST_F(FabricFile, SymmetryIsKept) {
    for (const Cloth &cloth : {satin_cloth(), twisted_cloth(), leaning_cloth()}) {
        Fabric fabric{.name = "cloth"};
        fabric.specular = CarriedViews{.bard = bard_of(cloth)};
        write_fabric(fabric, file("c.fabric.toml"));
        const Fabric back = read_fabric(file("c.fabric.toml"));
        EXPECT_EQ(views_of(back)->symmetry(), cloth.symmetry);
        EXPECT_FALSE(find_specular<CarriedViews>(back)->f0);
    }
}

TEST_F(FabricFile, AFabricWithoutViewsIsOnlyDye) {
    const auto name = file("d.fabric.toml", "schema = \"tsuya-fabric 1\"\nname = \"dye\"\n"
                                            "[dye]\nconstant = 0.5\n");
    const Fabric fabric = read_fabric(name);
    EXPECT_FALSE(views_of(fabric));
    const Material material = resolve(fabric, "dye");
    EXPECT_TRUE(material.has_diffuse());
    EXPECT_FALSE(material.has_specular());
}

// Numbers are written alike in every country.
struct GermanNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST_F(FabricFile, DoesNotDependOnTheLocale) {
    write_fabric(satin(), file("a.fabric.toml"));
    write_reflectance_table(normal_table(satin_cloth(), even_grid(30, 45)), file("a.csv"));
    const std::locale before = std::locale::global(std::locale(std::locale(), new GermanNumbers));
    const char *const c_locale = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
    write_fabric(satin(), file("b.fabric.toml"));
    write_reflectance_table(normal_table(satin_cloth(), even_grid(30, 45)), file("b.csv"));
    if (c_locale)
        std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before);
    EXPECT_EQ(read_file(file("a.fabric.toml")), read_file(file("b.fabric.toml")));
    EXPECT_EQ(read_file(file("a.csv")), read_file(file("b.csv")));
}

const std::string kStart = "schema = \"tsuya-fabric 1\"\nname = \"f\"\n"; // lines 1 and 2

TEST_F(FabricFile, BadOnesAreRefusedWithLineAndColumn) {
    struct Bad {
        std::string text, where, what;
    };
    const std::string with_views = kStart + "symmetry = \"none\"\n[views]\n"; // lines 3 and 4
    const std::string views = with_views + "theta_deg = [0, 30]\nphi_deg = [0, 0]\n";
    for (const Bad &bad : {
             Bad{"name = \"f\"\n", ":1:1", "schema"},
             {"schema = \"tsuya-fabric 9\"\nname = \"f\"\n", ":1:10", "tsuya-fabric 9"},
             {"schema = \"tsuya-fabric 1\"\n", ":1:1", "name"},
             {"schema = \"tsuya-fabric 1\"\nname = 3\n", ":2:8", "name"},
             {kStart + "f0 = 0\n", ":3:6", "f0"},
             {kStart + "f0 = 1.5\n", ":3:6", "f0"},
             {kStart + "f0 = nan\n", ":3:6", "f0"},
             {kStart + "f0 = \"0.05\"\n", ":3:6", "f0"},
             {kStart + "f0 = 0.05\n", ":3:6", "without [views]"},
             {kStart + "symmetry = \"orthtropic\"\n", ":3:12", "orthtropic"},
             {kStart + "dye = 0.5\n", ":3:7", "dye"},
             {kStart + "[dye]\nconstant = -0.5\n", ":4:12", "constant"},
             {kStart + "[dye]\nwavelength_nm = [400, 500]\nvalue = [0.5]\n", ":3:1", "wavelengths"},
             {kStart + "[dye]\nwavelength_nm = [500, 400]\nvalue = [0, 1]\n", ":3:1", "increase"},
             {kStart + "[dye]\nwavelength_nm = [400, 500]\nvalue = [0, 2]\n", ":3:1", "500"},
             {kStart + "[dye]\nwavelength_nm = [400, \"a\"]\nvalue = [0, 1]\n", ":4:17",
              "wavelength_nm"},
             {views + "brdf_per_sr = [1]\n", ":7:15", "length"},
             {views + "brdf_per_sr = [1, nan]\n", ":7:15", "brdf_per_sr"},
             {views + "brdf_per_sr = [1, -1]\n", ":7:15", "view 1"},
             {with_views + "theta_deg = [0, 95]\nphi_deg = [0, 0]\nbrdf_per_sr = [1, 1]\n", ":7:15",
              "view 1"},
             {kStart + "[views]\n", ":1:1", "'symmetry' is missing"},
             {kStart + "[smoothness]\nweft_support = 1\n", ":3:1", "missing"},
             {kStart + "[weave]\n", ":3:1", "no weave"},
             {kStart + "[weave]\npreset = \"a\"\nfile = \"b\"\n", ":3:1", "two weaves"},
             {kStart + "[weave]\npreset = \"a\"\n[irregularity]\nthickness = 2\n", ":6:13",
              "thickness"},
             {kStart + "[irregularity]\nthickness = 0.1\n", ":3:1", "without [weave]"},
             {kStart + "[weave]\npreset = \"a\"\n[irregularity]\nslubs_per_m = 50\n"
                       "slub_length_m = 0.05\n",
              ":7:17", "slubs of 0.05 m do not fit 50 times in a metre"},
             {kStart + "[weave]\npreset = \"a\"\n[irregularity]\nslubs_per_m = 60\n", ":6:15",
              "slubs of 0.02 m do not fit 60 times in a metre"},
             {kStart + "[[", ":3:3", ""},
         }) {
        const auto problems = problems_of(read_it, file("f.fabric.toml", bad.text));
        EXPECT_EQ(problems[0].where, bad.where) << bad.text << problems[0].what;
        EXPECT_NE(problems[0].what.find(bad.what), std::string::npos) << problems[0].what;
    }
}

TEST_F(FabricFile, AWrongLustreHasASuggestion) {
    const auto problems = [&](const std::string &line) {
        return problems_of(
            [](const auto &name) { read_fabric(name); },
            file("f.fabric.toml", "schema = \"tsuya-fabric 1\"\nname = \"f\"\n" + line));
    };
    EXPECT_EQ(problems("lustre = \"semidull\"\n").at(0).where, ":3:10");
    EXPECT_NE(problems("lustre = \"semidull\"\n").at(0).accepted.find("semi-dull"),
              std::string::npos);
    EXPECT_EQ(problems("delustre = 1.5\n").at(0).where, ":3:12");
}

TEST_F(FabricFile, UnknownKeysAreRefusedWithTheNearestKnown) {
    const auto name = file("f.fabric.toml", kStart + "f_0 = 0.5\n[views]\nthetadeg = [0]\n[dy]\n");
    const auto problems = problems_of(read_it, name);
    const auto expect = [&](const std::string &where, const std::string &accepted) {
        EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [&](const Problem &p) {
            return p.where == where && p.what.find("unknown key") == 0 &&
                   p.accepted.find("did you mean " + accepted + "?") != std::string::npos;
        })) << where;
    };
    expect(":3:1", "f0");
    expect(":5:1", "theta_deg");
    expect(":6:2", "dye");
}

TEST_F(FabricFile, NamesItsModelFacetsAndTable) {
    write_reflectance_table(paper_table(satin_cloth(), 30, 90), file("all.csv"));
    const GgxFacets facets{.alpha_weft = 0.25, .alpha_warp = 0.5, .refractive_index = 1.6};
    Fabric fabric = satin();
    fabric.spare = {fabric.specular, TabulatedSpecular{.file = "all.csv"}};
    fabric.specular = facets;
    write_fabric(fabric, file("f.fabric.toml"));
    const Fabric back = read_fabric(file("f.fabric.toml"));
    EXPECT_EQ(model_of(back), "ggx");
    EXPECT_EQ(back.specular, Specular(facets));
    const auto *const tabulated = find_specular<TabulatedSpecular>(back);
    ASSERT_TRUE(tabulated);
    EXPECT_EQ(tabulated->table.rows.size(), paper_table(satin_cloth(), 30, 90).rows.size());
    // The views are kept: nothing is lost by reading and writing
    ASSERT_TRUE(views_of(back));
    write_fabric(back, file("again.fabric.toml"));
    EXPECT_EQ(read_file(file("again.fabric.toml")), read_file(file("f.fabric.toml")));
    EXPECT_TRUE(resolve(back, "f").specular->get_if<GgxBrdf>());
    // Facets alone make a material too
    const auto plastic = file("p.fabric.toml", kStart + "model = \"ggx\"\n[ggx]\nalpha_weft = 0.2\n"
                                                        "alpha_warp = 0.2\nf0 = 0.04\n");
    EXPECT_TRUE(resolve(read_fabric(plastic), "p").has_specular());
}

TEST_F(FabricFile, WrongModelsAndFacetsHaveAPlace) {
    const auto where = [&](const std::string &text) {
        return problems_of(read_it, file("f.fabric.toml", kStart + text)).at(0).where;
    };
    EXPECT_EQ(where("model = \"takedo\"\n"), ":3:9");
    EXPECT_EQ(where("[ggx]\nalpha_weft = 2\nalpha_warp = 0.1\n"), ":4:14");
    EXPECT_EQ(where("[ggx]\nalpha_weft = 0.2\n"), ":3:1");
    EXPECT_EQ(where("[ggx]\nalpha_weft = 0.2\nalpha_warp = 0.1\nf0 = 0.1\n"
                    "refractive_index = 1.5\n"),
              ":7:20");
}

TEST_F(FabricFile, TooFewViewsNameTheFile) {
    const auto name =
        file("f.fabric.toml", kStart + "symmetry = \"none\"\n[views]\ntheta_deg = [0, 30]\n"
                                       "phi_deg = [0, 0]\nbrdf_per_sr = [1, 1]\n");
    EXPECT_EQ(problems_of(read_it, name)[0].where, ": views");
}

TEST_F(WholeFile, WritesToNoFolderLeaveNothing) {
    const auto missing = file("missing") / "t.csv";
    for (const auto &write : std::vector<std::function<void()>>{
             [&] { write_file(missing, "text"); },
             [&] {
                 write_reflectance_table(normal_table(satin_cloth(), even_grid(30, 90)), missing);
             },
             [&] { write_fabric(satin(), missing); }}) {
        try {
            write();
            ADD_FAILURE() << "expected an Error";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, missing.string());
        }
    }
    EXPECT_TRUE(is_empty());
}

TEST_F(WholeFile, AFailedReplacementKeepsTheOldAndNoPart) {
    std::filesystem::create_directory(file("t.csv")); // a folder cannot be replaced by a file
    EXPECT_THROW(write_file(file("t.csv"), "text"), Error);
    EXPECT_TRUE(std::filesystem::is_directory(file("t.csv")));
    std::filesystem::remove(file("t.csv"));
    EXPECT_TRUE(is_empty());
}

TEST_F(WholeFile, IsReadAsWritten) {
    const std::string bytes("a\0b\r\n\xff", 6);
    write_file(file("x.bin"), bytes);
    EXPECT_EQ(read_file(file("x.bin")), bytes);
    EXPECT_EQ(temporary_name(file("x.exr")).extension(), ".exr");
    EXPECT_THROW(read_file(file("none")), Error);
    EXPECT_THROW(read_file(file("x.bin").parent_path()), Error);
}

TEST_F(WholeFile, DocumentsMayHaveAMarkAndReturnsButNoOtherCodePage) {
    const Document document(file("d.toml", "\xEF\xBB\xBF[a]\rk = \"\xC3\xA9\"\r"));
    EXPECT_EQ(document.root().section("a")->required_text("k"), "\xC3\xA9");
    const auto problems = problems_of([](const auto &name) { Document{name}; },
                                      file("e.toml", "# \xE9\nk = \"\xE9\"\n"));
    EXPECT_EQ(problems.at(0).where, ":1:3");
    EXPECT_EQ(problems.at(0).accepted, "expected a file saved as UTF-8");
}

TEST_F(WholeFile, SectionsKeepTheOrderOfTheFile) {
    const Document document(file("d.toml", "z = { k = \"1\" }\n[b]\nk = \"2\"\n[a]\nk = \"3\"\n"));
    std::string order;
    for (const auto &[key, section] : document.root().sections())
        order += key + section.required_text("k");
    EXPECT_EQ(order, "z1b2a3");
    EXPECT_NO_THROW(document.finish());
}

} // namespace
} // namespace tsuya::test
