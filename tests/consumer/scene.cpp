#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/tryon.h"

#include <cstdio>

int main() {
    tsuya::scene::TryOn job = tsuya::scene::sample_try_on(tsuya::scene::data_folder());
    job.output = "out";
    job.width = 16;
    job.height = 20;
    job.dyes = {};
    job.lamps = {"D65"};
    job.render.stop.samples_per_pixel = 1;
    const std::size_t files = tsuya::scene::run(job).files.size();
    std::printf("%zu files\n", files);
    return files == 3 ? 0 : 1; // the light, a picture and the sheet
}
