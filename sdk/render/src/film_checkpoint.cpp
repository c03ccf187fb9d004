#include "film_checkpoint.h"

#include <span>

#include "tsuya/sdk/detail/checkpoint.h"

namespace tsuya {
namespace {

constexpr const char *kKind = "render 10";

// What is kept of a film, in order: for the writer (a constant film) and the reader.
template <class File, class TheFilm> void each_part(File &file, TheFilm &film) {
    file.value(film.not_finite);
    file.value(film.rays);
    file.value(film.seconds);
    file.value(film.all_split);
    file.value(film.dark);
    file.value(film.most_dye);
    file.value(film.judged_channel);
    file.array(std::span(film.done));
    file.array(std::span(film.sum));
    file.array(std::span(film.difference));
    file.array(std::span(film.depth_difference));
    file.array(std::span(film.odd_sum));
    file.array(std::span(film.features));
    file.array(std::span(film.change));
    file.array(std::span(film.told));
    file.array(std::span(film.covered));
    for (auto &aov : film.aov_sums)
        file.array(std::span(aov.data));
}

} // namespace

void save_checkpoint(const Film &film, const detail::Fingerprint &fingerprint,
                     const std::filesystem::path &file) {
    detail::CheckpointWriter out(file, kKind, fingerprint);
    each_part(out, film);
    out.commit();
}

void load_checkpoint(Film &film, const detail::Fingerprint &fingerprint,
                     const std::filesystem::path &file) {
    detail::CheckpointReader in(file, kKind, fingerprint);
    each_part(in, film);
    in.finish();
}

} // namespace tsuya
