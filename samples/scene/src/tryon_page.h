#pragma once
/// \file
/// The live page of a try-on.

#include <vector>

#include "tsuya/color/live_page.h"
#include "tsuya/scene/tryon.h"

namespace tsuya::scene {

inline constexpr const char *kTryOnPage = "page.html";

/// Writes the page into the output folder, and its name and errors into the result. The dyes of the
/// job come first among those that can be chosen. Throws Error as live_page.
void write_try_on_page(const std::vector<PageDress> &dresses, const std::vector<NamedLamp> &lamps,
                       const TryOn &job, TryOnResult &result);

} // namespace tsuya::scene
