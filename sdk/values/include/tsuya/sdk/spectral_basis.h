#pragma once
/// \file
/// What K channels over wavelengths stand for: how a spectrum becomes K numbers, and K numbers a
/// spectrum.

#include <memory>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// How channels make a spectrum.
enum class BasisKind {
    /// `count` hat functions with equally spaced centres from first_nm to last_nm; the outermost
    /// are constant beyond their centre.
    hats,
    /// Samples at `node_nm`, linear between them and constant beyond: pictures of other programs.
    samples,
    /// Means over narrow windows about `node_nm`, nearly samples, so that products of spectra stay
    /// nearly products of channels; and the most likely spectrum of cloth that has them: the linear
    /// prediction of least variance for a spectrum of unknown mean, [Cressie] section 3.2, under a
    /// model of how reflectances vary, see sdk/values/src/. Weights may be negative.
    fitted,
};

/// The functions of wavelength that the channels of a picture multiply. They sum to 1 at every
/// wavelength.
struct SpectralBasis {
    int count = 16;
    double first_nm = 400.0; ///< of hats
    double last_nm = 700.0;  ///< of hats
    BasisKind kind = BasisKind::hats;
    std::vector<double> node_nm{}; ///< of samples and of fitted: `count` of them, increasing

    /// Samples at these wavelengths, of which there is at least one; they must increase.
    static SpectralBasis samples_at(std::vector<double> node_nm);
    /// The fitted basis that renders have, of two channels or more: nodes where a difference is
    /// seen most.
    static SpectralBasis of_renders(int count);
    /// The wavelength that a channel stands for; channels count from 0.
    double centre_nm(int channel) const;
    /// Whether it has channels, and finite wavelengths that increase.
    bool is_valid() const;
    bool operator==(const SpectralBasis &) const = default;
};

/// The functions of a basis.
class BasisWeights {
  public:
    explicit BasisWeights(SpectralBasis basis); ///< of this basis

    /// One weight a channel; they sum to 1.
    std::vector<double> at_nm(double wavelength_nm) const;

  private:
    SpectralBasis basis_;
    /// At whole nanometres, [nm][channel]; linear between
    std::shared_ptr<const std::vector<double>> fitted_{};
};

/// The `count` channels of `spectrum`. Of hats: least squares at 1 nm over the basis' range,
/// limited to not negative, a constant exactly. Of samples: the spectrum at the nodes. Of fitted:
/// its means over the windows.
std::vector<float> project(const Spectrum &spectrum, const SpectralBasis &basis);

} // namespace tsuya
