#include "tsuya/color/picture_region.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "id_manifest.h"

namespace tsuya {
namespace {

constexpr float kFilled = 0.98f, kHalf = 0.5f;

bool lit(const SpectralImage &image, int x, int y) {
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        for (int k = 0; k < image.basis.count; ++k)
            if (image.pixel(g, x, y)[k] != 0)
                return true;
    return false;
}

bool finite(const SpectralImage &image, int x, int y) {
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        for (int k = 0; k < image.basis.count; ++k)
            if (!std::isfinite(image.pixel(g, x, y)[k]))
                return false;
    return true;
}

std::vector<char> finite_pixels(const SpectralImage &image) {
    std::vector<char> good;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            good.push_back(finite(image, x, y));
    return good;
}

/// The pixels that a part covers: those that it fills, else by half.
std::vector<std::size_t> pixels_of(const std::vector<std::pair<std::size_t, float>> &covered) {
    for (const float least : {kFilled, kHalf}) {
        std::vector<std::size_t> pixels;
        for (const auto &[pixel, coverage] : covered)
            if (coverage >= least)
                pixels.push_back(pixel);
        if (!pixels.empty())
            return pixels;
    }
    return {};
}

/// The layers whose names are parts, with what those are called.
constexpr std::pair<std::string_view, std::string_view> kLayers[] = {
    {"CryptoFabric", "fabric"}, {"CryptoPanel", "panel"}, {"CryptoObject", "object"}};

void add_named(const SpectralImage &image, std::size_t aov, std::string_view kind,
               const std::vector<char> &good, std::vector<PictureRegion> &regions) {
    const std::map<std::uint32_t, std::string> names =
        id_manifest(image.metadata, image.aov_names[aov]);
    std::map<std::uint32_t, std::vector<std::pair<std::size_t, float>>> covered;
    const Image &ids = image.aovs[aov];
    const std::size_t channels = ids.channels.size();
    for (std::size_t pixel = 0; pixel < good.size(); ++pixel)
        for (std::size_t r = 0; good[pixel] && r + 1 < channels; r += 2) {
            const float *const rank = ids.data.data() + pixel * channels + r;
            if (rank[1] > 0)
                covered[std::bit_cast<std::uint32_t>(rank[0])].emplace_back(pixel, rank[1]);
        }
    std::multimap<std::string, std::vector<std::size_t>> sorted; // two parts may share a name
    for (const auto &[bits, pixels] : covered)
        if (const auto name = names.find(bits); name != names.end())
            sorted.emplace(name->second, pixels_of(pixels));
    for (auto &[name, pixels] : sorted)
        if (!pixels.empty())
            regions.push_back({std::string(kind), name, std::move(pixels)});
}

} // namespace

const Image *garment_coverage(const SpectralImage &transport) {
    for (const char *name : {"garment", "coverage"})
        for (std::size_t i = 0; i < transport.aovs.size(); ++i)
            if (transport.aov_names[i] == name)
                return &transport.aovs[i];
    return transport.alpha ? &*transport.alpha : nullptr;
}

std::vector<char> garment_pixels(const SpectralImage &image) {
    const Image *const coverage = garment_coverage(image);
    std::vector<char> counts;
    counts.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            counts.push_back(coverage ? *coverage->pixel(x, y) >= kHalf : lit(image, x, y));
    return counts;
}

std::vector<PictureRegion> picture_regions(const SpectralImage &transport) {
    const std::vector<char> good = finite_pixels(transport), garment = garment_pixels(transport);
    const Image *const coverage = garment_coverage(transport);
    std::vector<std::pair<std::size_t, float>> covered;
    for (std::size_t pixel = 0; pixel < good.size(); ++pixel)
        if (good[pixel] && garment[pixel])
            covered.emplace_back(pixel, coverage ? coverage->data[pixel] : 1.0f);
    std::vector<PictureRegion> regions;
    if (std::vector<std::size_t> pixels = pixels_of(covered); !pixels.empty())
        regions.push_back({"garment", "", std::move(pixels)});
    for (const auto &[layer, kind] : kLayers)
        for (std::size_t aov = 0; aov < transport.aovs.size(); ++aov)
            if (transport.aov_names[aov] == layer)
                add_named(transport, aov, kind, good, regions);
    return regions;
}

} // namespace tsuya
