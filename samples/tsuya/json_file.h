#pragma once
/// \file
/// What commands print for machines.

#include <filesystem>
#include <vector>

#include "json.h"

namespace tsuya {
struct ErrorMeasures;
struct RenderStats;
struct Plan;
} // namespace tsuya

namespace tsuya::garment {
struct Report;
}

namespace tsuya::program {

/// `tsuya-render-stats 1`
/// \param plan of the render
Json json_of(const RenderStats &stats, const Plan &plan);
/// `tsuya-render-plan 1`
Json json_of(const Plan &plan);
/// `tsuya-garment-check 1`
Json json_of(const garment::Report &report);

/// The error measures by name; null where empty or not finite
Json json_of(const ErrorMeasures &error);

/// Degrees of an angle in radians, rounded to a millionth: what a file said is said again
double degrees_of(double angle);

/// Throws Error if the file cannot be written.
void write_json(const std::filesystem::path &file, const Json &json);

} // namespace tsuya::program
