#pragma once
/// \file
/// A camera's picture through OpenImageIO, with its errors translated.

#include <filesystem>
#include <memory>
#include <string>

#include "tsuya/color/camera_frame.h"

namespace tsuya {

/// A camera's picture that is open.
class FrameInput {
  public:
    /// Throws Error at `path`.
    explicit FrameInput(std::filesystem::path path);
    ~FrameInput();

    /// Why the numbers are not in proportion to light; empty where they are.
    std::string not_linear() const;
    /// All but image and area; `cfa` from the picture's corner.
    CameraFrame description() const;
    /// The numbers of an area within the picture: whole ones as they are stored. Throws Error.
    Image read(const PixelArea &area);

  private:
    struct State;
    std::filesystem::path path_;
    std::unique_ptr<State> state_;
};

} // namespace tsuya
