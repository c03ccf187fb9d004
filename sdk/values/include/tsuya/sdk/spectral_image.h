#pragma once
/// \file
/// What a render makes: lamp-free light transport T, K channels per light group (light
/// transport is linear and acts on each wavelength by itself, so lamps are applied afterwards).

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_basis.h"

namespace tsuya {

/// Transport of each light group, per pixel. A lamp S turns it into a picture: the integral of
/// S(lambda) * cmf(lambda) * sum_k T_k basis_k(lambda). T = 1 is a perfect white diffuser that the
/// group's lights light with irradiance pi.
struct SpectralImage {
    int width = 0;
    int height = 0;
    SpectralBasis basis{};
    /// Where it is set, the channels are depths of dye and not the functions of `basis`, whose
    /// count is theirs: sum_k T_k w_k(lambda), w the DepthWeights at the dyes' reflectances there.
    std::optional<DyeDepths> depths{};
    /// The channels are radiance, with the light of a lamp in it, and no transport: pictures of
    /// other programs. Only the lamp E, which leaves it as it is, makes a picture of it.
    bool emissive = false;
    std::vector<std::string> groups{}; ///< light group names
    std::vector<float> transport{};    ///< [group][y][x][k]
    std::vector<Image> aovs{};         ///< arbitrary output variables, see aov_names
    std::vector<std::string> aov_names{};
    std::map<std::string, std::string> metadata{}; ///< provenance, e.g. {"samples_per_pixel", "64"}
    /// One channel `A`: the share of each pixel that objects cover. The transport is that of the
    /// covered part times its share (associated alpha). Empty: the picture has no alpha.
    std::optional<Image> alpha{};
    /// x0, y0, x1, y1 in pixels, half open: the part that was rendered, all else is 0. Empty: the
    /// whole picture.
    std::optional<std::array<int, 4>> data_window{};

    /// All transport 0, without AOVs.
    static SpectralImage make(int width, int height, SpectralBasis basis,
                              std::vector<std::string> groups);
    /// The channels of a pixel, one after the other. Not checked against the size.
    float *pixel(std::size_t group, int x, int y) { return transport.data() + offset(group, x, y); }
    /// The same, to be read.
    const float *pixel(std::size_t group, int x, int y) const {
        return transport.data() + offset(group, x, y);
    }

  private:
    std::size_t offset(std::size_t group, int x, int y) const {
        const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
        return ((group * h + static_cast<std::size_t>(y)) * w + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(basis.count);
    }
};

/// The name of a channel: `T.400,000nm`, as [Fichet] names reflectances, or `T.depth.07` where they
/// are depths of dye. A picture of radiance has `S0.400,000nm`.
std::vector<std::string> channel_names(const SpectralBasis &basis, bool at_depths,
                                       bool emissive = false);

} // namespace tsuya
