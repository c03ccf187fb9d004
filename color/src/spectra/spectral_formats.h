#pragma once
/// \file
/// Readers of the formats of instruments. Each takes the bytes of a file and its name, for errors.

#include <string>
#include <string_view>

#include "tsuya/color/spectrum_file.h"

namespace tsuya {

/// Spectral power or reflectance in XML. [TM27]
SpectrumFile parse_tm27(std::string_view bytes, const std::string &name);

/// Colour Exchange Format 3: all objects with a spectrum. [CxF3]
SpectrumFile parse_cxf(std::string_view bytes, const std::string &name);

/// Tables with columns for wavelengths, also Argyll's `.ti3` and `.sp`, by Little CMS. [CGATS17]
SpectrumFile parse_cgats(std::string_view bytes, const std::string &name);

/// Standards and batches of Datacolor. [QTX]
SpectrumFile parse_qtx(std::string_view bytes, const std::string &name);

/// Standards of X-Rite's Ink Master. [MIF]
SpectrumFile parse_mif(std::string_view bytes, const std::string &name);

} // namespace tsuya
