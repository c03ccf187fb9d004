#include "models/facets.h"

#include "tsuya/sdk/error.h"

namespace tsuya {

float checked_f0(double f0, const std::string &where) {
    if (!(f0 > 0 && f0 <= 1))
        throw Error({"f0 is " + std::to_string(f0), where,
                     "expected a reflectance above 0 and not above 1"});
    return static_cast<float>(f0);
}

float scaled_bard(const Bard &bard, float f0, const glm::vec3 &basic) {
    const float half_cosine = std::sqrt(0.5f * (1 + basic.z));
    return static_cast<float>(bard.at(basic)) * std::max(basic.z, 0.5f) / fresnel(f0, half_cosine);
}

DiskTable scaled_bard(const Bard &bard, float f0, int nodes, const Progress &progress) {
    return {nodes, bard.symmetry() == Symmetry::orthotropic, [&](const glm::vec3 &basic) {
                stop_if_asked(progress);
                return scaled_bard(bard, f0, basic);
            }};
}

} // namespace tsuya
