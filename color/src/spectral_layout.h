#pragma once
/// \file
/// How a spectral EXR is laid out: its parts, its channels, its attributes. Channels are those of
/// [Fichet]; a part a light group lets each be a spectral picture of its own.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/spectral_image.h"

namespace tsuya::layout {

/// The layouts that tsuya has written: rises when a file of an earlier one could not be read as
/// before. In the first all channels were in one part, `key.S0.400,000nm` or `aov.normal.X`.
inline constexpr const char *kSchema = "tsuya-spectral-2", *kFirstSchema = "tsuya-spectral-1";

inline constexpr const char *kSchemaKey = "tsuya:schema", *kBasisKey = "tsuya:basis",
                            *kAlphaKey = "tsuya:alpha", *kMetaPrefix = "tsuya:meta:";
/// [Fichet] section 3: the version of the layout.
inline constexpr const char *kVersionKey = "spectralLayoutVersion", *kVersion = "1.0",
                            *kUnitsKey = "emissiveUnits";
inline constexpr const char *kAlphaChannel = "A", *kPicturePart = "rgb";

inline constexpr const char *kOurs = "expected an EXR that tsuya wrote, or a spectral EXR";

/// Keys of the attributes that name light groups, AOVs, and the channels of an AOV.
std::string group_key(std::size_t group);
std::string aov_key(std::size_t aov);
std::string aov_channel_key(std::size_t aov, std::size_t channel);
/// Whether a matte program looks for this attribute.
bool is_cryptomatte_key(const std::string &key);

/// Names of parts.
std::string part_of_group(const std::string &group);
std::string part_of_aov(const std::string &aov);

/// A basis as the attribute kBasisKey has it, and back. Throws Error at `where`.
std::string basis_text(const SpectralBasis &basis);
SpectralBasis parse_basis(const std::string &text, const std::string &where);

/// What the name of a channel says in the layout of [Fichet].
struct SpectralChannel {
    std::string layer{}; ///< before the last part of the name, without its dot
    bool emissive = false;
    double wavelength_nm = 0;
};

/// The meaning of a channel's name: [LAYER.]S0.WAVELENGTH is radiance, [LAYER.]T.WAVELENGTH a
/// reflectance or transport (M00 in later versions), where WAVELENGTH has a decimal comma, an
/// optional prefix of its unit, and m or Hz. Empty for other names, and for the other components of
/// polarised light. Throws Error at `where` for a reflectance between two wavelengths.
std::optional<SpectralChannel> parse_channel(const std::string &name, const std::string &where);

} // namespace tsuya::layout
