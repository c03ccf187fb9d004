#include "tryon_page.h"

#include <algorithm>

#include "tsuya/color/dye.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
namespace {

// With the lamps of the lights' own in the place of `own`, each once.
std::vector<NamedLamp> page_lamps(const SpectralImage &image, const std::vector<NamedLamp> &lamps) {
    std::vector<NamedLamp> all;
    const auto add = [&](const NamedLamp &lamp) {
        if (std::none_of(all.begin(), all.end(),
                         [&](const NamedLamp &known) { return known.name == lamp.name; }))
            all.push_back(lamp);
    };
    for (const NamedLamp &lamp : lamps)
        if (lamp.name == kOwnLamps)
            for (const NamedLamp &own : own_lamps(image))
                add(own);
        else
            add(lamp);
    return all;
}

} // namespace

void write_try_on_page(const std::vector<PageDress> &dresses, const std::vector<NamedLamp> &lamps,
                       const TryOn &job, TryOnResult &result) {
    PageOptions options{.title = job.garment.stem().string(),
                        .lamps = page_lamps(dresses.front().image, lamps),
                        .look = job.look};
    for (const std::string &spec : job.dyes)
        options.dyes.push_back({label_of(spec), parse_dye(spec)});
    LivePage page = live_page(dresses, options);
    result.files.push_back(job.output / kTryOnPage);
    write_file(result.files.back(), page.html);
    result.page_errors = std::move(page.errors);
}

} // namespace tsuya::scene
