#include "fabric/table_files.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

#include "tsuya/sdk/detail/build_identity.h"
#include "tsuya/sdk/detail/hasher.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

namespace fs = std::filesystem;

using Key = std::pair<std::uint64_t, std::uint64_t>;

constexpr const char *kExtension = ".tables";

// The first line of a file.
const std::string &kind_of_file() {
    static const std::string kind = [] {
        const std::string build = detail::build_identity();
        return build.empty() ? build : "tsuya-tables " + build + "\n";
    }();
    return kind;
}

std::uint64_t checksum(std::string_view bytes) {
    detail::Hasher hasher;
    hasher.bytes(bytes.data(), bytes.size());
    return hasher.result();
}

// Builds have files of their own.
fs::path file_of(const TableCache &cache, const Key &key) {
    detail::Hasher hasher;
    hasher.text(kind_of_file());
    hasher.value(key.first);
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64, hasher.result());
    return cache.folder / (std::string(digits.data()) + kExtension);
}

bool is_off(const TableCache &cache) { return cache.folder.empty() || kind_of_file().empty(); }

template <class Core> const Core &core_of(const Model<Core> &model) { return model; }

struct PartsWriter {
    detail::TableWriter &to;

    void operator()(const std::shared_ptr<const Brdf> &brdf) const {
        to(brdf != nullptr);
        if (brdf)
            brdf->visit([&](const auto &model) {
                to(brdf->index());
                each_part(to, core_of(model));
            });
    }
    void operator()(const std::shared_ptr<const BodyBrdf> &body) const {
        to(body != nullptr);
        if (body)
            each_part(to, core_of(*body));
    }
};

// The model that has this index in Brdf::Models.
template <std::size_t I = 0> Brdf read_model(std::size_t index, detail::TableReader &from) {
    if constexpr (I < std::variant_size_v<Brdf::Models>) {
        if (index == I)
            return std::variant_alternative_t<I, Brdf::Models>(from);
        return read_model<I + 1>(index, from);
    } else {
        throw Error({"no model has the index " + std::to_string(index), "", ""});
    }
}

struct PartsReader {
    detail::TableReader &from;

    bool is_there() const {
        bool there = false;
        from(there);
        return there;
    }
    void operator()(std::shared_ptr<const Brdf> &brdf) const {
        if (!is_there())
            return;
        std::size_t index = 0;
        from(index);
        brdf = std::make_shared<const Brdf>(read_model(index, from));
    }
    void operator()(std::shared_ptr<const BodyBrdf> &body) const {
        if (is_there())
            body = std::make_shared<const BodyBrdf>(from);
    }
};

// The bytes of a regular file of this size at most; empty where it cannot be read.
std::string bytes_of(const fs::path &file, std::uint64_t most) {
    std::error_code code;
    if (!fs::is_regular_file(file, code))
        return {};
    const std::uintmax_t size = fs::file_size(file, code);
    if (code || size > most)
        return {};
    std::string bytes(size, '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
        return {};
    return bytes;
}

// What is between the head of the right file and its checksum.
std::optional<std::string_view> checked(std::string_view bytes, const Key &key) {
    std::string head = kind_of_file();
    head.append(reinterpret_cast<const char *>(&key), sizeof key);
    std::uint64_t sum = 0;
    if (bytes.size() < head.size() + sizeof sum || !bytes.starts_with(head))
        return std::nullopt;
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (sum != checksum(bytes))
        return std::nullopt;
    return bytes.substr(head.size());
}

// Removes the files that were not used for the longest time. Another program may do the same.
void bound(const TableCache &cache) {
    struct Entry {
        fs::file_time_type used;
        std::uint64_t bytes;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::error_code code;
    std::uint64_t bytes = 0;
    for (fs::directory_iterator at(cache.folder, code), end; !code && at != end;
         at.increment(code)) {
        std::error_code gone;
        if (at->path().extension() != kExtension)
            continue;
        Entry entry{at->last_write_time(gone), at->file_size(gone), at->path()};
        if (gone)
            continue;
        bytes += entry.bytes;
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry &a, const Entry &b) { return a.used < b.used; });
    for (auto oldest = entries.begin(); bytes > cache.most_bytes && oldest != entries.end();
         ++oldest) {
        fs::remove(oldest->path, code);
        bytes -= oldest->bytes;
    }
}

} // namespace

fs::path user_cache_folder() {
    const auto absolute = [](const char *name) {
        const char *const value = std::getenv(name);
        const fs::path path = value ? value : "";
        return path.is_absolute() ? path : fs::path();
    };
    if (const fs::path caches = absolute("XDG_CACHE_HOME"); !caches.empty())
        return caches / "tsuya";
    const fs::path home = absolute("HOME");
    return home.empty() ? fs::path() : home / ".cache" / "tsuya";
}

bool read_tables(const TableCache &cache, const Key &key, ModelTables &tables) {
    if (is_off(cache))
        return false;
    const fs::path file = file_of(cache, key);
    const std::string bytes = bytes_of(file, cache.most_bytes);
    const std::optional<std::string_view> parts = checked(bytes, key);
    if (!parts)
        return false;
    try {
        detail::TableReader reader(*parts);
        const PartsReader read{reader};
        ModelTables found;
        each_part(read, found);
        if (!reader.at_end())
            return false;
        tables = std::move(found);
    } catch (const Error &) { // of another layout
        return false;
    }
    std::error_code ignored; // of a folder that may not be written to
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return true;
}

void write_tables(const TableCache &cache, const Key &key, const ModelTables &tables,
                  std::string &problem) {
    if (is_off(cache))
        return;
    detail::TableWriter parts;
    each_part(PartsWriter{parts}, tables);
    std::string bytes = kind_of_file();
    bytes.append(reinterpret_cast<const char *>(&key), sizeof key);
    bytes += parts.bytes();
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char *>(&sum), sizeof sum);
    if (bytes.size() > cache.most_bytes)
        return;
    try {
        std::error_code code;
        fs::create_directories(cache.folder, code);
        write_file(file_of(cache, key), bytes);
        bound(cache);
    } catch (const Error &error) {
        problem = error.what();
    }
}

} // namespace tsuya
