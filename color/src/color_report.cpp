#include "tsuya/color/color_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "rows.h"
#include "tsuya/color/adaptation.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// `value(i)` for each of so many, on all threads.
template <class Value> auto values_of(std::size_t count, const Value &value) {
    std::vector<decltype(value(count))> values(count);
    constexpr std::size_t kWork = 64; // values that one stands for: it is no mere addition
    for_rows(static_cast<int>(count), kWork, [&](int first, int end) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(end); ++i)
            values[i] = value(i);
    });
    return values;
}

/// The colours of each pixel under a lighting, alpha taken out.
struct LitPicture {
    std::vector<glm::dvec3> xyz{};
    std::vector<glm::dvec3> lab{}; ///< beside the lighting's own white
    /// Beside the white of the first lighting, adapted to that; empty where no eye adapts
    std::vector<glm::dvec3> adapted_lab{};
    glm::dvec3 white{1, 1, 1};
};

LitPicture light(const SpectralImage &transport, const Lighting &lighting, Observer observer,
                 double scale) {
    Image image = relight(transport, lighting, observer);
    if (transport.alpha)
        divide_by_alpha(image, *transport.alpha);
    LitPicture lit{.white = adopted_white(transport, lighting, observer)};
    for (std::size_t i = 0; i + 2 < image.data.size(); i += 3)
        lit.xyz.push_back(scale * glm::dvec3(image.data[i], image.data[i + 1], image.data[i + 2]));
    lit.lab =
        values_of(lit.xyz.size(), [&](std::size_t i) { return lab_of(lit.xyz[i], lit.white); });
    return lit;
}

/// The picture under each lighting; the first is the reference.
std::vector<LitPicture> light_all(const SpectralImage &transport,
                                  const std::vector<Lighting> &lightings, Observer observer,
                                  double scale) {
    std::vector<LitPicture> all;
    for (const Lighting &lighting : lightings) {
        all.push_back(light(transport, lighting, observer, scale));
        LitPicture &lit = all.back();
        const glm::dvec3 to = all.front().white;
        if (all.size() == 1 || !can_adapt(Adaptation::cat02, to) ||
            !can_adapt(Adaptation::cat02, lit.white))
            continue;
        const glm::dmat3 adapt = adaptation_matrix(Adaptation::cat02, lit.white, to);
        lit.adapted_lab = values_of(lit.xyz.size(),
                                    [&](std::size_t i) { return lab_of(adapt * lit.xyz[i], to); });
    }
    return all;
}

glm::dvec3 mean_of(const LitPicture &lit, const std::vector<std::size_t> &pixels) {
    glm::dvec3 sum(0.0);
    for (const std::size_t pixel : pixels)
        sum += lit.xyz[pixel];
    return sum / static_cast<double>(pixels.size());
}

PartColor color_of(const LitPicture &lit, const std::string &lighting,
                   const std::vector<std::size_t> &pixels) {
    PartColor color{lighting, lab_of(mean_of(lit, pixels), lit.white), {}};
    for (int c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (const std::size_t pixel : pixels)
            values.push_back(lit.lab[pixel][c]);
        color.over_angle[static_cast<std::size_t>(c)] = spread_of(std::move(values));
    }
    return color;
}

PartChange change_of(const LitPicture &reference, const LitPicture &test,
                     const std::vector<std::size_t> &pixels) {
    PartChange change;
    if (test.adapted_lab.empty())
        return change;
    const glm::dmat3 adapt = adaptation_matrix(Adaptation::cat02, test.white, reference.white);
    const glm::dvec3 a = mean_of(reference, pixels), b = mean_of(test, pixels);
    change.ciede2000 = ciede2000(lab_of(a, reference.white), lab_of(adapt * b, reference.white));
    change.inconstancy = color_inconstancy(a, reference.white, b, test.white);
    const auto over_angle = [&](DifferenceFormula formula) {
        return spread_of(values_of(pixels.size(), [&](std::size_t i) {
            return color_difference(formula, reference.lab[pixels[i]], test.adapted_lab[pixels[i]]);
        }));
    };
    change.ciede2000_over_angle = over_angle(DifferenceFormula::ciede2000);
    change.inconstancy_over_angle = over_angle(DifferenceFormula::cmc);
    return change;
}

