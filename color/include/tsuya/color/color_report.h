#pragma once
/// \file
/// The colours of pictures in the figures of the textile trade: of each part its colour under every
/// lamp, how far it keeps it, and how far two cloths match.
///
///     ColorReporter reporter;
///     reporter.add({.name = "dress", .lightings = lightings}, transport);
///     const ColorReport report = reporter.report();

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "tsuya/color/difference.h"
#include "tsuya/color/metamerism.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/picture_region.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// A value over the pixels of a part, which see it at as many angles: mean and percentiles, nearest
/// rank.
struct Spread {
    double mean = 0, p5 = 0, p50 = 0, p95 = 0;
};

/// Mean and percentiles of values, all 0 where there are none.
Spread spread_of(std::vector<double> values);

/// The colour of a part under one lighting, beside the white of that.
struct PartColor {
    std::string lighting{};
    glm::dvec3 lab{0, 0, 0};            ///< of the mean over the pixels of X, Y, Z
    std::array<Spread, 3> over_angle{}; ///< of L*, a*, b* of the pixels
};

/// How a part changes from the first lighting, the reference, to another. Nothing where no eye
/// adapts to one of them.
struct PartChange {
    std::string reference{}, test{};
    std::optional<double> ciede2000{};   ///< of the mean colours, adapted by CAT02
    std::optional<double> inconstancy{}; ///< CMCCON02 of the mean colours, see color_inconstancy
    Spread ciede2000_over_angle{};       ///< of the pixels
    Spread inconstancy_over_angle{};
};

/// A part for one observer.
struct ObservedPart {
    Observer observer = Observer::cie1964;
    std::vector<PartColor> colors{};   ///< one a lighting
    std::vector<PartChange> changes{}; ///< one a lighting but for the first
};

/// A part of a picture.
struct PartReport {
    std::string picture{}, dye{}; ///< as in ReportPicture
    std::string kind{}, name{};   ///< as in PictureRegion
    std::size_t pixels = 0;
    std::vector<ObservedPart> observed{}; ///< one an observer
};

/// Metamerism indices of two cloths, CIEDE2000, for a change from the first lighting to another.
struct MetamerismFigures {
    std::string reference{}, test{};
    std::optional<double> multiplicative{}; ///< nothing where the second is black
    double additive = 0;
    std::optional<double> spectral{}; ///< nothing where light groups have lamps of their own
};

/// Two cloths under one lighting.
struct ClothMatch {
    std::string lighting{};
    double ciede2000 = 0;
    double cmc = 0; ///< CMC(2:1), the first cloth being the standard
};

/// Two cloths, by their mean colours, for one observer.
struct PairReport {
    std::size_t first = 0, second = 0; ///< numbers of parts
    Observer observer = Observer::cie1964;
    std::vector<ClothMatch> matches{};
    std::vector<MetamerismFigures> metamerism{};
};

/// What a report says.
struct ColorReport {
    double exposure_stops = 0; ///< as in ReportOptions
    std::vector<std::string> lightings{};
    std::vector<PartReport> parts{};
    /// Of all cloths: the fabrics of each picture, its garment where it has no ids of fabrics
    std::vector<PairReport> pairs{};
};

/// For whom, and how bright.
struct ReportOptions {
    std::vector<Observer> observers{Observer::cie1964, Observer::cie1931};
    double exposure_stops = 0; ///< L* = 100 is Y = 1 after it
};

/// A picture of a report.
struct ReportPicture {
    std::string name{}; ///< may be empty
    std::string dye{};  ///< may be empty
    /// The first is the reference: D65 as a rule. The names are those of all pictures.
    std::vector<Lighting> lightings{};
};

/// Makes a report of pictures, one after the other.
class ColorReporter {
  public:
    /// With the textile trade's observer, 10 degrees, and that of 2 degrees.
    explicit ColorReporter(ReportOptions options = {});
    /// Throws Error as relight and picture_regions, for no lighting, and for lightings of other
    /// names than those of the first picture.
    void add(const ReportPicture &picture, const SpectralImage &transport);
    /// Of what was added.
    ColorReport report() const;

  private:
    /// The mean of a cloth, to be matched with others.
    struct Cloth {
        std::size_t part = 0;
        std::vector<Lighting> lightings{};
        std::vector<Spectrum> reflectance{};              ///< of each light group, at 1 nm
        std::vector<std::vector<glm::dvec3>> white_xyz{}; ///< [observer][lighting]
    };
    std::vector<glm::dvec3> colors_of(const Cloth &cloth, Observer observer) const;
    /// \param observer number of
    PairReport pair(const Cloth &first, const Cloth &second, std::size_t observer) const;
    std::optional<double> spectral_metamerism(const Cloth &first, const Cloth &second,
                                              std::size_t lighting, Observer observer) const;

    ReportOptions options_;
    ColorReport report_{};
    std::vector<Cloth> cloths_{};
};

} // namespace tsuya
