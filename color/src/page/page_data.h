#pragma once
/// \file
/// What the scripts of a page know, as JSON.

#include <span>
#include <string>
#include <vector>

#include "page/packed_picture.h"
#include "tsuya/color/live_page.h"

namespace tsuya {

/// The data of a page: observers, lamps, dyes, views, and of each dress what its planes mean.
std::string page_data(std::span<const PageDress> dresses, std::span<const PackedPicture> packed,
                      const PageOptions &options);

} // namespace tsuya
