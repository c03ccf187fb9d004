#include "tsuya/color/shown_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "channel_sums.h"
#include "display_curve.h"
#include "group_weights.h"
#include "rows.h"
#include "tsuya/color/picture_region.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

/// The white that the options adapt from; any where they do not.
glm::dvec3 white_to_adapt(const SpectralImage &transport, const Lighting &lighting,
                          const DisplayOptions &options) {
    return options.adapt == Adaptation::none ? srgb_white() : adopted_white(transport, lighting);
}

/// From X, Y, Z under the lighting to linear light of Rec. 709.
glm::dmat3 linear_matrix(const SpectralImage &transport, const Lighting &lighting,
                         const DisplayOptions &options) {
    return std::exp2(options.exposure_stops) * srgb_from_xyz() *
           adaptation_matrix(options.adapt, white_to_adapt(transport, lighting, options),
                             srgb_white(), options.degree);
}

/// Rows of linear light, `finish(y, row)` being what becomes of each.
template <class Finish>
void linear_rows(const SpectralImage &transport, const Lighting &lighting,
                 const DisplayOptions &options, const Finish &finish) {
    const LitBy lit = lit_by(transport, lighting);
    const auto weights = group_weights(transport, lit.lamps, lit.options,
                                       linear_matrix(transport, lighting, options));
    const std::size_t values = static_cast<std::size_t>(transport.width) *
                               static_cast<std::size_t>(transport.basis.count) * weights.size();
    for_rows(transport.height, values, [&](int first, int end) {
        std::vector<float> row(3 * static_cast<std::size_t>(transport.width));
        for (int y = first; y < end; ++y) {
            std::fill(row.begin(), row.end(), 0.0f);
            for (std::size_t g = 0; g < weights.size(); ++g)
                add_channel_sums(transport.pixel(g, 0, y), weights[g], transport.width, row.data());
            finish(y, row.data());
        }
    });
}

Image make_picture(const SpectralImage &transport) {
    return transport.alpha ? Image::make(transport.width, transport.height, {"R", "G", "B", "A"})
                           : Image::make(transport.width, transport.height, {"R", "G", "B"});
}

/// By OpenColorIO, in three passes.
Image shown_by_passes(const SpectralImage &transport, const Lighting &lighting,
                      const DisplayOptions &options) {
    Image xyz = relight(transport, lighting);
    if (transport.alpha)
        divide_by_alpha(xyz, *transport.alpha);
    const Image colors = display(xyz, white_to_adapt(transport, lighting, options), options);
    if (!transport.alpha)
        return colors;
    Image picture = make_picture(transport);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            std::copy_n(colors.pixel(x, y), 3, picture.pixel(x, y));
            picture.pixel(x, y)[3] = *transport.alpha->pixel(x, y);
        }
    return picture;
}

} // namespace

Image shown_picture(const SpectralImage &transport, const Lighting &lighting,
                    const DisplayOptions &options) {
    check_display_options(options);
    if (!options.config.empty() || options.display != "sRGB")
        return shown_by_passes(transport, lighting, options);
    const DisplayCurve &curve = DisplayCurve::of(options.view);
    Image picture = make_picture(transport);
    const std::size_t channels = picture.channels.size();
    linear_rows(transport, lighting, options, [&](int y, const float *row) {
        float *out = picture.pixel(0, y);
        const float *const alpha = transport.alpha ? transport.alpha->pixel(0, y) : nullptr;
        for (int x = 0; x < picture.width; ++x, row += 3, out += channels) {
            const float share = alpha ? alpha[x] : 1.0f;
            const bool finite = std::isfinite(row[0] + row[1] + row[2]);
            for (int c = 0; c < 3; ++c)
                out[c] = !finite     ? std::numeric_limits<float>::quiet_NaN()
                         : share > 0 ? curve.code(row[c] / share)
                                     : 0.0f;
            if (alpha)
                out[3] = share;
        }
    });
    return picture;
}

Image linear_picture(const SpectralImage &transport, const Lighting &lighting,
                     const DisplayOptions &options) {
    Image picture = make_picture(transport);
    const std::size_t channels = picture.channels.size();
    linear_rows(transport, lighting, options, [&](int y, const float *row) {
        float *out = picture.pixel(0, y);
        for (int x = 0; x < picture.width; ++x, row += 3, out += channels) {
            std::copy_n(row, 3, out);
            if (transport.alpha)
                out[3] = transport.alpha->pixel(0, y)[x];
        }
    });
    return picture;
}

double share_out_of_gamut(const SpectralImage &transport, const Lighting &lighting,
                          const DisplayOptions &options) {
    // A channel that is negative by less than this share of the largest is rounding or noise
    constexpr float kInside = -0.002f;
    const std::vector<char> counts = garment_pixels(transport);
    std::vector<std::size_t> outside(static_cast<std::size_t>(transport.height), 0);
    linear_rows(transport, lighting, options, [&](int y, const float *row) {
        const auto width = static_cast<std::size_t>(transport.width);
        const char *const counted = counts.data() + static_cast<std::size_t>(y) * width;
        for (std::size_t x = 0; x < width; ++x) {
            const auto [least, most] = std::minmax({row[3 * x], row[3 * x + 1], row[3 * x + 2]});
            outside[static_cast<std::size_t>(y)] += counted[x] && least < kInside * most;
        }
    });
    const auto all = std::count(counts.begin(), counts.end(), 1);
    std::size_t sum = 0;
    for (const std::size_t of_row : outside)
        sum += of_row;
    return all > 0 ? static_cast<double>(sum) / static_cast<double>(all) : 0;
}

} // namespace tsuya
