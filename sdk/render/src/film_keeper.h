#pragma once
// What happens to a film while it is traced: checkpoints and snapshots.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "film.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

class FilmKeeper {
  public:
    // Loads the film from the checkpoint where the settings ask for it. Throws Error naming the
    // file.
    // \param result the picture of the film as it is, for snapshots
    FilmKeeper(const Scene &scene, const RenderSettings &settings, Film &film,
               std::function<RenderResult()> result);

    // A checkpoint or a snapshot waits. Threads that trace may ask.
    bool is_due() const;
    // Does what is due, if anything. No thread may be tracing.
    void serve();
    // Saves what is not saved yet.
    void finish();
    const detail::Fingerprint &fingerprint() const { return fingerprint_; }
    // Why the last checkpoint could not be written.
    const std::optional<Problem> &problem() const { return problem_; }

  private:
    using Clock = std::chrono::steady_clock;

    bool checkpoint_is_due() const;
    bool snapshot_is_due() const;
    void save();

    const RenderSettings &settings_;
    Film &film_;
    std::function<RenderResult()> result_;
    detail::Fingerprint fingerprint_{};
    std::uint64_t saved_samples_ = 0; // of the film in the file
    Clock::time_point last_save_ = Clock::now();
    std::optional<Problem> problem_{};
};

} // namespace tsuya
