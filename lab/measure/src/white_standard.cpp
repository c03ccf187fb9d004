#include "white_standard.h"

#include <algorithm>
#include <cmath>

#include "tsuya/color/measured_spectrum.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::lab {
namespace {

const double kSameDirection = std::cos(0.5 * kDegree);

double mean_reflectance(const Spectrum &spectrum, const std::string &colour) {
    const double first_nm = colour == "R" ? 600 : colour == "G" ? 500 : 400;
    const double last_nm = colour == "R" || colour == "G" || colour == "B" ? first_nm + 100 : 700;
    double sum = 0;
    int count = 0;
    for (double nm = first_nm; nm <= last_nm; ++nm, ++count)
        sum += spectrum.at(nm);
    return sum / count;
}

std::string text_of(const DirectionPair &d) {
    std::string text;
    for (const double angle : {d.theta_i, d.phi_i, d.theta_r, d.phi_r})
        text += (text.empty() ? "" : ", ") + std::to_string(std::lround(angle / kDegree));
    return text;
}

} // namespace

WhiteStandard::WhiteStandard(const RigWhite &white, const std::string &colour) {
    if (const double *const number = std::get_if<double>(&white.rho_std)) {
        reflectance_ = *number;
        return;
    }
    const auto &file = std::get<std::filesystem::path>(white.rho_std);
    file_ = file.string();
    if (read_file(file).find("theta_i_deg") != std::string::npos) {
        table_ = read_reflectance_table(file);
        return;
    }
    MeasuredSpectrum read = read_dye_file(file);
    reflectance_ = mean_reflectance(read.spectrum, colour);
    warnings_ = std::move(read.warnings);
}

double WhiteStandard::brdf_per_sr(const DirectionPair &directions) const {
    if (!is_table())
        return reflectance_ / kPi;
    const glm::dvec3 light = directions.to_light(), viewer = directions.to_viewer();
    const auto near = [&](const ReflectanceRow &row) {
        return std::min(glm::dot(row.to_light(), light), glm::dot(row.to_viewer(), viewer));
    };
    const auto best = std::max_element(
        table_.rows.begin(), table_.rows.end(),
        [&](const ReflectanceRow &a, const ReflectanceRow &b) { return near(a) < near(b); });
    if (near(*best) < kSameDirection)
        throw Error({"the white standard's table has no row at " + text_of(directions) +
                         " degrees (theta_i, phi_i, theta_r, phi_r)",
                     file_, "expected one within half a degree"});
    return best->brdf_per_sr;
}

} // namespace tsuya::lab
