// How much the colour of the sample dress changes between lamps: illuminant_comparison SAMPLES

#include <cstdio>
#include <cstdlib>

#include "tsuya/color/compare.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/metamerism.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;

// [doc:compare]
/// One render, many lamps: transport holds no lamp.
void compare(int samples) {
    scene::TryOn job = scene::sample_try_on(scene::data_folder());
    job.width = 80;
    job.height = 100;
    Scene dress = scene::make_try_on_scene(job).scene;
    dress.fabrics[0].colours.dye = dye("crimson");
    const RenderResult result =
        scene::render_try_on(dress, {.stop = {.samples_per_pixel = samples}});

    std::vector<NamedLamp> lamps;
    for (const char *name : {"D65", "LED-B3", "HP4", "A"})
        lamps.push_back({name, lamp(name)});
    for (const LampDifference &d : compare_lamps(result.image, lamps))
        std::printf("%-7s to %-7s CIEDE2000 %.2f mean, %.2f 95th percentile\n", d.first.c_str(),
                    d.second.c_str(), d.mean, d.p95);
}
// [/doc:compare]

/// Two reds that look alike by day may part under a lamp.
void show_metamerism() {
    for (const char *name : {"HP4", "A"})
        std::printf("crimson and madder, alike under D65, differ by %.2f under %s\n",
                    metamerism_index(dye("crimson"), dye("madder"), lamp("D65"), lamp(name)), name);
}

} // namespace

int main(int argc, char **argv) {
    try {
        compare(argc > 1 ? std::atoi(argv[1]) : 16);
        show_metamerism();
        return 0;
    } catch (const Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
