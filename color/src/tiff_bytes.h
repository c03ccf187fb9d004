#pragma once
/// \file
/// Camera frames as TIFF and DNG: little-endian, one picture, uncompressed, in strips of 16 rows.

#include <string>

#include "tsuya/color/camera_frame.h"

namespace tsuya {

/// A TIFF file with the frame's numbers as samples of 16 bits, and its exposure, f-number, ISO and
/// time. With `cfa`, it is a DNG: a sensor behind filters, one channel. OpenImageIO needs to read
/// back what it writes of a TIFF, which the writer of whole files cannot give it.
std::string tiff_bytes(const CameraFrame &frame);

} // namespace tsuya
