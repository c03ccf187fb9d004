#include "tsuya/color/compare.h"

#include <algorithm>
#include <cmath>

#include "rows.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

void check(std::span<const NamedLamp> lamps) {
    if (lamps.size() < 2)
        throw Error({detail::counted(lamps.size(), "lamp") + " to compare", "lamps",
                     "expected at least two"});
    for (std::size_t i = 0; i < lamps.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (lamps[i].name == lamps[j].name)
                throw Error({"the lamp '" + lamps[i].name + "' is named twice",
                             "lamps." + std::to_string(i), "expected each lamp once"});
}

bool lit(const SpectralImage &image, int x, int y) {
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        for (int k = 0; k < image.basis.count; ++k)
            if (image.pixel(g, x, y)[k] != 0)
                return true;
    return false;
}

std::vector<char> pixels_that_count(const SpectralImage &image) {
    const Image *const coverage = garment_coverage(image);
    std::vector<char> counts;
    counts.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            counts.push_back(coverage ? *coverage->pixel(x, y) >= 0.5f : lit(image, x, y));
    return counts;
}

/// CIELAB of each pixel, adapted to sRGB's white; also takes the pixels that are not finite out.
std::vector<glm::vec3> lab_picture(const SpectralImage &transport, const NamedLamp &lamp,
                                   const CompareOptions &options, std::vector<char> &counts) {
    Image xyz = relight(transport, lamp.spectrum, {.observer = options.observer});
    if (transport.alpha)
        divide_by_alpha(xyz, *transport.alpha);
    const glm::dvec3 to = srgb_white();
    const glm::dmat3 adapt =
        lamp.factor * std::exp2(options.exposure_stops) *
        adaptation_matrix(options.adapt, white_of(lamp.spectrum, options.observer), to);
    std::vector<glm::vec3> lab(counts.size(), glm::vec3(0.0f));
    const auto width = static_cast<std::size_t>(xyz.width);
    for_rows(xyz.height, width * 3, [&](int first, int end) {
        for (std::size_t p = static_cast<std::size_t>(first) * width;
             p < static_cast<std::size_t>(end) * width; ++p) {
            const float *v = xyz.data.data() + 3 * p;
            if (!std::isfinite(v[0] + v[1] + v[2]))
                counts[p] = 0;
            if (counts[p])
                lab[p] = glm::vec3(lab_of(adapt * glm::dvec3(v[0], v[1], v[2]), to));
        }
    });
    return lab;
}

LampDifference difference(const std::vector<glm::vec3> &a, const std::vector<glm::vec3> &b,
                          const std::vector<char> &counts) {
    std::vector<double> all;
    for (std::size_t p = 0; p < counts.size(); ++p)
        if (counts[p])
            all.push_back(ciede2000(glm::dvec3(a[p]), glm::dvec3(b[p])));
    LampDifference d;
    d.pixels = all.size();
    if (all.empty())
        return d;
    for (const double v : all)
        d.mean += v;
    d.mean /= static_cast<double>(all.size());
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(all.size())));
    std::nth_element(all.begin(), all.begin() + rank - 1, all.end());
    d.p95 = all[static_cast<std::size_t>(rank - 1)];
    d.max = *std::max_element(all.begin(), all.end());
    return d;
}

} // namespace

const Image *garment_coverage(const SpectralImage &transport) {
    for (const char *name : {"garment", "coverage"})
        for (std::size_t i = 0; i < transport.aovs.size(); ++i)
            if (transport.aov_names[i] == name)
                return &transport.aovs[i];
    return transport.alpha ? &*transport.alpha : nullptr;
}

std::vector<LampDifference> compare_lamps(const SpectralImage &transport,
                                          std::span<const NamedLamp> lamps,
                                          const CompareOptions &options) {
    check(lamps);
    std::vector<char> counts = pixels_that_count(transport);
    std::vector<std::vector<glm::vec3>> labs;
    for (const NamedLamp &named : lamps)
        labs.push_back(lab_picture(transport, named, options, counts));
    std::vector<LampDifference> differences;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        for (std::size_t j = i + 1; j < lamps.size(); ++j) {
            differences.push_back(difference(labs[i], labs[j], counts));
            differences.back().first = lamps[i].name;
            differences.back().second = lamps[j].name;
        }
    return differences;
}

double metamerism_index(const Spectrum &first, const Spectrum &second, const Spectrum &reference,
                        const Spectrum &test, Observer observer) {
    const glm::dvec3 a = xyz_of(reference, first, observer),
                     b = xyz_of(reference, second, observer);
    if (!(b.x > 0 && b.y > 0 && b.z > 0))
        throw Error({"the second reflectance is black under the reference lamp", "reflectance",
                     "expected a reflectance with X, Y and Z greater than 0"});
    const glm::dvec3 matched = xyz_of(test, second, observer) * (a / b);
    const glm::dvec3 white = white_of(test, observer);
    return ciede2000(lab_of(xyz_of(test, first, observer), white), lab_of(matched, white));
}

} // namespace tsuya
