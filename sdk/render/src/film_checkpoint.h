#pragma once
// The file that keeps a film between runs.

#include <cstdint>
#include <filesystem>

#include "film.h"

namespace tsuya {

// Replaces the file. Throws Error naming it; an older checkpoint stays whole then.
void save_checkpoint(const Film &film, std::uint64_t fingerprint,
                     const std::filesystem::path &file);

// Throws Error naming the file: not a checkpoint, cut off, or of another scene.
void load_checkpoint(Film &film, std::uint64_t fingerprint, const std::filesystem::path &file);

} // namespace tsuya
