#include "page/page_data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lower_case.h"
#include "page/json_text.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

constexpr int kDigits = 7; // of spectra; a display has three

/// A spectrum as it is; where it has more samples than observers, its mean about each of their
/// wavelengths, so that sums over them are integrals.
std::string samples_of(const Spectrum &spectrum) {
    constexpr int kParts = 20; // of a nanometre
    std::vector<double> nanometres = spectrum.wavelength_nm, values = spectrum.value;
    if (values.size() > kObserverLastNm - kObserverFirstNm + 1) {
        nanometres.clear();
        values.clear();
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
            double mean = 0;
            for (int i = 1 - kParts; i < kParts; ++i)
                mean += (1 - std::abs(i) / double{kParts}) / kParts *
                        spectrum.at(nm + i / double{kParts});
            nanometres.push_back(nm);
            values.push_back(mean);
        }
    }
    return json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"nm", json::numbers(nanometres, kDigits)}, {"value", json::numbers(values, kDigits)}}});
}

std::string observer_data(Observer observer) {
    std::array<std::vector<double>, 3> curves;
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        for (int c = 0; c < 3; ++c)
            curves[static_cast<std::size_t>(c)].push_back(color_matching(observer, nm)[c]);
    return json::object(std::array<std::pair<std::string, std::string>, 3>{
        {{"x", json::numbers(curves[0], kDigits)},
         {"y", json::numbers(curves[1], kDigits)},
         {"z", json::numbers(curves[2], kDigits)}}});
}

std::string lamp_data(const NamedLamp &named) {
    const std::string named_first = named.name + ": "; // the page has the name by itself
    return json::object(std::array<std::pair<std::string, std::string>, 4>{
        {{"name", json::text(named.name)},
         {"caption", json::text(named.caption.starts_with(named_first)
                                    ? named.caption.substr(named_first.size())
                                    : named.caption)},
         {"factor", json::number(named.factor)},
         {"power", samples_of(named.spectrum)}}});
}

std::string dye_data(const std::string &name, const Spectrum &reflectance) {
    return json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"name", json::text(name)}, {"reflectance", samples_of(reflectance)}}});
}

/// The lamps that are shown, then the others that have names.
std::string lamps_data(const PageOptions &options) {
    std::vector<std::string> all;
    for (const NamedLamp &named : options.lamps)
        all.push_back(lamp_data(named));
    for (const std::string &name : lamp_names())
        if (std::none_of(options.lamps.begin(), options.lamps.end(), [&](const NamedLamp &named) {
                return lower_case(named.name) == lower_case(name);
            }))
            all.push_back(lamp_data(find_lamp(name)));
    return json::array(all);
}

std::string dyes_data(const PageOptions &options) {
    std::vector<std::string> all;
    for (const NamedDye &named : options.dyes)
        all.push_back(dye_data(named.name, named.spectrum));
    for (const std::string &name : dye_names())
        if (std::none_of(options.dyes.begin(), options.dyes.end(), [&](const NamedDye &named) {
                return lower_case(named.name) == lower_case(name);
            }))
            all.push_back(dye_data(name, dye(name)));
    return json::array(all);
}

/// The codes of a view for light at equal steps of light / (light + kHalf), from 0 to kBrightest:
/// those that `display` gives.
std::string view_data(const std::string &view) {
    constexpr int kCodes = 1024;
    constexpr double kHalf = 0.25, kBrightest = 256;
    const double step = kBrightest / (kBrightest + kHalf) / (kCodes - 1);
    Image ramp = Image::make(kCodes, 1, {"X", "Y", "Z"});
    for (int i = 0; i < kCodes; ++i)
        for (int c = 0; c < 3; ++c)
            ramp.pixel(i, 0)[c] =
                static_cast<float>(kHalf * step * i / (1 - step * i) * srgb_white()[c]);
    const Image shown = display(ramp, srgb_white(), {.view = view});
    std::vector<double> codes;
    for (int i = 0; i < kCodes; ++i)
        codes.push_back(shown.pixel(i, 0)[1]);
    return json::object(std::array<std::pair<std::string, std::string>, 5>{
        {{"name", json::text(view)},
         {"description", json::text(view_description(view))},
         {"half", json::number(kHalf)},
         {"step", json::number(step)},
         {"code", json::numbers(codes, 5)}}});
}

std::string views_data() {
    std::vector<std::string> all;
    for (const std::string &view : view_names())
        all.push_back(view_data(view));
    return json::array(all);
}

