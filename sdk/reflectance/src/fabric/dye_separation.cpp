#include "tsuya/sdk/dye_separation.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/model.h"
#include "views/lights.h"

namespace tsuya {
namespace {

constexpr double kBelowFloor = 0.1;       // share of views that noise may put below the body
constexpr double kLeastOfPeak = 1 / 500.; // of the surface

// BRDF in 1/sr of a body that reflects all that it gets, for light from straight above.
using BodyShape = std::function<double(const glm::dvec3 &to_viewer)>;

ReflectanceTable mean_of(const std::vector<ReflectanceTable> &channels) {
    ReflectanceTable mean = channels[0];
    const auto count = static_cast<double>(channels.size());
    for (std::size_t i = 0; i < mean.rows.size(); ++i) {
        double value = 0, variance = 0;
        for (const ReflectanceTable &channel : channels) {
            value += channel.rows[i].brdf_per_sr;
            variance += channel.rows[i].sigma_per_sr * channel.rows[i].sigma_per_sr;
        }
        mean.rows[i].brdf_per_sr = value / count;
        mean.rows[i].sigma_per_sr = std::sqrt(variance) / count;
    }
    return mean;
}

double albedo_of(const ReflectanceTable &table, const std::vector<double> &solid_angle) {
    double albedo = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        albedo += solid_angle[i] * table.rows[i].brdf_per_sr * table.rows[i].to_viewer().z;
    return albedo;
}

// As much body as all but a tenth of the views have.
double floor_of(const ReflectanceTable &table, const BodyShape &body) {
    std::vector<double> share;
    for (const ReflectanceRow &row : table.rows)
        share.push_back(row.brdf_per_sr / body(row.to_viewer()));
    const auto at = share.begin() + static_cast<std::ptrdiff_t>(
                                        kBelowFloor * static_cast<double>(share.size() - 1));
    std::nth_element(share.begin(), at, share.end());
    return *at;
}

DyedCloth separate(const std::vector<ReflectanceTable> &channels, const BodyShape &body) {
    DyedCloth cloth{.surface = mean_of(channels)};
    std::vector<ReflectanceRow> &rows = cloth.surface.rows;
    const std::vector<double> solid_angle =
        solid_angles(views_of(rows), {0, 0, 1}, cloth.surface.symmetry);
    // What channels differ by is the body's.
    const double mean = albedo_of(cloth.surface, solid_angle);
    for (const ReflectanceTable &channel : channels)
        cloth.reflectance.push_back(albedo_of(channel, solid_angle) - mean);
    // Of what they have in common; no channel has less than no body.
    const double common =
        std::max(floor_of(cloth.surface, body), -std::ranges::min(cloth.reflectance));
    for (double &reflectance : cloth.reflectance)
        reflectance += common;
    double peak = 0;
    for (ReflectanceRow &row : rows) {
        row.brdf_per_sr -= common * body(row.to_viewer());
        peak = std::max(peak, row.brdf_per_sr);
    }
    for (ReflectanceRow &row : rows)
        row.brdf_per_sr = std::max(row.brdf_per_sr, kLeastOfPeak * peak);
    return cloth;
}

} // namespace

DyedCloth separate_dye(const ReflectanceFile &file, const std::string &where,
                       std::optional<double> f0, const Progress &progress) {
    std::vector<ReflectanceTable> channels;
    for (const TableChannel &channel : file.channels)
        channels.push_back(channel.table.normal_incidence());
    if (channels[0].rows.empty())
        throw Error({"the table has no view with light from straight above", where,
                     "expected rows with theta_i_deg = 0"});
    DyedCloth cloth = separate(channels, [](const glm::dvec3 &) { return 1 / kPi; });

    // What the surface reflects of the light does not reach the body, nor what it reflects back of
    // the body's light the viewer: [Kelemen], as in renders. Known once there is a surface.
    const Fabric fabric{
        .name = "surface",
        .specular = CarriedViews{.bard = Bard::fit(cloth.surface, where, progress), .f0 = f0}};
    const std::optional<Brdf> surface = make_brdf(fabric, where, progress);
    const auto passed = [&](const glm::dvec3 &d) {
        return surface ? std::max(1 - double{surface->albedo_of_light(glm::vec3(d))}, 0.01) : 1.0;
    };
    const double mean = surface ? double{mean_passed(*surface)} : 1.0;
    cloth = separate(channels, [&](const glm::dvec3 &v) { return passed(v) / (kPi * mean); });
    for (std::size_t c = 0; c < cloth.reflectance.size(); ++c)
        if (cloth.reflectance[c] > 1)
            throw Error({"the body of channel " + file.channels[c].name + " reflects " +
                             std::to_string(cloth.reflectance[c]) + " times what it receives",
                         where, "expected BRDF values in 1/sr without the cosine"});
    return cloth;
}

} // namespace tsuya
