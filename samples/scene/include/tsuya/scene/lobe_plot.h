#pragma once
/// \file
/// Pictures of what a fabric reflects where to.
///
///     plot_lobes({.fabric = read_fabric("satin.fabric.toml")}, "satin.svg");

#include <filesystem>
#include <optional>
#include <string>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::scene {

/// What is drawn.
struct LobePlot {
    Fabric fabric{};
    std::string model = kDefaultModel;         ///< see model_names
    std::optional<ReflectanceTable> against{}; ///< measured points over the curves
};

/// Draws, through the program gnuplot, BRDF times cos theta_r in the plane of incidence for light
/// at 0, 15, 30, 45, 60 and 75 degrees in the warp, bias and weft planes, and a map of the
/// reflectance under light from straight above, where the fabric has measured views. Points are the
/// rows of `against` that lie in those planes, and under those lights. Throws Error: a name that
/// ends neither in .svg nor in .png; as make_model; no gnuplot, naming the package that has it;
/// what gnuplot says where it fails.
void plot_lobes(const LobePlot &plot, const std::filesystem::path &file);

} // namespace tsuya::scene
