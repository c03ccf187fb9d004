#pragma once
// The files of a TableCache.

#include <cstdint>
#include <string>
#include <utility>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya {

// \param key of the specular part: names its file
// \return whether there was a whole file of this build
bool read_tables(const TableCache &cache, const std::pair<std::uint64_t, std::uint64_t> &key,
                 ModelTables &tables);

// Replaces the file of these tables, and removes files that are too much.
// \param problem gets the reason where that was not possible
void write_tables(const TableCache &cache, const std::pair<std::uint64_t, std::uint64_t> &key,
                  const ModelTables &tables, std::string &problem);

} // namespace tsuya
