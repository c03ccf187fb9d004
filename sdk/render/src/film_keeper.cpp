#include "film_keeper.h"

#include "film_checkpoint.h"

namespace tsuya {

FilmKeeper::FilmKeeper(const Scene &scene, const RenderSettings &settings, Film &film,
                       std::function<RenderResult()> result)
    : settings_(settings), film_(film), result_(std::move(result)) {
    if (settings.checkpoint.empty())
        return;
    fingerprint_ = tsuya::fingerprint(scene, settings);
    if (!settings.resume || !std::filesystem::exists(settings.checkpoint))
        return;
    load_checkpoint(film, fingerprint_, settings.checkpoint);
    saved_samples_ = film.samples();
}

bool FilmKeeper::checkpoint_is_due() const {
    if (settings_.checkpoint.empty() || !(settings_.checkpoint_seconds > 0))
        return false;
    const std::chrono::duration<double> since = Clock::now() - last_save_;
    return since.count() >= settings_.checkpoint_seconds;
}

bool FilmKeeper::snapshot_is_due() const {
    return settings_.snapshot && settings_.snapshot_wanted &&
           settings_.snapshot_wanted->load(std::memory_order_relaxed);
}

bool FilmKeeper::is_due() const { return checkpoint_is_due() || snapshot_is_due(); }

void FilmKeeper::serve() {
    if (snapshot_is_due()) {
        settings_.snapshot_wanted->store(false, std::memory_order_relaxed);
        settings_.snapshot(result_());
    }
    if (checkpoint_is_due())
        save();
}

void FilmKeeper::finish() {
    if (!settings_.checkpoint.empty() && film_.samples() != saved_samples_)
        save();
}

// A checkpoint that cannot be written does not end the render: it has the picture in memory.
void FilmKeeper::save() {
    try {
        save_checkpoint(film_, fingerprint_, settings_.checkpoint);
        saved_samples_ = film_.samples();
        problem_.reset();
    } catch (const Error &error) {
        problem_ = error.problems().front();
    }
    last_save_ = Clock::now();
}

} // namespace tsuya
