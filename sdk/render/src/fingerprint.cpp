#include <array>
#include <cinttypes>
#include <cstdio>

#include "dye_channels.h"
#include "film.h"
#include "tsuya/sdk/detail/scene_fields.h"

namespace tsuya {

detail::Fingerprint fingerprint(const Scene &scene, const RenderSettings &settings) {
    detail::FieldHasher of_scene, of_settings;
    of_scene.add(scene);
    of_settings.add(settings);
    return {.input = of_scene.result(), .settings = of_settings.result()};
}

std::map<std::string, std::string> fabric_hashes(const Scene &scene) {
    std::map<std::string, std::string> hashes;
    for (std::size_t i = 0; i < scene.fabrics.size(); ++i) {
        detail::FieldHasher of_fabric;
        of_fabric.add(scene.fabrics[i]);
        std::array<char, 17> digits{};
        std::snprintf(digits.data(), digits.size(), "%016" PRIx64, of_fabric.result());
        const std::string &name = scene.fabrics[i].name;
        hashes["hash of fabric " + (name.empty() ? std::to_string(i) : name)] = digits.data();
    }
    return hashes;
}

std::string render_key(const detail::Fingerprint &fingerprint, const StopRule &stop) {
    detail::Hasher of_stop;
    of_stop.value(stop.samples_per_pixel);
    for (const std::optional<double> &bound : {stop.relative_error, stop.seconds}) {
        of_stop.value(bound.has_value());
        of_stop.value(bound.value_or(0));
    }
    std::array<char, 49> digits{};
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64 "%016" PRIx64 "%016" PRIx64,
                  fingerprint.input, fingerprint.settings, of_stop.result());
    return digits.data();
}

std::string render_key(const Scene &scene, const RenderSettings &settings) {
    return render_key(fingerprint(scene, as_planned(scene, settings)), settings.stop);
}

} // namespace tsuya
