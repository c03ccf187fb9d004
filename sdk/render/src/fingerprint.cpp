#include "film.h"
#include "tsuya/sdk/detail/scene_fields.h"

namespace tsuya {

detail::Fingerprint fingerprint(const Scene &scene, const RenderSettings &settings) {
    detail::FieldHasher of_scene, of_settings;
    of_scene.add(scene);
    of_settings.add(settings);
    return {.input = of_scene.result(), .settings = of_settings.result()};
}

} // namespace tsuya
