#include "tsuya/color/compare.h"

#include <algorithm>
#include <cmath>

#include "lab_picture.h"
#include "rows.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

void check(std::span<const Lighting> lamps) {
    if (lamps.size() < 2)
        throw Error({detail::counted(lamps.size(), "lamp") + " to compare", "lamps",
                     "expected at least two"});
    for (std::size_t i = 0; i < lamps.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (lamps[i].name == lamps[j].name)
                throw Error({"the lamp '" + lamps[i].name + "' is named twice",
                             "lamps." + std::to_string(i), "expected each lamp once"});
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

std::vector<glm::vec3> lab_picture(const SpectralImage &transport, const Lighting &lighting,
                                   const CompareOptions &options, std::vector<char> &counts) {
    Image xyz = relight(transport, lighting, options.observer);
    if (transport.alpha)
        divide_by_alpha(xyz, *transport.alpha);
    const glm::dvec3 to = srgb_white();
    const glm::dmat3 adapt =
        std::exp2(options.exposure_stops) *
        adaptation_matrix(options.adapt, adopted_white(transport, lighting, options.observer), to);
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

std::vector<LampDifference> compare_lightings(const SpectralImage &transport,
                                              std::span<const Lighting> lightings,
                                              const CompareOptions &options) {
    check(lightings);
    std::vector<char> counts = garment_pixels(transport);
    std::vector<std::vector<glm::vec3>> labs;
    for (const Lighting &lighting : lightings)
        labs.push_back(lab_picture(transport, lighting, options, counts));
    std::vector<LampDifference> differences;
    for (std::size_t i = 0; i < lightings.size(); ++i)
        for (std::size_t j = i + 1; j < lightings.size(); ++j) {
            differences.push_back(difference(labs[i], labs[j], counts));
            differences.back().first = lightings[i].name;
            differences.back().second = lightings[j].name;
        }
    return differences;
}

std::vector<LampDifference> compare_lamps(const SpectralImage &transport,
                                          std::span<const NamedLamp> lamps,
                                          const CompareOptions &options) {
    std::vector<Lighting> lightings;
    for (const NamedLamp &lamp : lamps)
        lightings.push_back(lighting_of(lamp));
    return compare_lightings(transport, lightings, options);
}

} // namespace tsuya