/// The mean transport of each light group over the pixels as reflectances at 1 nm, alpha taken out.
std::vector<Spectrum> mean_reflectance(const SpectralImage &transport,
                                       const std::vector<std::size_t> &pixels) {
    const auto channels = static_cast<std::size_t>(transport.basis.count);
    const BasisWeights of_basis(transport.basis);
    const auto of_depths =
        transport.depths ? std::optional<DepthWeights>(*transport.depths) : std::nullopt;
    std::vector<Spectrum> means;
    for (std::size_t g = 0; g < transport.groups.size(); ++g) {
        std::vector<double> mean(channels, 0.0);
        for (const std::size_t pixel : pixels) {
            const double alpha = transport.alpha ? transport.alpha->data[pixel] : 1.0;
            const float *const t = transport.pixel(g, 0, 0) + pixel * channels;
            for (std::size_t k = 0; k < channels; ++k)
                mean[k] += alpha > 0 ? t[k] / alpha / static_cast<double>(pixels.size()) : 0.0;
        }
        Spectrum spectrum{{}, {}};
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
            const std::vector<double> weights =
                of_depths ? of_depths->at_nm(nm) : of_basis.at_nm(nm);
            spectrum.wavelength_nm.push_back(nm);
            spectrum.value.push_back(
                std::inner_product(mean.begin(), mean.end(), weights.begin(), 0.0));
        }
        means.push_back(std::move(spectrum));
    }
    return means;
}

/// The sum of light groups that one lamp lights.
Spectrum sum_of(const std::vector<Spectrum> &groups) {
    Spectrum sum = groups.front();
    for (std::size_t g = 1; g < groups.size(); ++g)
        for (std::size_t i = 0; i < sum.value.size(); ++i)
            sum.value[i] += groups[g].value[i];
    return sum;
}

/// Parts that are matched with others: the fabrics, else the garment.
bool is_cloth(const PictureRegion &region, const std::vector<PictureRegion> &all) {
    const bool any = std::any_of(all.begin(), all.end(),
                                 [](const PictureRegion &one) { return one.kind == "fabric"; });
    return region.kind == (any ? "fabric" : "garment");
}

} // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty())
        return {};
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    const auto ranked = [&](double share) {
        return values[static_cast<std::size_t>(std::max(1.0, std::ceil(share * count))) - 1];
    };
    return {std::accumulate(values.begin(), values.end(), 0.0) / count, ranked(0.05), ranked(0.5),
            ranked(0.95)};
}

ColorReporter::ColorReporter(ReportOptions options) : options_(std::move(options)) {
    report_.exposure_stops = options_.exposure_stops;
}

void ColorReporter::add(const ReportPicture &picture, const SpectralImage &transport) {
    std::vector<std::string> names;
    for (const Lighting &lighting : picture.lightings)
        names.push_back(lighting.name);
    if (names.empty() || (!report_.lightings.empty() && names != report_.lightings))
        throw Error({names.empty() ? "no lamp to report on" : "the lamps are not those before",
                     "lamps", "expected the same lamps for all pictures, at least one"});
    report_.lightings = names;
    const std::vector<PictureRegion> regions = picture_regions(transport);
    const std::size_t first = report_.parts.size();
    for (const PictureRegion &region : regions) {
        if (is_cloth(region, regions))
            cloths_.push_back({.part = report_.parts.size(),
                               .lightings = picture.lightings,
                               .reflectance = mean_reflectance(transport, region.pixels)});
        report_.parts.push_back({.picture = picture.name,
                                 .dye = picture.dye,
                                 .kind = region.kind,
                                 .name = region.name,
                                 .pixels = region.pixels.size()});
    }
    for (const Observer observer : options_.observers) {
        const std::vector<LitPicture> lit =
            light_all(transport, picture.lightings, observer, std::exp2(options_.exposure_stops));
        for (Cloth &cloth : cloths_)
            if (cloth.part >= first) {
                cloth.white_xyz.emplace_back();
                for (const LitPicture &picture_lit : lit)
                    cloth.white_xyz.back().push_back(picture_lit.white);
            }
        for (std::size_t r = 0; r < regions.size(); ++r) {
            ObservedPart part{.observer = observer};
            for (std::size_t i = 0; i < lit.size(); ++i)
                part.colors.push_back(color_of(lit[i], names[i], regions[r].pixels));
            for (std::size_t i = 1; i < lit.size(); ++i) {
                part.changes.push_back(change_of(lit[0], lit[i], regions[r].pixels));
                part.changes.back().reference = names[0];
                part.changes.back().test = names[i];
            }
            report_.parts[first + r].observed.push_back(std::move(part));
        }
    }
}

