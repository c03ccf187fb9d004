#pragma once
// Traces the samples of a film, pass after pass, until a stop rule holds.

#include "film.h"
#include "film_keeper.h"
#include "traced_scene.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

// Throws Error where after the first pass more than a small share of the samples is not finite.
void trace_passes(const TracedScene &prepared, const RenderSettings &settings, Film &film,
                  FilmKeeper &keeper, const Progress &progress);

} // namespace tsuya
