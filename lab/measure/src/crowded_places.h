#pragma once
/// \file
/// Places of marks that lie too close to be told apart.

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab {

/// Numbers of places.
struct Crowds {
    std::vector<std::vector<std::size_t>> crowds{};
    std::vector<std::size_t> alone{}; ///< those in no crowd
};

/// A crowd: places of which two are nearer than `overlap`, with all that are joined to them by
/// steps shorter than `step`.
Crowds sort_out_crowds(const std::vector<glm::dvec2> &places, double overlap, double step);

} // namespace tsuya::lab
