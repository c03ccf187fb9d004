#pragma once
/// \file
/// Artwork for prints on cloth: picture files, and colours as reflectances.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/spectrum.h"
#include "tsuya/sdk/texture.h"

namespace tsuya {

/// Reads any picture that OpenImageIO reads as artwork in colour: R, G, B encoded as sRGB, with how
/// much they cover where the file has alpha; grey files as three equal channels. Float files are
/// linear, and encoded here. Throws Error at the path, also for a float that is not a number.
Texture read_artwork(const std::filesystem::path &path);

/// Reads a picture as how much of the cloth is covered: its alpha if it has one, else its grey (the
/// mean of R, G and B), 0 none and 255 all. Floats are taken as they are: 0.5 is half. Throws as
/// read_artwork.
Texture read_coverage(const std::filesystem::path &path);

/// The same of a PNG in memory. \param name stands for it in errors
Texture decode_coverage(std::string_view bytes, const std::string &name);

/// Reflectances of the corners of the cube of linear Rec. 709 RGB, as PrintLayer::inks has them: of
/// each, reflectance_of_srgb. What is interpolated between them has the colour that is
/// interpolated, under D65 for the 2-degree observer.
std::vector<Spectrum> rgb_inks();

} // namespace tsuya
