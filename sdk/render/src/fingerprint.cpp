#include "film.h"
#include "tsuya/sdk/detail/scene_fields.h"

namespace tsuya {

std::uint64_t fingerprint(const Scene &scene, const RenderSettings &settings) {
    detail::FieldHasher hasher;
    hasher.add(scene);
    hasher.add(settings);
    return hasher.result();
}

} // namespace tsuya
