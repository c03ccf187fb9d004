#pragma once
/// \file
/// Measured lamps and dyes, judged before they are used: what is odd is mended and told, what
/// cannot be right is refused.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// A spectrum that was judged.
struct MeasuredSpectrum {
    Spectrum spectrum{};
    /// What was mended or looks odd, a sentence each, which names the file.
    std::vector<std::string> warnings{};
};

/// The relative power of a lamp in a file, see read_spectrum_file. It has to be known from 400 to
/// 700 nm (within 10 nm), where it is constant beyond its ends as [CIE015] section 7.2.2.1 advises,
/// or to fall to 1 % of its highest value, behind which it is 0: a line needs no more than its own
/// samples. Values below 0 by up to 1 % of the highest are dark noise and count as 0, with a
/// warning; steps above 20 nm are a warning. Throws Error as read_spectrum_file and find_sample,
/// and for one row, wavelengths in another unit (which it names), a part of the visible range that
/// is missing, values below that or above 1e30, a lamp without visible power, and a file that says
/// that it holds a reflectance.
MeasuredSpectrum read_lamp_file(const std::filesystem::path &path, const std::string &sample = {});

/// The reflectance of a cloth in a file, 0..1. It has to be known from 400 to 700 nm (within 10 nm)
/// and is constant beyond. Percent, where the file or a value above 1.5 says so, are divided by
/// 100; the latter is a warning. Values outside [0, 1] by up to 0.01 below and 0.05 above are noise
/// and limited, with a warning. Throws Error as read_lamp_file and for other values.
MeasuredSpectrum read_dye_file(const std::filesystem::path &path, const std::string &sample = {});

} // namespace tsuya
