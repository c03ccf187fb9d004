#pragma once
/// \file
/// How a session looks at a picture that has just come.

#include "tsuya/lab/frame_camera.h"

namespace tsuya::lab {

/// A FrameReader for all files that read_frame() reads. The whole picture is decoded.
FrameFacts read_frame_facts(const std::filesystem::path &file, const RigCamera &camera,
                            double theta_r);

} // namespace tsuya::lab
