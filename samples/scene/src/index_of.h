#pragma once
// Positions in the vectors of a scene as its typed indices.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tsuya/sdk/scene_index.h"

namespace tsuya::scene {

template <class Tag> Index<Tag> index_of(std::size_t value) {
    return {static_cast<std::uint32_t>(value)};
}

template <class Tag> std::optional<Index<Tag>> index_of(const std::optional<std::size_t> &value) {
    return value ? std::optional(index_of<Tag>(*value)) : std::nullopt;
}

} // namespace tsuya::scene
