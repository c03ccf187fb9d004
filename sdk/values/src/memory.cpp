#include "tsuya/sdk/detail/memory.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"

namespace tsuya::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

std::uint64_t less(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// The number behind a name, in a file of lines `name number`.
std::optional<std::uint64_t> entry(const fs::path &file, const std::string &name) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string key;
        std::uint64_t value = 0;
        if (words >> key >> value && key == name)
            return value;
    }
    return std::nullopt;
}

/// The number that is a file's first word; none where it is another word, such as "max".
std::optional<std::uint64_t> first_number(const fs::path &file) {
    std::ifstream in(file);
    std::uint64_t value = 0;
    if (in >> value)
        return value;
    return std::nullopt;
}

std::uint64_t left_by_machine(const fs::path &root) {
    const auto available = entry(root / "proc/meminfo", "MemAvailable:");
    if (!available)
        return kNoLimit;
    return 1024 * (*available + entry(root / "proc/meminfo", "SwapFree:").value_or(0));
}

/// What one control group leaves; its file cache is given up before a process of it is refused.
std::uint64_t left_by_group(const fs::path &folder, const char *limit, const char *use,
                            const char *cache) {
    const auto most = first_number(folder / limit), used = first_number(folder / use);
    if (!most || !used)
        return kNoLimit;
    return less(*most, less(*used, entry(folder / "memory.stat", cache).value_or(0)));
}

/// Of the process's groups and of all that these lie in. A line is `number:controllers:path`.
std::uint64_t left_by_groups(const fs::path &root) {
    std::uint64_t left = kNoLimit;
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool unified = controllers.empty(); // version 2
        if (!unified && ("," + controllers + ",").find(",memory,") == std::string::npos)
            continue;
        const fs::path top = root / (unified ? "sys/fs/cgroup" : "sys/fs/cgroup/memory");
        // Inside a container the path may be that of the host: what is not there has no limit
        for (fs::path group = fs::path(line.substr(second + 1)).relative_path();;
             group = group.parent_path()) {
            left = std::min(left, unified ? left_by_group(top / group, "memory.max",
                                                          "memory.current", "inactive_file")
                                          : left_by_group(top / group, "memory.limit_in_bytes",
                                                          "memory.usage_in_bytes",
                                                          "total_inactive_file"));
            if (group.empty())
                break;
        }
    }
    return left;
}

std::uint64_t left_by_address_space(const fs::path &root) {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return kNoLimit;
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return less(limit.rlim_cur, page * first_number(root / "proc/self/statm").value_or(0));
}

} // namespace

std::uint64_t available_memory(const fs::path &root) {
    return std::min({left_by_machine(root), left_by_groups(root), left_by_address_space(root)});
}

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

std::string byte_text(std::uint64_t bytes) {
    if (bytes < 1000)
        return std::to_string(bytes) + " bytes";
    constexpr std::array kUnits{"kB", "MB", "GB", "TB", "PB", "EB"};
    double value = static_cast<double>(bytes) / 1000;
    std::size_t unit = 0;
    for (; value >= 999.5 && unit + 1 < kUnits.size(); ++unit)
        value /= 1000;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f %s",
                  value < 9.995   ? 2
                  : value < 99.95 ? 1
                                  : 0,
                  value, kUnits[unit]);
    return text.data();
}

void need_memory(std::uint64_t bytes, const std::string &what, const std::string &where,
                 const std::string &fits) {
    const std::uint64_t available = available_memory();
    if (bytes > available)
        throw Error({what + " need " + byte_text(bytes) + " of memory and " + byte_text(available) +
                         " are available",
                     where, fits});
}

} // namespace tsuya::detail
