#include "fabric_fit_report.h"

#include <cmath>
#include <iomanip>
#include <iostream>

#include "json.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

// Not finite where one of the two is 0.
double log_ratio(double fitted, double measured) { return std::log10(fitted / measured); }

void print_view(double theta, double phi, double measured, double fitted) {
    std::cout << std::setprecision(1) << std::setw(9) << theta / kDegree << std::setw(9)
              << phi / kDegree << std::setprecision(6) << std::setw(17) << measured << std::setw(15)
              << fitted << std::setprecision(5) << std::setw(13);
    if (const double ratio = log_ratio(fitted, measured); std::isfinite(ratio))
        std::cout << ratio << "\n";
    else
        std::cout << "-\n";
}

void print_model(const WrittenModel &model) {
    std::cout << std::setprecision(4) << "model " << model.name << ": l2_cos " << model.l2_cos
              << " on the views that it was fitted to";
    for (const ModelScore &score : model.scores)
        std::cout << (&score == model.scores.data() ? "; on views left out of the fit: " : ", ")
                  << name_of(score.model) << " " << score.l2_cos;
    std::cout << "\n";
}

void print_points(const FitReport &report) {
    std::cout << "facets are shown up to a tilt of " << std::setprecision(1)
              << shown_tilt(report.bard) / kDegree << " degrees\n"
              << "point  theta_deg  phi_deg  brdf_per_sr  facets_per_sr\n";
    for (const FeaturePoint &p : feature_points(report.bard, report.f0))
        std::cout << std::setw(5) << p.name << std::setprecision(1) << std::setw(11)
                  << p.theta / kDegree << std::setw(9) << p.phi / kDegree << std::setprecision(6)
                  << std::setw(13) << p.brdf_per_sr << std::setw(15) << p.facets_per_sr
                  << (p.extrapolated ? "  extrapolated" : "") << "\n";
}

bool fitted_to_oblique(const FitReport &report) { return report.yarn && report.yarn->kept; }

void print_oblique(const FitReport &report) {
    if (report.after.views.empty())
        return;
    if (report.yarn) {
        std::cout << "theta_i_deg  phi_i_deg  theta_deg  phi_deg  measured_per_sr  "
                     "fitted_per_sr  log10_ratio\n";
        for (const ModelledView &view : report.after.views) {
            std::cout << std::setprecision(1) << std::setw(11) << view.row.theta_i / kDegree
                      << std::setw(11) << view.row.phi_i / kDegree << std::setw(2) << "";
            print_view(view.row.theta_r, view.row.phi_r, view.row.brdf_per_sr, view.fitted_per_sr);
        }
    }
    if (report.yarn)
        std::cout << std::setprecision(4) << "lights left out of the fit: l2_cos "
                  << report.yarn->left_out_l2_cos << ", from above alone "
                  << report.yarn->from_above_l2_cos << "; the fit "
                  << (report.yarn->kept ? "to all views" : "from above alone") << " is kept\n";
    std::cout << "oblique views " << report.after.views.size() << " under " << report.after.lights
              << " lights, " << (fitted_to_oblique(report) ? "" : "not ") << "fitted: l2_cos "
              << std::setprecision(4) << report.after.l2_cos;
    if (report.yarn)
        std::cout << ", from above alone " << report.before.l2_cos << "; pits of weft "
                  << report.yarn->lobes.pit[0] << ", of warp " << report.yarn->lobes.pit[1];
    std::cout << "\n";
}

Json json_of_model(const WrittenModel &model) {
    Json numbers{{"name", model.name}};
    if (!model.scores.empty())
        numbers["l2_cos_left_out"] = Json::object();
    for (const ModelScore &score : model.scores)
        numbers["l2_cos_left_out"][name_of(score.model)] = score.l2_cos;
    return numbers;
}

Json json_of_oblique(const FitReport &report) {
    Json numbers{{"lights", report.after.lights},
                 {"fitted", fitted_to_oblique(report)},
                 {"l2_cos", report.after.l2_cos}};
    if (report.yarn)
        numbers.update({{"l2_cos_from_above", report.before.l2_cos},
                        {"l2_cos_left_out",
                         {{"all", report.yarn->left_out_l2_cos},
                          {"from_above", report.yarn->from_above_l2_cos}}},
                        {"pit_weft", report.yarn->lobes.pit[0]},
                        {"pit_warp", report.yarn->lobes.pit[1]}});
    numbers["views"] = Json::array();
    for (const ModelledView &view : report.after.views)
        numbers["views"].push_back(
            {{"theta_i_deg", view.row.theta_i / kDegree},
             {"phi_i_deg", view.row.phi_i / kDegree},
             {"theta_deg", view.row.theta_r / kDegree},
             {"phi_deg", view.row.phi_r / kDegree},
             {"brdf_per_sr", view.row.brdf_per_sr},
             {"fitted_per_sr", view.fitted_per_sr},
             {"log10_ratio", log_ratio(view.fitted_per_sr, view.row.brdf_per_sr)}});
    return numbers;
}

} // namespace

