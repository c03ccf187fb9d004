#include "tsuya/scene/channel_warnings.h"

#include <array>
#include <cstdio>
#include <string>

#include "tsuya/color/channel_error.h"
#include "tsuya/sdk/plan.h"

namespace tsuya::scene {
namespace {

constexpr double kMostError = 1; // CIEDE2000: what an eye that looks for it sees
constexpr std::array<int, 3> kCounts{8, 16, 32};

std::string accepted(const Spectrum &colour, int channels) {
    for (const int count : kCounts)
        if (count > channels &&
            channel_error(colour, SpectralBasis::of_renders(count)) <= kMostError)
            return "expected --channels " + std::to_string(count) + ", or a dye left open";
    return "expected a dye left open, whose channels are exact at 1 nm, or a smoother spectrum";
}

/// The colours of a fabric that are not the same at all wavelengths, each once.
std::vector<Spectrum> colours_of(const FabricColours &colours) {
    std::vector<Spectrum> found;
    for (const Spectrum &colour : {colours.dye_of_weft(), colours.dye_of_warp(),
                                   colours.transmittance, colours.weft(), colours.warp()}) {
        bool known = colour.is_constant();
        for (const Spectrum &other : found)
            known = known || other == colour;
        if (!known)
            found.push_back(colour);
    }
    return found;
}

} // namespace

std::vector<Problem> channel_warnings(const Scene &scene, const RenderSettings &settings) {
    std::vector<Problem> warnings;
    if (!scene.open_dyes.empty() && !dye_variables(scene).empty())
        return warnings;
    const SpectralBasis basis = SpectralBasis::of_renders(settings.channels);
    const auto judge = [&](const Spectrum &colour, const std::string &where) {
        const double error = channel_error(colour, basis);
        if (error <= kMostError)
            return;
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), "%.1f", error);
        warnings.push_back({std::to_string(settings.channels) +
                                " channels show a colour with an error of up to CIEDE2000 " +
                                number.data(),
                            where, accepted(colour, settings.channels)});
    };
    const std::vector<bool> used = fabrics_in_use(scene);
    for (std::size_t i = 0; i < scene.fabrics.size(); ++i)
        if (used[i])
            for (const Spectrum &colour : colours_of(scene.fabrics[i].colours))
                judge(colour, "fabrics." + scene.fabrics[i].name);
    for (std::size_t i = 0; i < scene.prints.size(); ++i)
        for (const PrintLayer &layer : scene.prints[i].layers)
            for (const Spectrum &ink : layer.inks)
                judge(ink, "prints." + std::to_string(i));
    return warnings;
}

} // namespace tsuya::scene
