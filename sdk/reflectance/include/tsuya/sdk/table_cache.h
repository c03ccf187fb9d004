#pragma once
/// \file
/// Tables of models that are kept on disk, so that the next program need not make them again.
///
///     KeptMaterials kept({.folder = user_cache_folder()});

#include <cstdint>
#include <filesystem>

namespace tsuya {

/// A folder of files, one for each specular part, and how large it may become. Several programs may
/// use it at once. A file is read by the build that wrote it, on processors with the same vector
/// instructions: then the tables are those that would be made, to the last bit. Any other file, and
/// a damaged one, is replaced.
struct TableCache {
    std::filesystem::path folder{}; ///< made where it is missing; empty: nothing is kept on disk
    /// Of all files. Those that were not used for the longest time are removed.
    std::uint64_t most_bytes = std::uint64_t{256} << 20;
};

/// `$XDG_CACHE_HOME/tsuya`, else `$HOME/.cache/tsuya`; empty where neither is an absolute path.
std::filesystem::path user_cache_folder();

} // namespace tsuya
