#pragma once
// The scene that the render benchmarks share: the sample dress, small.

#include "tsuya/color/dye.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/render.h"

namespace tsuya::bench {

inline Scene sample_scene(int level, int width, int height) {
    scene::TryOn job = scene::sample_try_on(scene::data_folder());
    job.level = level;
    job.width = width;
    job.height = height;
    Scene made = scene::make_try_on_scene(job).scene;
    made.fabrics[0].colours.dye = dye("crimson");
    return made;
}

} // namespace tsuya::bench
