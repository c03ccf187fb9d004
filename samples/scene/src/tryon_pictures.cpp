#include "tryon_pictures.h"

#include <utility>

#include "tryon_files.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/picture.h"

namespace tsuya::scene {

TryOnPictures::TryOnPictures(const TryOn &job, std::vector<NamedLamp> lamps, TryOnResult &result)
    : job_(job), lamps_(std::move(lamps)), result_(result), look_(job.look),
      meter_(job.look), sheet_{.columns = sheet_columns(lamps_.size())} {}

std::filesystem::path TryOnPictures::transport(const Waiting &render) const {
    return job_.output / transport_name(render.dye, render.number);
}

void TryOnPictures::add(const SpectralImage &image, const std::string &dye,
                        const std::string &number) {
    const Waiting render{dye, number};
    result_.files.push_back(transport(render));
    write_transport(result_.files.back(), image, job_.samples);
    if (!job_.metered)
        return write_pictures(image, render);
    for (const NamedLamp &lamp : lamps_)
        meter_.add(image, {&lamp, 1});
    waiting_.push_back(render);
}

void TryOnPictures::finish() {
    if (job_.metered)
        look_.exposure_stops = meter_.stops();
    result_.exposure_stops = look_.exposure_stops;
    for (const Waiting &render : waiting_)
        write_pictures(read_spectral_exr(transport(render)), render);
}

void TryOnPictures::write_pictures(const SpectralImage &image, const Waiting &render) {
    std::vector<SheetPicture> row;
    for (const NamedLamp &lamp : lamps_) {
        Image picture = picture_under(image, {&lamp, 1}, look_);
        result_.files.push_back(job_.output / picture_name(render.dye, lamp.name, render.number));
        write_picture(result_.files.back(), picture,
                      {.display = look_.config.empty() ? look_.display : ""});
        if (render.number.empty())
            row.push_back({std::move(picture), lamp.caption, {}});
    }
    if (render.number.empty())
        add_rows(sheet_, render.dye, std::move(row));
}

void TryOnPictures::write_sheet() {
    result_.files.push_back(job_.output / kSheet);
    write_png(result_.files.back(), draw_sheet(sheet_));
}

} // namespace tsuya::scene
