#include "tsuya/lab/session_pictures.h"

#include <algorithm>
#include <cmath>

#include "hemisphere_picture.h"
#include "left_out_marks.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::lab {
namespace {

constexpr double kDecades = 4; // of the scale, below the largest value

std::string told(const MeasuredView &view) {
    return "view " + std::to_string(view.view) + ", theta_r " +
           number_text(view.directions.theta_r / kDegree, 4) + "°, phi_r " +
           number_text(view.directions.phi_r / kDegree, 4) +
           "°: " + number_text(view.brdf_per_sr, 4) + " ± " + number_text(view.sigma_per_sr(), 2) +
           " 1/sr";
}

} // namespace

std::string table_picture(const Session &session, const SessionMeasurement &measured,
                          std::size_t channel) {
    const std::vector<MeasuredView> &views = measured.channels.at(channel).views;
    double most = 0;
    for (const MeasuredView &view : views)
        most = std::max(most, view.brdf_per_sr);
    most = most > 0 ? most : 1; // nothing reflects: one colour
    double least = most;
    for (const MeasuredView &view : views)
        least = std::min(least, std::max(view.brdf_per_sr, most * std::pow(10, -kDecades)));
    const double range = std::max(std::log10(most / least), 1e-9);
    HemispherePicture picture{
        .title = "Reflectance, channel " + measured.channels[channel].name + ": " +
                 detail::counted(views.size(), "view"),
        .key = {{MarkShape::dot, scale_colour(0.7), "measured view, by its BRDF in 1/sr"}},
        .scale = ColourScale{.low = number_text(least, 3),
                             .high = number_text(most, 3),
                             .words = "1/sr, logarithmic"}};
    add_left_out(session.plan, picture);
    for (const MeasuredView &view : views)
        picture.marks.push_back(
            {view.directions, MarkShape::dot,
             scale_colour(std::log10(std::max(view.brdf_per_sr, least) / least) / range),
             told(view)});
    add_left_out(measured, picture);
    return draw(picture);
}

} // namespace tsuya::lab
