#pragma once
/// \file
/// Channels that are depths of dye in place of wavelengths: where one or two dyed cloths stand
/// among greys, light transport depends on the wavelength only through the reflectances r of the
/// dyes there, T(lambda) = F(r(lambda)), and F is smooth. A render carries F at few depths; every
/// dye and lamp is applied afterwards, at 1 nm, without an error of a spectral basis.

#include <array>
#include <string>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Most dyes whose depths channels can be.
inline constexpr std::size_t kMostDyes = 2;

/// A reflectance that varies with the wavelength, and the range of its values.
struct DyeVariable {
    std::string name{}; ///< of its fabric; of a shot cloth with `.weft` or `.warp` behind
    Spectrum dye{};     ///< that is shown; another may be put in its place where it is `open`
    bool open = false;
    double lowest = 0, highest = 1; ///< 0 <= lowest < highest <= 1; beyond them nothing changes

    bool operator==(const DyeVariable &) const = default;
};

/// What the channels of a light transport are: at channel k the dyes have the reflectances
/// `node[k]`. Between them F is the polynomial in the span of products of Chebyshev polynomials of
/// degrees `degree[k]`, one product a channel.
struct DyeDepths {
    std::vector<DyeVariable> dyes{}; ///< 1 or 2
    std::vector<std::array<double, kMostDyes>> node{};
    std::vector<std::array<int, kMostDyes>> degree{};

    bool operator==(const DyeDepths &) const = default;
};

/// Channels for these dyes: Chebyshev-Lobatto nodes for one dye, Leja points over a sparse set of
/// degrees for two, fewer in the dye whose range is narrower. Throws Error for no or more than
/// kMostDyes dyes, a range that is empty or not within 0..1, or fewer channels than 2.
DyeDepths make_dye_depths(std::vector<DyeVariable> dyes, int channels);

/// Throws Error naming `where` unless the depths can be interpolated: as many nodes as degrees, all
/// finite, ranges as DyeVariable says, and nodes that determine the polynomial.
void check_dye_depths(const DyeDepths &depths, const std::string &where);

/// How F at any reflectances follows from its values at the nodes.
class DepthWeights {
  public:
    /// Throws Error as check_dye_depths.
    explicit DepthWeights(const DyeDepths &depths);

    /// One weight a channel; they sum to 1. At a node they are 1 there and 0 elsewhere.
    /// \param reflectance of each dye; limited to its range
    std::vector<double> at(const std::array<double, kMostDyes> &reflectance) const;
    /// The same with the dyes that are shown, at a wavelength.
    std::vector<double> at_nm(double wavelength_nm) const;

  private:
    DyeDepths depths_;
    std::vector<double> inverse_; // of the matrix of products at nodes, [product][channel]
};

/// Shows another dye in the place of one that is open. Throws Error where there are no depths of
/// dye, none of this name, or where it is not open; with several open dyes an empty name means all.
void set_dye(DyeDepths &depths, const std::string &name, const Spectrum &dye);

} // namespace tsuya
