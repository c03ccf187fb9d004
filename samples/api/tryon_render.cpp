// The sample dress, dyed twice and lit by three lamps: tryon_render FOLDER [WIDTH HEIGHT SAMPLES]

#include <cstdio>
#include <cstdlib>

#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/error.h"

namespace {

// [doc:tryon]
int try_on(const std::filesystem::path &folder, int width, int height, int samples) {
    using namespace tsuya;
    scene::TryOn job = scene::sample_try_on(scene::data_folder());
    job.dyes = {"white", "indigo"};
    job.lamps = {"D65", "HP4", "A"};
    job.width = width;
    job.height = height;
    job.render.stop.samples_per_pixel = samples;
    job.output = folder;
    try {
        for (const std::filesystem::path &file : scene::run(job).files)
            std::printf("%s\n", file.c_str());
        return 0;
    } catch (const Error &error) { // what is wrong, where, and what would be accepted
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
// [/doc:tryon]

} // namespace

int main(int argc, char **argv) {
    if (argc != 2 && argc != 5) {
        std::fprintf(stderr, "usage: tryon_render FOLDER [WIDTH HEIGHT SAMPLES]\n");
        return 2;
    }
    const auto number = [&](int i, int otherwise) {
        return argc == 5 ? std::atoi(argv[i]) : otherwise;
    };
    return try_on(argv[1], number(2, 400), number(3, 500), number(4, 16));
}
