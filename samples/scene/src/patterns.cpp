#include "patterns.h"

#include <map>
#include <utility>

#include "tsuya/color/print_file.h"

namespace tsuya::scene {

void add_pictures(const std::vector<PatternEntry> &patterns,
                  const std::vector<OpacityEntry> &opacities, Scene &scene) {
    std::map<std::pair<std::filesystem::path, bool>, TextureIndex> known;
    const auto texture = [&](const std::filesystem::path &picture, bool coverage) {
        const auto [at, added] = known.try_emplace(
            {picture, coverage}, TextureIndex{static_cast<std::uint32_t>(scene.textures.size())});
        if (added)
            scene.textures.push_back(coverage ? read_coverage(picture) : read_artwork(picture));
        return at->second;
    };
    for (const PatternEntry &pattern : patterns) {
        Print &print =
            scene.prints.emplace_back(Print{.name = pattern.name, .placement = pattern.placement});
        for (const auto &[picture, dye] : pattern.screens)
            print.layers.push_back({.picture = texture(picture, dye.has_value()),
                                    .inks = dye ? std::vector{*dye} : rgb_inks()});
    }
    for (const auto &[picture, placement] : opacities)
        scene.opacities.push_back({texture(picture, true), placement});
}

} // namespace tsuya::scene
