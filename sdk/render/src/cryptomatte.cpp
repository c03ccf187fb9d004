#include "cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cinttypes>
#include <cstdio>

namespace tsuya {
namespace {

std::uint32_t byte_at(std::string_view text, std::size_t i) {
    return static_cast<unsigned char>(text[i]);
}

std::string hex_text(std::uint32_t bits) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08" PRIx32, bits);
    return digits.data();
}

// As JSON has it in quotes; names are UTF-8.
std::string json_string(std::string_view name) {
    std::string text = "\"";
    for (const char c : name) {
        if (c == '"' || c == '\\') {
            text += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20) {
            std::array<char, 7> code{};
            std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(c));
            text += code.data();
        } else {
            text += c;
        }
    }
    return text + "\"";
}

} // namespace

std::uint32_t murmur_hash(std::string_view text) {
    constexpr std::uint32_t kFirst = 0xcc9e2d51, kSecond = 0x1b873593;
    const auto mixed = [](std::uint32_t k) { return std::rotl(k * kFirst, 15) * kSecond; };
    std::uint32_t hash = 0;
    const std::size_t blocks = text.size() / 4;
    for (std::size_t b = 0; b < blocks; ++b) {
        std::uint32_t k = 0;
        for (std::size_t i = 0; i < 4; ++i)
            k |= byte_at(text, 4 * b + i) << (8 * i);
        hash = std::rotl(hash ^ mixed(k), 13) * 5 + 0xe6546b64;
    }
    std::uint32_t rest = 0;
    for (std::size_t i = 4 * blocks; i < text.size(); ++i)
        rest |= byte_at(text, i) << (8 * (i % 4));
    hash ^= mixed(rest);
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ (hash >> 16)) * 0x85ebca6b;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35;
    return hash ^ (hash >> 16);
}

std::uint32_t id_bits(std::string_view name) {
    constexpr std::uint32_t kExponent = 0xffu << 23;
    const std::uint32_t bits = murmur_hash(name);
    const std::uint32_t exponent = std::clamp(bits & kExponent, 1u << 23, 254u << 23);
    return (bits & ~kExponent) | exponent;
}

std::vector<std::string> id_channels(const std::string &layer) {
    std::vector<std::string> names;
    for (std::size_t rank = 0; rank < kIdRanks; ++rank) {
        const std::string level = layer + "0" + std::to_string(rank / 2);
        names.push_back(level + (rank % 2 == 0 ? ".R" : ".B"));
        names.push_back(level + (rank % 2 == 0 ? ".G" : ".A"));
    }
    return names;
}

void count_id(float *ranks, std::uint32_t index) {
    const auto number = static_cast<float>(index + 1);
    for (std::size_t r = 0; r < kIdRanks; ++r, ranks += 2)
        if (ranks[0] == number || ranks[1] == 0) {
            ranks[0] = number;
            ranks[1] += 1;
            return;
        }
}

void finish_ids(float *ranks, const std::vector<std::string> &names, float per_sample) {
    struct Rank {
        std::uint32_t bits;
        float coverage;
    };
    std::vector<Rank> found;
    for (std::size_t r = 0; r < kIdRanks && ranks[2 * r + 1] > 0; ++r) {
        const std::uint32_t bits = id_bits(names[static_cast<std::size_t>(ranks[2 * r]) - 1]);
        const float coverage = ranks[2 * r + 1] * per_sample;
        const auto same = std::find_if(found.begin(), found.end(),
                                       [&](const Rank &rank) { return rank.bits == bits; });
        if (same == found.end())
            found.push_back({bits, coverage});
        else
            same->coverage += coverage;
    }
    std::sort(found.begin(), found.end(), [](const Rank &a, const Rank &b) {
        return a.coverage != b.coverage ? a.coverage > b.coverage : a.bits < b.bits;
    });
    std::fill_n(ranks, 2 * kIdRanks, 0.0f);
    for (const Rank &rank : found) {
        *ranks++ = std::bit_cast<float>(rank.bits);
        *ranks++ = rank.coverage;
    }
}

std::map<std::string, std::string> id_metadata(const std::string &layer,
                                               const std::vector<std::string> &names) {
    std::map<std::string, std::string> hashes;
    for (const std::string &name : names)
        hashes[name] = hex_text(id_bits(name));
    std::string manifest;
    for (const auto &[name, hash] : hashes)
        manifest += (manifest.empty() ? "" : ",") + json_string(name) + ":\"" + hash + "\"";
    const std::string key = "cryptomatte/" + hex_text(id_bits(layer)).substr(0, 7) + "/";
    return {{key + "name", layer},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", "{" + manifest + "}"}};
}

} // namespace tsuya
