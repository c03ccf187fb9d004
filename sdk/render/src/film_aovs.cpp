#include "film_aovs.h"

#include <algorithm>

#include "cryptomatte.h"

namespace tsuya {
namespace {

// The values of a first hit that an AOV sums up; empty where there are none, and for ids.
std::span<const float> values_of(Aov aov, const FirstHit &first, std::size_t channels) {
    constexpr static float kOne = 1;
    switch (aov) {
    case Aov::coverage:
    case Aov::garment:
        return {&kOne, 1};
    case Aov::depth:
        return {&first.distance, 1};
    case Aov::normal:
        return {&first.normal.x, 3};
    case Aov::warp: // only with yarns
        return first.weft == glm::vec3(0) ? std::span<const float>{}
                                          : std::span<const float>{&first.warp.x, 3};
    case Aov::weft:
        return {&first.weft.x, 3};
    case Aov::uv:
        return {&first.uv.x, 2};
    case Aov::albedo:
        return {first.albedo.data(), channels};
    default:
        return {};
    }
}

// Of the split pixel of a block of four that lies in the picture.
float error_at(const Film &film, int x, int y) {
    const auto [x0, y0, unused, also_unused] = film.tiles.front();
    if (!film.is_split(x, y)) {
        x -= x % 2;
        y -= y % 2;
        x += x < x0 ? 2 : 0;
        y += y < y0 ? 2 : 0;
        if (x >= film.tiles.back().x1 || y >= film.tiles.back().y1)
            return 0;
    }
    const std::int32_t samples = film.samples_at(x, y);
    if (samples < 2)
        return 0;
    return static_cast<float>(film.pixel_error(x, y, samples, film.pixel_mean(x, y, samples)));
}

} // namespace

FilmAovs::FilmAovs(const Scene &scene, Film &film)
    : scene_(scene), film_(film), wants_first_hit_(!film.covered.empty()),
      first_panels_(first_panels(scene)) {
    for (const Aov aov : film.aovs) {
        wants_first_hit_ |= is_of_first_hit(aov);
        wants_light_parts_ |= is_part_of_light(aov);
    }
}

void FilmAovs::add(int x, int y, const FirstHit &first) {
    if (!first.hit)
        return;
    if (!film_.covered.empty())
        film_.covered[film_.at(x, y)] += 1;
    for (std::size_t i = 0; i < film_.aovs.size(); ++i) {
        const Aov aov = film_.aovs[i];
        if (!is_of_first_hit(aov) || (aov == Aov::garment && !scene_.objects[first.object].garment))
            continue;
        float *to = film_.aov_sums[i].pixel(x, y);
        if (aov == Aov::object_ids)
            count_id(to, first.object);
        else if (aov == Aov::fabric_ids)
            count_id(to, first.fabric);
        else if (aov == Aov::panel_ids)
            count_id(to, first_panels_[first.object] + first.panel);
        else
            for (const float value : values_of(aov, first, film_.aov_sums[i].channels.size()))
                *to++ += value;
    }
}

void develop_aovs(const Film &film, const Scene &scene, const RenderSettings &settings,
                  SpectralImage &image) {
    image.aovs = film.aov_sums;
    image.aov_names = settings.aovs;
    for (std::size_t i = 0; i < film.aovs.size(); ++i) {
        const Aov aov = film.aovs[i];
        const std::vector<std::string> names =
            is_ids(aov) ? id_names(aov, scene) : std::vector<std::string>{};
        Image &picture = image.aovs[i];
        for (std::size_t t = 0; t < film.tiles.size(); ++t) {
            const auto samples = static_cast<float>(film.done[t]);
            const float scale = samples > 0 ? 1 / samples : 0.0f;
            for (int y = film.tiles[t].y0; y < film.tiles[t].y1; ++y)
                for (int x = film.tiles[t].x0; x < film.tiles[t].x1; ++x) {
                    float *const value = picture.pixel(x, y);
                    if (aov == Aov::samples)
                        *value = samples;
                    else if (aov == Aov::error)
                        *value = error_at(film, x, y);
                    else if (is_ids(aov))
                        finish_ids(value, names, scale);
                    else
                        for (std::size_t c = 0; c < picture.channels.size(); ++c)
                            value[c] *= scale;
                }
        }
        if (is_ids(aov))
            image.metadata.merge(id_metadata(image.aov_names[i], names));
    }
}

} // namespace tsuya
