#pragma once
/// \file
/// A sequence of pictures as a video, by the program ffmpeg where it is installed.
///
///     write_video("out/white-D65.mp4", "out/white-D65", 24); // of out/white-D65-0000.png and on

#include <filesystem>

namespace tsuya::scene {

/// Writes an MP4 (H.264, 4:2:0, BT.709) by atomic replacement. Odd widths and heights get a black
/// line. Throws Error at `file`: ffmpeg is not on the PATH, or its message.
/// \param pictures path of the PNGs without `-0000.png`; numbered from 0, of one size
/// \param frames_per_second 1 to 240
void write_video(const std::filesystem::path &file, const std::filesystem::path &pictures,
                 int frames_per_second);

} // namespace tsuya::scene