std::vector<glm::dvec3> ColorReporter::colors_of(const Cloth &cloth, Observer observer) const {
    std::vector<glm::dvec3> colors;
    for (const Lighting &lighting : cloth.lightings) {
        glm::dvec3 xyz(0.0);
        for (std::size_t g = 0; g < cloth.reflectance.size(); ++g) {
            const NamedLamp &lamp = lighting.lamps[lighting.lamps.size() == 1 ? 0 : g];
            xyz += lamp.factor * xyz_of(lamp.spectrum, cloth.reflectance[g], observer);
        }
        colors.push_back(std::exp2(options_.exposure_stops) * xyz);
    }
    return colors;
}

std::optional<double> ColorReporter::spectral_metamerism(const Cloth &first, const Cloth &second,
                                                         std::size_t lighting,
                                                         Observer observer) const {
    const Lighting &reference = first.lightings[0], &test = first.lightings[lighting];
    if (reference.lamps.size() != 1 || test.lamps.size() != 1)
        return {};
    Spectrum a = sum_of(first.reflectance), b = sum_of(second.reflectance);
    for (Spectrum *const spectrum : {&a, &b})
        for (double &value : spectrum->value)
            value *= std::exp2(options_.exposure_stops) * test.lamps[0].factor;
    return metamerism_index(a, b, reference.lamps[0].spectrum, test.lamps[0].spectrum,
                            {.observer = observer, .correction = MetamerismCorrection::spectral});
}

PairReport ColorReporter::pair(const Cloth &first, const Cloth &second,
                               std::size_t observer) const {
    const Observer eye = options_.observers[observer];
    const std::vector<glm::dvec3> &white = first.white_xyz[observer];
    const std::vector<glm::dvec3> a = colors_of(first, eye), b = colors_of(second, eye);
    PairReport pair{first.part, second.part, eye, {}, {}};
    std::vector<ClothPair> labs;
    for (std::size_t i = 0; i < a.size(); ++i) {
        labs.push_back({lab_of(a[i], white[i]), lab_of(b[i], second.white_xyz[observer][i])});
        pair.matches.push_back({report_.lightings[i], ciede2000(labs[i].first, labs[i].second),
                                cmc(labs[i].first, labs[i].second)});
    }
    for (std::size_t i = 1; i < a.size(); ++i) {
        MetamerismFigures figures{.reference = report_.lightings[0],
                                  .test = report_.lightings[i],
                                  .additive = metamerism_additive(labs[0], labs[i]),
                                  .spectral = spectral_metamerism(first, second, i, eye)};
        if (std::min({b[0].x, b[0].y, b[0].z}) > 0)
            figures.multiplicative =
                metamerism_multiplicative({a[0], b[0]}, {a[i], b[i]}, white[i]);
        pair.metamerism.push_back(std::move(figures));
    }
    return pair;
}

ColorReport ColorReporter::report() const {
    ColorReport report = report_;
    for (std::size_t observer = 0; observer < options_.observers.size(); ++observer)
        for (std::size_t i = 0; i < cloths_.size(); ++i)
            for (std::size_t j = i + 1; j < cloths_.size(); ++j)
                report.pairs.push_back(pair(cloths_[i], cloths_[j], observer));
    return report;
}

} // namespace tsuya
