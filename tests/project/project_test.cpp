// Tsuya's rules about its own text, and for each rule texts that break it.
#include "project/citations.h"
#include "project/comments.h"
#include "project/documents.h"
#include "project/headers.h"
#include "project/includes.h"
#include "project/links.h"
#include "project/words.h"

#include <gtest/gtest.h>

namespace tsuya::project {
namespace {

const std::vector<TextFile> &repository() {
    static const std::vector<TextFile> files = read_repository(repository_root());
    return files;
}

/// A repository of one C++ file with one line.
std::vector<TextFile> one_line(const std::string &path, const std::string &line) {
    return {{path, "\n" + line + "\n"}};
}

TEST(Repository, IsFound) {
    EXPECT_GT(repository().size(), 20u);
    EXPECT_TRUE(std::any_of(repository().begin(), repository().end(),
                            [](const TextFile &file) { return file.path == kReferences; }));
}

TEST(Repository, IncludesFollowTheFolders) {
    const Findings findings = check_includes(repository());
    EXPECT_TRUE(findings.empty()) << as_text(findings);
}

TEST(Repository, CitesWhatReferencesDefine) {
    const CitationReport report = check_citations(repository());
    EXPECT_TRUE(report.findings.empty()) << as_text(report.findings);
    EXPECT_GT(report.citations, 0u);
    for (const std::string &key : report.unused)
        ADD_FAILURE() << kReferences << ": nobody cites [" << key << "]";
}

TEST(Repository, DocumentsRepeatCompiledCode) {
    const Findings findings = check_documents(repository());
    EXPECT_TRUE(findings.empty()) << as_text(findings);
}

TEST(Repository, LinksLeadSomewhere) {
    const Findings findings = check_links(repository(), [](const std::string &path) {
        return std::filesystem::exists(repository_root() / path);
    });
    EXPECT_TRUE(findings.empty()) << as_text(findings);
}

TEST(Repository, PagesNameEveryHeader) {
    const Findings findings = check_headers(repository());
    EXPECT_TRUE(findings.empty()) << as_text(findings);
}

TEST(Repository, NamesNoMachine) {
    const Findings findings = check_words(repository());
    EXPECT_TRUE(findings.empty()) << as_text(findings);
}

/// A source of one include, beside headers for it to find.
Findings include_findings(const std::string &path, const std::string &line) {
    std::vector<TextFile> files = one_line(path, line);
    for (const char *const header :
         {"sdk/values/include/tsuya/sdk/error.h", "sdk/reflectance/include/tsuya/sdk/brdf.h",
          "sdk/render/include/tsuya/sdk/scene.h", "garment/include/tsuya/garment/mesh.h",
          "color/include/tsuya/color/lamp.h", "lab/rig/include/tsuya/lab/line.h",
          "lab/weave/include/tsuya/lab/weave.h", "lab/goniometer/include/tsuya/lab/goniometer.h",
          "samples/scene/include/tsuya/scene/tryon.h", "garment/src/mesh/edges.h",
          "garment/src/repair/fans.h"})
        files.push_back({header, ""});
    return check_includes(files);
}

// Each of these must be flagged; a rule that lets one through checks nothing.
TEST(Includes, BadArrowsAreFlagged) {
    const std::vector<std::pair<std::string, std::string>> bad{
        {"sdk/values/src/a.cpp", "#include \"tsuya/sdk/brdf.h\""},
        {"sdk/values/include/tsuya/sdk/a.h", "#include \"tsuya/sdk/scene.h\""},
        {"sdk/reflectance/src/models/a.cpp", "#include \"tsuya/sdk/scene.h\""},
        {"sdk/render/src/a.cpp", "#  include <tsuya/garment/mesh.h>"},
        {"sdk/render/include/tsuya/sdk/a.h", "#include \"tsuya/scene/tryon.h\""},
        {"garment/src/a.cpp", "#include \"tsuya/color/lamp.h\""},
        {"garment/src/a.cpp", "#include \"tsuya/sdk/scene.h\""},
        {"garment/src/mesh/a.cpp", "#include \"repair/fans.h\""},
        {"color/src/a.cpp", "#include \"tsuya/garment/mesh.h\""},
        {"color/src/a.cpp", "#include \"tsuya/sdk/brdf.h\""},
        {"lab/rig/src/a.cpp", "#include \"tsuya/lab/weave.h\""},
        {"lab/rig/src/a.cpp", "#include \"tsuya/color/lamp.h\""},
        {"lab/weave/src/a.cpp", "#include \"tsuya/lab/goniometer.h\""},
        {"lab/weave/src/a.cpp", "#include \"tsuya/samples/a.h\""},
        {"samples/scene/src/a.cpp", "#include \"../tsuya/command.h\""},
        {"samples/tsuya/a.cpp", "#include \"tests/a.h\""},
        {"color/src/a.cpp", "#include \"tsuya/colour/a.h\""},
        {"color/src/a.cpp", "#include <embree3/rtcore.h>"},
        {"lab/rig/src/a.cpp", "#include <tbb/parallel_for.h>"},
        {"sdk/values/src/a.cpp", "#include <embree3/rtcore.h>"},
        {"sdk/render/include/tsuya/sdk/a.h", "#include <embree3/rtcore.h>"},
        {"sdk/values/include/tsuya/sdk/a.h", "#include <unistd.h>"},
        {"samples/scene/include/tsuya/scene/a.h", "#include <toml++/toml.h>"},
        {"tests/color/a_test.cpp", "#include <opensubdiv/far/patch.h>"},
        {"sdk/values/src/a.cpp", "#include <gtest/gtest.h>"},
        {"sdk/values/src/a.cpp", "#include <boost/optional.hpp>"},
        {"sdk/values/src/a.cpp", "#include \"missing.h\""},
    };
    for (const auto &[path, line] : bad) {
        const Findings findings = include_findings(path, line);
        ASSERT_EQ(findings.size(), 1u) << path << ' ' << line;
        EXPECT_TRUE(findings[0].starts_with(path + ":2: ")) << findings[0];
    }
}

TEST(Includes, PrivateHeadersStayPrivate) {
    const TextFile own{"sdk/values/src/a.h", ""};
    const auto count = [&](const std::string &path, const std::string &target) {
        return check_includes({own, {path, "#include \"" + target + "\"\n"}}).size();
    };
    EXPECT_EQ(count("sdk/values/src/b.cpp", "a.h"), 0u);
    EXPECT_EQ(count("sdk/values/include/tsuya/sdk/b.h", "a.h"), 1u);
    EXPECT_EQ(count("color/src/b.cpp", "../../sdk/values/src/a.h"), 1u);
    EXPECT_EQ(count("sdk/render/src/b.cpp", "../../values/src/a.h"), 1u);
    EXPECT_EQ(count("tests/color/b.cpp", "../../sdk/values/src/a.h"), 1u);
    EXPECT_EQ(count("tests/color/b.cpp", "a.h"), 1u);
    EXPECT_EQ(count("tests/sdk/b.cpp", "a.h"), 0u);
}

TEST(Includes, GoodOnesPass) {
    const std::vector<std::pair<std::string, std::string>> good{
        {"lab/weave/src/a.cpp", "#include \"tsuya/color/lamp.h\""},
        {"lab/goniometer/src/a.cpp", "#include \"tsuya/lab/weave.h\""},
        {"sdk/render/src/a.cpp", "#include \"tsuya/sdk/brdf.h\""},
        {"garment/src/repair/a.cpp", "#include \"mesh/edges.h\""},
        {"garment/src/a.cpp", "#include \"repair/fans.h\""},
        {"samples/tsuya/a.cpp", "#include \"tsuya/scene/tryon.h\""},
        {"samples/tsuya/a.cpp", "#include <CLI/CLI.hpp>"},
        {"sdk/values/include/tsuya/sdk/a.h", "#include <glm/vec3.hpp>"},
        {"sdk/values/include/tsuya/sdk/a.h", "#include <string_view>"},
        {"tests/color/a_test.cpp", "#include <OpenImageIO/imageio.h>"},
        {"sdk/values/src/a.cpp", "// #include \"tsuya/color/lamp.h\""},
        {"sdk/values/src/a.cpp", "auto s = R\"(\n#include \"tsuya/color/lamp.h\"\n)\";"},
    };
    for (const auto &[path, line] : good) {
        const Findings findings = include_findings(path, line);
        EXPECT_TRUE(findings.empty()) << as_text(findings);
    }
}

CitationReport cited(const std::string &path, const std::string &text) {
    return check_citations(
        {{std::string(kReferences), "# References\n\n- **[Known]** A paper.\n"}, {path, text}});
}

TEST(Citations, AKnownKeyPassesAndAnUnknownOneDoesNot) {
    EXPECT_TRUE(cited("a.cpp", "int x; // [Known] Eq. 15\n").findings.empty());
    EXPECT_TRUE(cited("a.cpp", "int x; // [Known] Eq. 15\n").unused.empty());
    EXPECT_EQ(cited("a.cpp", "int x; // as everybody knows\n").unused.size(), 1u);
    const std::vector<std::pair<std::string, std::string>> bad{
        {"a.cpp", "int x; // see [Unknown] Eq. 15\n"}, {"a.h", "/* from [Known],\n [Unknown] */\n"},
        {"a.md", "As in ([Unknown], Sect. 2)\n"},      {"a.toml", "x = 1 # [Unknown] Table 1\n"},
        {"CMakeLists.txt", "# as [Unknown] has it\n"},
    };
    for (const auto &[path, text] : bad)
        EXPECT_EQ(cited(path, text).findings.size(), 1u) << path << ": " << text;
}

TEST(Citations, AreNotFoundInCodeOrLinks) {
    const std::vector<std::pair<std::string, std::string>> good{
        {"a.cpp", "auto f = [Unknown] { return table [Unknown]; };\n"},
        {"a.cpp", "[[Nodiscard]] int x; // an array[Index], a range [Low, High), [N] values\n"},
        {"a.cpp", "auto s = \"// [Unknown]\"; char c = '\"'; // [Known]\n"},
        {"a.cpp", "int n = 1'000; auto s = R\"x(\" // [Unknown] )\" )x\";\n"},
        {"a.md", "[Link](there.md) and [Text][ref] and `v [Index]`\n\n```cpp\n// [Unknown]\n```\n"},
        {"a.toml", "[Section]\nname = \"x\"\n"},
    };
    for (const auto &[path, text] : good)
        EXPECT_TRUE(cited(path, text).findings.empty()) << as_text(cited(path, text).findings);
}

TEST(Citations, UnusedAndDoubleKeysAreTold) {
    EXPECT_EQ(cited("a.cpp", "int x;\n").unused, std::set<std::string>{"Known"});
    const std::string twice = "- **[Known]** A paper.\n- **[Known]** Another.\n";
    EXPECT_EQ(check_citations({{std::string(kReferences), twice}}).findings.size(), 1u);
    EXPECT_EQ(check_citations({}).findings.size(), 1u);
}

/// A document with the block, and the source that it is cut from.
Findings documented(const std::string &announcement, const std::string &block) {
    const std::string source = "int a;\n    // [doc:part]\n    if (b)\n        c();\n\n"
                               "    // [/doc:part]\n// [doc:twice]\nd();\n// [doc:twice]\n"
                               "// [doc:open]\n";
    return check_documents({{"tests/a_test.cpp", source},
                            {"README.md", announcement + "\n```cpp\n" + block + "\n```\n"}});
}

TEST(Documents, EqualCodePasses) {
    const std::string good = "<!-- code: tests/a_test.cpp [doc:part] -->";
    EXPECT_TRUE(documented(good, "if (b)\n    c();").empty());
    EXPECT_TRUE(documented(good + "\n", "\n  if (b)\n      c();  \n").empty());
    EXPECT_TRUE(documented("<!-- code: tests/a_test.cpp [doc:twice] -->", "d();").empty());
    EXPECT_TRUE(documented("<!-- code: not compiled: it shows an error -->", "x").empty());
}

TEST(Documents, EverythingElseIsFlagged) {
    const std::string good = "<!-- code: tests/a_test.cpp [doc:part] -->";
    const std::vector<std::pair<std::string, std::string>> bad{
        {good, "if (b)\n    d();"},
        {good, "if (b)\nc();"}, // its own indentation counts
        {good, "if (b)"},
        {good, "if (b)\n    c();\nd();"},
        {good, ""},
        {"", "if (b)\n    c();"},
        {good + "\nText.", "if (b)\n    c();"},
        {"<!-- code: tests/b_test.cpp [doc:part] -->", "if (b)\n    c();"},
        {"<!-- code: tests/a_test.cpp [doc:open] -->", ""},
        {"<!-- code: tests/a_test.cpp [doc:none] -->", ""},
        {"<!-- code: tests/a_test.cpp -->", "if (b)\n    c();"},
    };
    for (const auto &[announcement, block] : bad)
        EXPECT_EQ(documented(announcement, block).size(), 1u) << announcement << '\n' << block;
}

TEST(Headers, WithoutALineInThePageAreFlagged) {
    const auto count = [](const std::string &page) {
        return check_headers({{"lab/README.md", page},
                              {"lab/weave/include/tsuya/lab/wif.h", ""},
                              {"lab/weave/include/tsuya/lab/detail/inside.h", ""},
                              {"lab/weave/src/own.h", ""}})
            .size();
    };
    EXPECT_EQ(count("| `wif.h` | drafts |"), 0u);
    EXPECT_EQ(count("| `tsuya/lab/wif.h` | drafts |"), 0u);
    EXPECT_EQ(count("| `twif.h` | drafts, wif.h |"), 1u);
    EXPECT_EQ(check_headers({{"lab/include/a.h", ""}}).size(), 1u);
}

TEST(Links, LeadToFilesAndFolders) {
    const auto count = [](const std::string &line) {
        return check_links(one_line("sdk/docs/a.md", line),
                           [](const std::string &path) {
                               return path == "README.md" || path == "sdk/docs/b.svg" ||
                                      path == "sdk";
                           })
            .size();
    };
    for (const std::string good :
         {"[a](../../README.md)", "[a](../../README.md#b)", "![a](b.svg)", "[a](..)", "[a](#b)",
          "[a](https://a.org/b)", "`[a](missing.md)`"})
        EXPECT_EQ(count(good), 0u) << good;
    for (const std::string bad : {"[a](README.md)", "![a](missing.svg), [b](b.svg)",
                                  "[`a`](missing.md)", "[a](../../../README.md)"})
        EXPECT_EQ(count(bad), 1u) << bad;
}

TEST(Words, MachinesAreFlagged) {
    const std::string sl = "/"; // so that this file does not say the words itself
    for (const std::string &bad : {sl + "work/main", "cd " + sl + "work", "'" + sl + "root/.cache'",
                                   "-B " + sl + "tmp/build-x", "../shared" + sl + "data/x.csv",
                                   "../shared" + sl + "cases", sl + "home/somebody/x"})
        EXPECT_EQ(check_words(one_line("a.sh", bad)).size(), 1u) << bad;
    for (const std::string &good : {std::string("network/workflow"), "https://a.org" + sl + "work/",
                                    "$HOME" + sl + "work/x", sl + "workers"})
        EXPECT_TRUE(check_words(one_line("a.sh", good)).empty()) << good;
    EXPECT_TRUE(check_words(one_line(".ci/run", "../shared" + sl + "data")).empty());
}

} // namespace
} // namespace tsuya::project
