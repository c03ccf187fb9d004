#pragma once
// The names of a try-on's results.

#include <filesystem>
#include <string>

#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

inline constexpr const char *kSheet = "sheet.png";

// What the files of a fabric's own dye are named after.
std::string own_dye_name(const TryOn &job);
// \param number of the frame, `-0000`, or empty
std::string transport_name(const std::string &dye, const std::string &number);
std::string picture_name(const std::string &dye, const std::string &lamp,
                         const std::string &number);
std::string video_name(const std::string &dye, const std::string &lamp);
// A render that an earlier run has finished; empty where the file is none, or not of this key.
SpectralImage finished(const std::filesystem::path &exr, const std::string &key);

} // namespace tsuya::scene
