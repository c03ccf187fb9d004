#pragma once
/// \file
/// How much of a mesh file is read or written at once.

#include <cstddef>

namespace tsuya::garment {

inline constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

} // namespace tsuya::garment
