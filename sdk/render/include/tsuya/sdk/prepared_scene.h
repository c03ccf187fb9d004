#pragma once
/// \file
/// What a render builds before it traces, kept for the renders after it: from other sides, in other
/// dyes, with other seeds or crops, of the next frame.
///
///     PreparedScene prepared;
///     for (const Camera &camera : cameras) {
///         scene.camera = camera;
///         results.push_back(render(scene, settings, {}, &prepared));
///     }

#include <cstddef>
#include <memory>

#include "tsuya/sdk/kept_materials.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya {

/// What renders with a PreparedScene built, and what they found there.
struct PreparedUse {
    std::size_t objects_built = 0; ///< BVHs of objects
    std::size_t objects_kept = 0;  ///< those that served again
    TableUse tables{};

    /// What came after another, earlier use.
    PreparedUse since(const PreparedUse &before) const;
};

/// The BVH of each object and the tables of each cloth. A render compares them with its scene and
/// makes anew what is another: nothing needs to be told of what changed, and the picture is that of
/// a render without it, to the last bit. Used by one render at a time; scenes may come and go.
class PreparedScene {
  public:
    /// \param cache on disk for tables that are not in memory
    explicit PreparedScene(TableCache cache = {});
    ~PreparedScene();
    PreparedScene(PreparedScene &&) noexcept; ///< the other may only be assigned to afterwards
    PreparedScene &operator=(PreparedScene &&) noexcept; ///< as the move constructor

    /// Since its construction.
    PreparedUse use() const;

  private:
    friend struct TracedScene; // of the renderer
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tsuya
