#include "page/judged_looks.h"

#include <algorithm>
#include <cmath>

#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"

namespace tsuya {
namespace {

constexpr const char *kLamps[] = {"D65", "A", "FL11", "HP4", "LED-B3"};
constexpr std::size_t kNamesApart = 5; // of the dyes in a pair

std::vector<Spectrum> judged_dyes() {
    std::vector<Spectrum> dyes{Spectrum::constant(1)}; // limited to the range of the picture
    for (const std::string &name : dye_names())
        dyes.push_back(dye(name));
    return dyes;
}

std::vector<DyeDepths> dyed(const DyeDepths &depths) {
    const std::vector<Spectrum> dyes = judged_dyes();
    const bool open = std::any_of(depths.dyes.begin(), depths.dyes.end(),
                                  [](const DyeVariable &dye) { return dye.open; });
    if (!open)
        return {depths};
    std::vector<DyeDepths> all;
    for (std::size_t i = 0; i < dyes.size(); ++i) {
        all.push_back(depths);
        std::size_t shown = i;
        for (DyeVariable &variable : all.back().dyes)
            if (variable.open) {
                variable.dye = dyes[shown % dyes.size()];
                shown += kNamesApart;
            }
    }
    return all;
}

bool counts(const SpectralImage &image, const Image *coverage, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(image.basis.count);
    const std::size_t size =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    float sum = 0;
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        for (std::size_t k = 0; k < channels; ++k)
            sum += image.transport[(g * size + pixel) * channels + k];
    if (!std::isfinite(sum))
        return false;
    return coverage ? coverage->data[pixel * coverage->channels.size()] >= 0.5f : sum > 0;
}

} // namespace

std::vector<JudgedLook> judged_looks(const SpectralImage &image) {
    std::vector<JudgedLook> looks;
    const std::vector<DyeDepths> depths =
        image.depths ? dyed(*image.depths) : std::vector<DyeDepths>{};
    for (const char *name : kLamps) {
        const Spectrum spectrum = lamp(name);
        const glm::dvec3 white = white_of(spectrum);
        if (!image.depths)
            looks.push_back({white, lamp_matrix(spectrum, image.basis)});
        for (const DyeDepths &one : depths)
            looks.push_back({white, lamp_matrix(spectrum, one)});
    }
    return looks;
}

std::vector<std::size_t> judged_pixels(const SpectralImage &image, std::size_t most) {
    const Image *coverage = nullptr;
    for (std::size_t i = 0; i < image.aov_names.size(); ++i)
        if (image.aov_names[i] == "coverage")
            coverage = &image.aovs[i];
    const std::size_t size =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    std::vector<std::size_t> all;
    for (std::size_t p = 0; p < size; ++p)
        if (counts(image, coverage, p))
            all.push_back(p);
    const std::size_t step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
    std::vector<std::size_t> chosen;
    for (std::size_t i = step / 2; i < all.size(); i += step)
        chosen.push_back(all[i]);
    return chosen;
}

} // namespace tsuya