void print_text(const FitReport &report) {
    const Bard &bard = report.bard;
    std::cout << "theta_deg  phi_deg  measured_per_sr  fitted_per_sr  log10_ratio\n";
    std::cout << std::fixed;
    for (std::size_t i = 0; i < bard.views().size(); ++i) {
        const BardView &view = bard.views()[i];
        print_view(view.theta, view.phi, view.brdf_per_sr, report.model.fitted_per_sr[i]);
    }
    print_model(report.model);
    std::cout << std::setprecision(5) << "views " << bard.views().size() << ", symmetry "
              << name_of(bard.symmetry()) << "; of the BARD through them, rms of log10 ratio "
              << bard.residual() << ", asymmetry " << bard.asymmetry() << "\n";
    print_points(report);
    for (const BodyChannel &channel : report.channels)
        std::cout << std::setprecision(4) << "body of channel " << channel.name << ": reflects "
                  << channel.reflectance << "\n";
    if (report.covers)
        for (std::size_t axis = 0; axis < 2; ++axis)
            std::cout << std::setprecision(3) << (axis == 0 ? "weft" : "warp") << ": on "
                      << report.covers->on_face[axis]
                      << " of the face by the weave, fitted filaments cover "
                      << report.covers->fitted[axis] << "\n";
    print_oblique(report);
}

void print_json(const FitReport &report) {
    const Bard &bard = report.bard;
    Json numbers{{"schema", "tsuya-fabric-fit 2"},
                 {"symmetry", name_of(bard.symmetry())},
                 {"model", json_of_model(report.model)},
                 {"residual", report.model.l2_cos},
                 {"bard", {{"rms_log10_ratio", bard.residual()}, {"asymmetry", bard.asymmetry()}}},
                 {"shown_tilt_deg", shown_tilt(bard) / kDegree},
                 {"feature_points", Json::array()},
                 {"misfits", Json::array()},
                 {"views", Json::array()}};
    if (!report.channels.empty())
        numbers["body"] = Json::array();
    for (const FeaturePoint &p : feature_points(bard, report.f0))
        numbers["feature_points"].push_back({{"name", p.name},
                                             {"theta_deg", p.theta / kDegree},
                                             {"phi_deg", p.phi / kDegree},
                                             {"brdf_per_sr", p.brdf_per_sr},
                                             {"facets_per_sr", p.facets_per_sr},
                                             {"extrapolated", p.extrapolated}});
    for (const BardView &view : misfits(bard))
        numbers["misfits"].push_back(
            {{"theta_deg", view.theta / kDegree}, {"phi_deg", view.phi / kDegree}});
    for (std::size_t i = 0; i < bard.views().size(); ++i) {
        const BardView &view = bard.views()[i];
        const double modelled = report.model.fitted_per_sr[i];
        numbers["views"].push_back({{"theta_deg", view.theta / kDegree},
                                    {"phi_deg", view.phi / kDegree},
                                    {"brdf_per_sr", view.brdf_per_sr},
                                    {"bard_per_sr", view.fitted_per_sr},
                                    {"fitted_per_sr", modelled},
                                    {"log10_ratio", log_ratio(modelled, view.brdf_per_sr)}});
    }
    if (report.covers) {
        const auto &[face, fitted] = *report.covers;
        numbers["weave"] = {{"weft", {{"on_face", face[0]}, {"fitted", fitted[0]}}},
                            {"warp", {{"on_face", face[1]}, {"fitted", fitted[1]}}}};
    }
    if (!report.after.views.empty())
        numbers["oblique"] = json_of_oblique(report);
    for (const BodyChannel &channel : report.channels)
        numbers["body"].push_back(
            {{"channel", channel.name}, {"reflectance", channel.reflectance}});
    std::cout << numbers.text() << "\n";
}

} // namespace tsuya::program
