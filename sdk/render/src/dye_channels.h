#pragma once
// Channels that are depths of dye: which colours of a scene vary, and what a fabric is like at each
// depth.

#include <array>
#include <optional>
#include <vector>

#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/render.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// Which dye each colour of a fabric is; none: a constant.
struct VaryingColours {
    std::optional<std::size_t> weft_dye{}, warp_dye{}, transmittance{}, weft_tint{}, warp_tint{};
};

struct VaryingScene {
    std::vector<DyeVariable> dyes{};       // as dye_variables
    std::vector<VaryingColours> fabrics{}; // of the scene, in its order
};

// Throws Error as dye_variables.
VaryingScene varying_colours(const Scene &scene);

// Number of channels that carry these dyes to well below a visible difference.
int depth_channels(const std::vector<DyeVariable> &dyes);

// The depths of a render. \param most_dye what the cloths can show of each dye at most
std::optional<DyeDepths> depths_of(std::vector<DyeVariable> dyes,
                                   const std::array<double, kMostDyes> &most_dye, int channels);

// The dyes whose depths are the channels of the scene's renders; none: channels are wavelengths.
std::vector<DyeVariable> planned_dyes(const Scene &scene);

// What the channels of a render are where they are wavelengths. \param dyes of its plan
SpectralBasis basis_of(const std::vector<DyeVariable> &dyes, int channels);

// With the number of channels that the plan chooses.
RenderSettings as_planned(const Scene &scene, RenderSettings settings);

// The place of a channel in the spectra of fabric_at_depths.
inline double place_of(int channel) { return channel + 1.0; }

// The fabric whose colours vary from channel to channel in place of wavelengths.
Fabric fabric_at_depths(const Fabric &fabric, const VaryingColours &varying,
                        const DyeDepths &depths);

} // namespace tsuya
