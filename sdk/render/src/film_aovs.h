#pragma once
// The AOVs of a film: from samples to sums, and from sums to pictures.

#include <span>

#include "film.h"
#include "first_hit.h"
#include "light_split.h"

namespace tsuya {

// What the film's AOVs and alpha take from a sample.
class FilmAovs {
  public:
    FilmAovs(const Scene &scene, Film &film);

    bool want_first_hit() const { return wants_first_hit_; }
    bool want_light_parts() const { return wants_light_parts_; }
    void add(int x, int y, const FirstHit &first);
    // \param whole a sample's transport, per group; `direct` and `surface` its parts
    template <int K>
    void add(int x, int y, std::span<const Channels<K>> whole, const Channels<K> *direct,
             const Channels<K> *surface);

  private:
    const Scene &scene_;
    Film &film_;
    bool wants_first_hit_ = false, wants_light_parts_ = false;
    std::vector<std::uint32_t> first_panels_{};
};

// Sets the AOVs of a picture, and the metadata of their ids.
void develop_aovs(const Film &film, const Scene &scene, const RenderSettings &settings,
                  SpectralImage &image);

template <int K>
void FilmAovs::add(int x, int y, std::span<const Channels<K>> whole, const Channels<K> *direct,
                   const Channels<K> *surface) {
    for (std::size_t i = 0; i < film_.aovs.size(); ++i) {
        const Aov aov = film_.aovs[i];
        if (!is_part_of_light(aov))
            continue;
        const bool rest = aov == Aov::indirect || aov == Aov::body;
        const Channels<K> *const part =
            aov == Aov::direct || aov == Aov::indirect ? direct : surface;
        float *to = film_.aov_sums[i].pixel(x, y);
        for (std::size_t g = 0; g < whole.size(); ++g)
            for (std::size_t k = 0; k < K; ++k)
                *to++ += rest ? whole[g].v[k] - part[g].v[k] : part[g].v[k];
    }
}

} // namespace tsuya
