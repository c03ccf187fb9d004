#pragma once
/// \file
/// The lamps that light groups have of themselves: the tungsten of a home, the colours of an
/// environment. A picture of light transport keeps their names, and any other lamp still serves.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

/// In the place of a lamp: each group under the lamp of its own.
inline constexpr const char *kOwnLamps = "own";

/// Notes the lamps of the groups, in their order: what parse_lamp takes, one of
/// kEnvironmentLampNames, or nothing.
void note_own_lamps(SpectralImage &image, std::span<const std::string> lamps);

/// The lamp of each group of its own. Throws Error at `lamp` where a group has none.
std::vector<NamedLamp> own_lamps(const SpectralImage &image);

/// What lights a picture: the lamps as picture_under takes them, with `own` replaced by the groups'
/// own. Throws Error as own_lamps.
Lighting lighting_of_picture(const SpectralImage &image, std::span<const NamedLamp> lamps);

/// The lamps with those of the groups' own in the place of `own`, each name once: a page lights by
/// spectra. Throws Error as own_lamps.
std::vector<NamedLamp> page_lamps(const SpectralImage &image, const std::vector<NamedLamp> &lamps);
/// Writes a spectral EXR whose picture for other programs is under the lamps of the groups' own
/// where all have one, else under D65. Throws Error as write_spectral_exr.
void write_transport(const std::filesystem::path &path, const SpectralImage &image,
                     SampleType samples = SampleType::half);

/// As parse_lamps, where `own` is one of them as well: a lamp of that name, without a spectrum, as
/// picture_under takes it.
std::vector<NamedLamp> parse_picture_lamps(std::span<const std::string> specs,
                                           const std::filesystem::path &folder = {},
                                           const std::string &sample = {});

/// Throws Error for names that parse_picture_lamps refuses whatever files there are.
void check_picture_lamps(std::span<const std::string> specs);

/// As parse_group_lamps, where `own` is a lamp as well: `own`, the lamp of its own for every group
/// that is not named, or `GROUP=own`. \param sample see parse_lamps
std::vector<NamedLamp> parse_group_or_own_lamps(std::span<const std::string> specs,
                                                const SpectralImage &image,
                                                const std::string &sample = {});

/// Throws Error for specs that parse_group_or_own_lamps refuses whatever the groups and files.
void check_group_or_own_lamps(std::span<const std::string> specs);

} // namespace tsuya::scene
