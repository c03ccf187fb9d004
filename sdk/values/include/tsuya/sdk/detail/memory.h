#pragma once
/// \file
/// Whether the machine has the memory for a piece of work, asked before any of it is taken.

#include <cstdint>
#include <filesystem>
#include <string>

namespace tsuya::detail {

/// Bytes that this process can still take: the least of the machine's available memory with its
/// free swap, what its control groups leave it (their file caches count as free), and RLIMIT_AS.
/// The largest number where the system reports none of them.
/// \param root of the file system: proc and sys/fs/cgroup are read below it
std::uint64_t available_memory(const std::filesystem::path &root = "/");

/// The most bytes of memory that this process has had at once.
std::uint64_t peak_memory();

/// Such as "512 bytes", "1.50 MB", "34.4 GB".
std::string byte_text(std::uint64_t bytes);

/// Throws Error at `where` if fewer bytes than these are available: how many `what` needs, how many
/// are available.
/// \param what a plural, such as "32768 x 32768 pixels"
/// \param fits what would be accepted, such as "expected at most 8000 x 8000 pixels"
void need_memory(std::uint64_t bytes, const std::string &what, const std::string &where,
                 const std::string &fits);

} // namespace tsuya::detail
