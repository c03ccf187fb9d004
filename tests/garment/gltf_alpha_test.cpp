// glTF materials that let light through: as opacities, or as findings that say why not.

#include <gtest/gtest.h>

#include "garment/gltf_problem.h"
#include "tsuya/garment/garment.h"

namespace tsuya::garment {
namespace {

using namespace test;

MeshFile read_square(const std::string &material, const std::string &members = "") {
    return parse_gltf(glb(square_with(members, "", material), square_buffer()), "m.glb");
}

std::string with_picture(const std::string &mode, const std::string &more = "") {
    return R"(,"alphaMode":")" + mode +
           R"(","pbrMetallicRoughness":{"baseColorTexture":{"index":0})" + more + "}";
}

/// An image of bytes in Base64, with a texture of it.
std::string picture(const std::string &base64, const std::string &sampler = "") {
    return R"("images":[{"uri":"data:image/png;base64,)" + base64 +
           R"("}],"textures":[{"source":0)" + sampler + "}],";
}

// The first bytes of PNGs: RGBA, RGB, and palette with a chunk tRNS; then a JPEG and a WebP.
const std::string kRgba = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAAElFTkSuQmCC";
const std::string kRgb = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAAElFTkSuQmCC";
const std::string kTrns = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAMAAAAAAAAAAAAAAnRSTlMAgAAAAAA=";
const std::string kJpeg = "/9j/4AAQSkZJRgABAQ==";
const std::string kWebp = "UklGRiQAAABXRUJQVlA4IBgAAAA=";

TEST(GltfAlpha, OfAPngBecomesOpacity) {
    for (const std::string &bytes : {kRgba, kTrns}) {
        const MeshFile file = read_square(
            with_picture("MASK", R"(,"baseColorFactor":[1,1,1,0.75])") + R"(,"alphaCutoff":0.3)",
            picture(bytes));
        ASSERT_EQ(file.opacities.size(), 1u);
        const FileOpacity &opacity = file.opacities[0];
        EXPECT_EQ(opacity.panels, std::vector<std::string>{"square"});
        EXPECT_EQ(opacity.material, "silk");
        EXPECT_EQ(opacity.factor, 0.75);
        EXPECT_EQ(opacity.cutoff, 0.3);
        EXPECT_TRUE(opacity.picture.starts_with("\x89PNG"));
        EXPECT_FALSE(opacity.mirrored_repeat);
        ASSERT_EQ(file.findings.size(), 1u);
        EXPECT_EQ(file.findings[0].key, "alpha_opacity");
        EXPECT_EQ(file.findings[0].severity, Severity::note);
        EXPECT_EQ(file.findings[0].what,
                  "material 'silk' of panel 'square' has the alphaMode MASK");
    }
    EXPECT_FALSE(
        read_square(with_picture("BLEND"), picture(kRgba)).opacities.at(0).cutoff.has_value());
}

TEST(GltfAlpha, IsRepeatedAsTheSamplerSays) {
    constexpr int kRepeat = 10497, kMirror = 33648, kClamp = 33071;
    const std::string edge = ", where the file has its edge", beyond = " beyond the picture";
    struct Case {
        float u, v; // the UVs go from 0 to here
        int wrap_s, wrap_t;
        bool mirrored;
        std::string remark;
    };
    for (const Case &c : {
             Case{1, 1, kMirror, kMirror, true, ""},
             Case{2, 2, kMirror, kMirror, true, ""},
             Case{2, 2, kRepeat, kRepeat, false, ""},
             Case{1, 1, kClamp, kClamp, false, ""},
             // Where the UVs do not leave the picture, it does not matter
             Case{2, 1, kRepeat, kMirror, false, ""},
             Case{1, 2, kRepeat, kMirror, true, ""},
             Case{1, 2, kClamp, kRepeat, false, ""},
             Case{2, 2, kRepeat, kMirror, false,
                  ", repeated along v beyond the picture, where the file mirrors it"},
             Case{2, 2, kMirror, kRepeat, true,
                  ", mirrored along v beyond the picture, where the file repeats it"},
             Case{2, 2, kRepeat, kClamp, false, ", repeated along v" + beyond + edge},
             Case{2, 2, kClamp, kMirror, true, ", mirrored along u" + beyond + edge},
             Case{1, 2, kRepeat, kClamp, false, ", repeated along v" + beyond + edge},
             Case{2, 2, kClamp, kClamp, false,
                  ", repeated along u" + beyond + edge + " and repeated along v" + beyond + edge},
         }) {
        const std::string members = R"("samplers":[{"wrapS":)" + std::to_string(c.wrap_s) +
                                    R"(,"wrapT":)" + std::to_string(c.wrap_t) + "}]," +
                                    picture(kRgba, R"(,"sampler":0)");
        std::string buffer = square_buffer();
        buffer.replace(48, 32, bytes_of<float>({0, c.v, c.u, c.v, c.u, 0, 0, 0}));
        const MeshFile file =
            parse_gltf(glb(square_with(members, "", with_picture("BLEND")), buffer), "m.glb");
        const std::string place = std::to_string(c.wrap_s) + " " + std::to_string(c.wrap_t) + " " +
                                  std::to_string(c.u) + " " + std::to_string(c.v);
        EXPECT_EQ(file.opacities.at(0).mirrored_repeat, c.mirrored) << place;
        EXPECT_EQ(file.findings.at(0).action,
                  "its alpha becomes the opacity of these panels" + c.remark)
            << place;
    }
}

TEST(GltfAlpha, IsNothingWhereItIsOneEverywhere) {
    EXPECT_TRUE(read_square(with_picture("OPAQUE"), picture(kRgba)).opacities.empty());
    for (const std::string &bytes : {kRgb, kJpeg}) {
        const MeshFile file = read_square(with_picture("BLEND"), picture(bytes));
        EXPECT_TRUE(file.opacities.empty() && file.findings.empty());
    }
    EXPECT_TRUE(read_square(R"(,"alphaMode":"BLEND")").findings.empty());
    // ... but for the factor
    const MeshFile thin = read_square(
        R"(,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]})");
    EXPECT_EQ(thin.opacities.at(0).factor, 0.5);
    EXPECT_EQ(thin.opacities.at(0).picture, "");
}

TEST(GltfAlpha, WhatIsNotReadSaysWhy) {
    for (const auto &[members, why] :
         {std::pair(std::string(), "no texture of the file"),
          std::pair(picture(kWebp), "neither PNG nor JPEG"),
          std::pair(std::string(R"("images":[{"uri":"lace.png"}],"textures":[{"source":0}],)"),
                    "no picture 'lace.png' beside the file"),
          std::pair(
              std::string(R"("images":[{"uri":"../../etc/passwd"}],"textures":[{"source":0}],)"),
              "no picture"),
          std::pair(
              std::string(R"("textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],)"),
              "an extension")}) {
        const MeshFile file = read_square(with_picture("BLEND"), members);
        EXPECT_TRUE(file.opacities.empty()) << why;
        ASSERT_EQ(file.findings.size(), 1u) << why;
        EXPECT_EQ(file.findings[0].key, "alpha_not_shown");
        EXPECT_EQ(file.findings[0].severity, Severity::warning);
        EXPECT_NE(file.findings[0].action.find(why), std::string::npos) << file.findings[0].action;
        EXPECT_THROW(load(file, {.strict = true}, "m.glb"), Error);
    }
}

} // namespace
} // namespace tsuya::garment
