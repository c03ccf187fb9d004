#pragma once
// Ids of what a picture shows as Cryptomatte has them: of each pixel the names that it shows, by
// their hashes, with how much of it each covers. [Cryptomatte]

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/image.h"

namespace tsuya {

// Names that a pixel keeps; the coverage of a further one is lost.
inline constexpr std::size_t kIdRanks = 6;

// MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur_hash(std::string_view text);
// The bits of the float that stands for a name, neither denormal nor infinite.
std::uint32_t id_bits(std::string_view name);

// CryptoObject00.R and on: id and coverage of each rank.
std::vector<std::string> id_channels(const std::string &layer);

// Counts a sample. \param ranks of a pixel: pairs of an index plus 1 and a number of samples
void count_id(float *ranks, std::uint32_t index);

// From counts of indices to ids and coverage, the largest first.
// \param names of the indices; those that are alike become one
void finish_ids(float *ranks, const std::vector<std::string> &names, float per_sample);

// The attributes of a picture that has the layer.
std::map<std::string, std::string> id_metadata(const std::string &layer,
                                               const std::vector<std::string> &names);

} // namespace tsuya
