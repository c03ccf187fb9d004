#pragma once
// The file that keeps a film between runs.

#include <filesystem>

#include "film.h"

namespace tsuya {

// Replaces the file. Throws Error naming it; an older checkpoint stays whole then.
void save_checkpoint(const Film &film, const detail::Fingerprint &fingerprint,
                     const std::filesystem::path &file);

// Throws Error naming the file: not a checkpoint, damaged, of another scene or other settings.
void load_checkpoint(Film &film, const detail::Fingerprint &fingerprint,
                     const std::filesystem::path &file);

} // namespace tsuya
