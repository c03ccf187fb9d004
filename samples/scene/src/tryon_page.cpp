#include "tryon_page.h"

#include "tsuya/color/dye.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
void write_try_on_page(const std::vector<PageDress> &dresses, const std::vector<NamedLamp> &lamps,
                       const TryOn &job, TryOnResult &result) {
    PageOptions options{.title = job.garment.stem().string(),
                        .lamps = page_lamps(dresses.front().image, lamps),
                        .look = page_look(job.look)};
    for (const std::string &spec : job.dyes)
        options.dyes.push_back({label_of(spec), parse_dye(spec)});
    LivePage page = live_page(dresses, options);
    result.files.push_back(job.output / kTryOnPage);
    write_file(result.files.back(), page.html);
    result.page_errors = std::move(page.errors);
}

} // namespace tsuya::scene
