#pragma once
/// \file
/// The names behind the ids of a picture. [Cryptomatte]

#include <cstdint>
#include <map>
#include <string>

namespace tsuya {

/// Names by the bits of their ids, from the attributes `cryptomatte/<key>/name` and `/manifest`.
/// Throws Error at the layer where they are missing or are no JSON object of names and hexadecimal
/// numbers.
std::map<std::uint32_t, std::string> id_manifest(const std::map<std::string, std::string> &metadata,
                                                 const std::string &layer);

} // namespace tsuya
