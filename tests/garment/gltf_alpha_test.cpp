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
    const MeshFile mirrored =
        read_square(with_picture("BLEND"), R"("samplers":[{"wrapS":33648,"wrapT":33648}],)" +
                                               picture(kRgba, R"(,"sampler":0)"));
    EXPECT_TRUE(mirrored.opacities.at(0).mirrored_repeat);
    EXPECT_FALSE(mirrored.opacities.at(0).cutoff);
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
