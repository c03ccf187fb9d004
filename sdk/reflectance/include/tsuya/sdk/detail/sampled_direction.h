#pragma once
/// \file
/// What sampling a BRDF gives.

#include <glm/glm.hpp>

namespace tsuya {

/// A sampled direction in the cloth's frame.
struct SampledDirection {
    glm::vec3 direction{0, 0, 1}; ///< unit, z > 0
    float weight = 0;             ///< f times the cosine of the sampled direction over pdf
    float pdf_per_sr = 0;
    float weft = 0; ///< part of the weight, as of WeighedLight
};

/// The value of a BRDF with the density of sampling that light.
struct WeighedLight {
    float f_cos = 0; ///< f times the light's cosine, 1/sr
    float pdf_per_sr = 0;
    /// Part of f_cos that yarns along the weft reflect; 0 of models that do not tell them apart.
    float weft = 0;
};

} // namespace tsuya