std::string depths_data(const DyeDepths &depths) {
    std::vector<std::string> dyes, nodes, degrees;
    for (const DyeVariable &dye : depths.dyes)
        dyes.push_back(json::object(std::array<std::pair<std::string, std::string>, 5>{
            {{"name", json::text(dye.name)},
             {"open", dye.open ? "true" : "false"},
             {"lowest", json::number(dye.lowest)},
             {"highest", json::number(dye.highest)},
             {"reflectance", samples_of(dye.dye)}}}));
    const std::size_t count = depths.dyes.size();
    for (std::size_t k = 0; k < depths.node.size(); ++k) {
        const std::vector<double> degree(depths.degree[k].begin(), depths.degree[k].end());
        nodes.push_back(json::numbers(std::span(depths.node[k]).first(count)));
        degrees.push_back(json::numbers(std::span(degree).first(count)));
    }
    return json::object(
        std::array<std::pair<std::string, std::string>, 4>{{{"kind", json::text("depths")},
                                                            {"dyes", json::array(dyes)},
                                                            {"node", json::array(nodes)},
                                                            {"degree", json::array(degrees)}}});
}

/// The functions of the channels at the observers' wavelengths.
std::string basis_data(const SpectralBasis &basis) {
    const BasisWeights weights(basis);
    std::vector<std::vector<double>> of_channels(static_cast<std::size_t>(basis.count));
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        const std::vector<double> at = weights.at_nm(nm);
        for (std::size_t k = 0; k < at.size(); ++k)
            of_channels[k].push_back(at[k]);
    }
    std::vector<std::string> rows;
    for (const std::vector<double> &channel : of_channels)
        rows.push_back(json::numbers(channel, kDigits));
    return json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"kind", json::text("wavelengths")}, {"weights", json::array(rows)}}});
}

std::string group_data(const std::string &name, const PackedGroup &group) {
    std::vector<std::string> directions, planes;
    for (const std::vector<double> &direction : group.direction)
        directions.push_back(json::numbers(direction, 9));
    for (const CodePlane &plane : group.planes)
        planes.push_back(json::object(std::array<std::pair<std::string, std::string>, 2>{
            {{"offset", json::number(plane.offset)}, {"step", json::number(plane.step)}}}));
    return json::object(
        std::array<std::pair<std::string, std::string>, 4>{{{"name", json::text(name)},
                                                            {"mean", json::numbers(group.mean, 9)},
                                                            {"directions", json::array(directions)},
                                                            {"planes", json::array(planes)}}});
}

std::string dress_data(const PageDress &dress, const PackedPicture &packed) {
    std::vector<std::string> groups;
    for (std::size_t g = 0; g < packed.groups.size(); ++g)
        groups.push_back(group_data(dress.image.groups[g], packed.groups[g]));
    const std::string error = json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"mean", json::number(packed.error.mean, 4)},
         {"p99", json::number(packed.error.p99, 4)}}});
    return json::object(std::array<std::pair<std::string, std::string>, 6>{
        {{"name", json::text(dress.name)},
         {"width", std::to_string(dress.image.width)},
         {"height", std::to_string(dress.image.height)},
         {"groups", json::array(groups)},
         {"channels",
          dress.image.depths ? depths_data(*dress.image.depths) : basis_data(dress.image.basis)},
         {"error", error}}});
}

std::string look_data(const PageOptions &options) {
    return json::object(std::array<std::pair<std::string, std::string>, 4>{
        {{"display", json::text(options.look.view)},
         {"observer", json::text(options.observer == Observer::cie1931 ? "2" : "10")},
         {"degree",
          options.look.adapt == Adaptation::none ? "0" : json::number(options.look.degree, 4)},
         {"exposure", json::number(options.look.exposure_stops)}}});
}

/// The adaptation of the look; CAT02 where it has none, as the page lets an eye adapt.
std::string adaptation_data(const PageOptions &options) {
    const Adaptation adapt =
        options.look.adapt == Adaptation::none ? Adaptation::cat02 : options.look.adapt;
    return json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"name", json::text(to_string(adapt))}, {"cones", json::rows(cone_matrix(adapt))}}});
}

} // namespace

std::string page_data(std::span<const PageDress> dresses, std::span<const PackedPicture> packed,
                      const PageOptions &options) {
    std::vector<std::string> of_dresses, shown;
    for (std::size_t i = 0; i < dresses.size(); ++i)
        of_dresses.push_back(dress_data(dresses[i], packed[i]));
    for (const NamedLamp &named : options.lamps)
        shown.push_back(json::text(named.name));
    const std::string observers = json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"2", observer_data(Observer::cie1931)}, {"10", observer_data(Observer::cie1964)}}});
    const std::string screen = json::object(std::array<std::pair<std::string, std::string>, 2>{
        {{"white", json::vector(srgb_white())}, {"rgb_from_xyz", json::rows(srgb_from_xyz())}}});
    return json::object(std::array<std::pair<std::string, std::string>, 12>{
        {{"observers", observers},
         {"lamps", lamps_data(options)},
         {"shown", json::array(shown)},
         {"d65", samples_of(lamp("D65"))},
         {"dyes", dyes_data(options)},
         {"first_dye", options.dyes.empty() ? "null" : json::text(options.dyes[0].name)},
         {"views", views_data()},
         {"display", screen},
         {"adaptation", adaptation_data(options)},
         {"look", look_data(options)},
         {"level_scale", json::number(kLevelScale)},
         {"dresses", json::array(of_dresses)}}});
}

} // namespace tsuya
