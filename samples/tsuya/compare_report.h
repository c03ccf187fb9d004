#pragma once
/// \file
/// The report of `tsuya compare` as a file.

#include <string>

#include "json.h"
#include "tsuya/color/color_report.h"

namespace tsuya::program {

/// What the schema `tsuya-compare 2` has of a report, described in samples/README.md.
Json json_of_report(const ColorReport &report);
/// A figure a row.
std::string csv_of(const ColorReport &report);
/// To be read.
std::string text_of(const ColorReport &report);

} // namespace tsuya::program
