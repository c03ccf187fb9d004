#pragma once
/// \file
/// What models tabulate, made once for a cloth and kept: for its other dyes, for later renders, and
/// on disk for later programs.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya {

/// Where tables came from, counted by specular parts.
struct TableUse {
    std::size_t made = 0;   ///< tabulated
    std::size_t read = 0;   ///< from the cache on disk
    std::size_t shared = 0; ///< fabrics that found the tables of another or of an earlier render
    /// Why the cache could not be written; empty where it could. It costs time only.
    std::string cache_problem{};
};

/// Materials by the specular part of their fabrics. One that is given to several renders makes each
/// cloth's tables once, whatever its dyes; it is used by one render at a time.
class KeptMaterials {
  public:
    KeptMaterials() = default;
    /// \param cache on disk for what is not in memory
    explicit KeptMaterials(TableCache cache) : cache_(std::move(cache)) {}

    /// As resolve (fabric.h), with the tables of a fabric before that has the same specular part.
    /// A cache that cannot be read or written is no error, see TableUse.
    Material resolve(const Fabric &fabric, const std::string &where, const Progress &progress = {});
    /// As widened (widened_material.h) of what `resolve` gave for the fabric, with tables kept in
    /// the same way.
    std::optional<Material> widened(const Fabric &fabric, const Material &material,
                                    const Progress &progress = {});
    /// Of cloths: fabrics that differ in their colours alone are one.
    std::size_t size() const { return kept_.size(); }
    /// Forgets what is in memory: the tables of a cloth have about a megabyte.
    void clear() { kept_.clear(); }
    /// What became of the tables so far.
    const TableUse &use() const { return use_; }

  private:
    using Key = std::pair<std::uint64_t, std::uint64_t>; ///< two hashes of the specular part

    TableCache cache_{};
    std::map<Key, ModelTables> kept_{};
    TableUse use_{};
};

} // namespace tsuya
