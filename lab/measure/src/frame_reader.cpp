#include "tsuya/lab/frame_reader.h"

#include <numeric>

#include "frame_patches.h"

namespace tsuya::lab {

FrameFacts read_frame_facts(const std::filesystem::path &file, const RigCamera &camera,
                            double theta_r) {
    FrameSettings settings;
    if (!camera.response.empty())
        settings.response = read_response_csv(camera.response);
    const CameraFrame frame = read_frame(file, settings);
    const PatchGrid grid = grid_of(file, frame.width, frame.height, camera, theta_r);
    const int margin = (grid.across / 2) * grid.side;
    double sum = 0;
    for (int y = 0; y < grid.side; ++y) {
        const float *const row = frame.image.pixel(grid.area.x + margin, grid.area.y + margin + y);
        sum = std::accumulate(
            row, row + static_cast<std::size_t>(grid.side) * frame.image.channels.size(), sum);
    }
    const double count = double(grid.side) * grid.side * double(frame.image.channels.size());
    return {.exposure_s = frame.exposure_s, .patch_mean = sum / count - camera.black};
}

} // namespace tsuya::lab
