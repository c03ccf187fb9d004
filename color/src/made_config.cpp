#include "made_config.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/matrix.hpp>

#include "shoulder.h"
#include "tsuya/color/rgb_primaries.h"
#include "tsuya/color/srgb.h"

namespace OCIO = OCIO_NAMESPACE;

namespace tsuya {
namespace {

constexpr const char *kLinear = "Linear Rec.709";
constexpr const char *kDisplayReference = "CIE XYZ D65 - Display";
constexpr const char *kRaw = "Raw";
constexpr const char *kBrightView = "Plain, white at 203";
// [BT2408] diffuse white, beside the 100 cd/m2 of 1 in the display-referred reference [OpenColorIO]
constexpr double kBrightWhite = 2.03;

OCIO::MatrixTransformRcPtr matrix(const glm::dmat3 &m) {
    std::array<double, 16> rows{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rows[static_cast<std::size_t>(4 * row + column)] = m[column][row];
    rows[15] = 1.0;
    OCIO::MatrixTransformRcPtr transform = OCIO::MatrixTransform::Create();
    transform->setMatrix(rows.data());
    return transform;
}

OCIO::BuiltinTransformRcPtr builtin(const char *style) {
    OCIO::BuiltinTransformRcPtr transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    return transform;
}

// [IEC61966] the transfer curve; negative light runs along its straight piece.
OCIO::ExponentWithLinearTransformRcPtr srgb_curve() {
    OCIO::ExponentWithLinearTransformRcPtr transform = OCIO::ExponentWithLinearTransform::Create();
    transform->setGamma({2.4, 2.4, 2.4, 1.0});
    transform->setOffset({0.055, 0.055, 0.055, 0.0});
    transform->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    return transform;
}

// OpenColorIO's linear grading style counts stops from mid grey too, so that the curve is saved as
// a few points and needs no table file.
OCIO::GradingRGBCurveTransformRcPtr shoulder() {
    constexpr std::array kAboveKnee{0.0, 0.25, 0.5, 0.75, 1.0, 1.4, 1.8, 2.4, 3.0, 4.0, 5.5, 10.0};
    OCIO::GradingRGBCurveRcPtr curves = OCIO::GradingRGBCurve::Create(OCIO::GRADING_LIN);
    OCIO::GradingBSplineCurveRcPtr master = curves->getCurve(OCIO::RGB_MASTER);
    std::vector<double> stops{-7.0, 0.0};
    for (const double above : kAboveKnee)
        stops.push_back(knee_stops() + above);
    master->setNumControlPoints(stops.size());
    for (std::size_t i = 0; i < stops.size(); ++i) {
        master->getControlPoint(i) = {static_cast<float>(stops[i]),
                                      static_cast<float>(shoulder_stops(stops[i]))};
        master->setSlope(i, static_cast<float>(shoulder_slope(stops[i])));
    }
    OCIO::GradingRGBCurveTransformRcPtr transform =
        OCIO::GradingRGBCurveTransform::Create(OCIO::GRADING_LIN);
    transform->setValue(curves);
    return transform;
}

OCIO::GroupTransformRcPtr group(const std::vector<OCIO::TransformRcPtr> &parts) {
    OCIO::GroupTransformRcPtr all = OCIO::GroupTransform::Create();
    for (const OCIO::TransformRcPtr &part : parts)
        all->appendTransform(part);
    return all;
}

/// A scene-referred colour space; the reference itself has no transform.
void add_scene_space(OCIO::Config &config, const char *name, const char *description,
                     const OCIO::ConstTransformRcPtr &to_reference,
                     const char *encoding = "scene-linear") {
    OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
    space->setName(name);
    space->setFamily("Scene");
    space->setDescription(description);
    space->setEncoding(encoding);
    space->setBitDepth(OCIO::BIT_DEPTH_F32);
    if (to_reference)
        space->setTransform(to_reference, OCIO::COLORSPACE_DIR_TO_REFERENCE);
    config.addColorSpace(space);
}

void add_scene_spaces(OCIO::Config &config) {
    add_scene_space(config, kReferenceSpace, "XYZ, scene-referred, white of sRGB", nullptr);
    add_scene_space(config, kLinear, "Linear light, primaries of Rec. 709",
                    matrix(xyz_from_rgb(kRec709)));
    add_scene_space(config, "Linear Rec.2020", "Linear light, primaries of Rec. 2020",
                    matrix(xyz_from_rgb(kRec2020)));
    add_scene_space(config, "Linear Display P3", "Linear light, primaries of Display P3",
                    matrix(xyz_from_rgb(kDisplayP3)));
    add_scene_space(config, "ACES2065-1", "Linear light, primaries AP0 of the Academy",
                    builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD"));
    add_scene_space(config, "ACEScg", "Linear light, primaries AP1 of the Academy",
                    builtin("UTILITY - ACES-AP1_to_CIE-XYZ-D65_BFD"));
    add_scene_space(
        config, "ACEScct", "Logarithmic, primaries AP1 of the Academy",
        group({builtin("ACEScct_to_ACES2065-1"), builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD")}),
        "log");
    OCIO::ColorSpaceRcPtr raw = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
    raw->setName(kRaw);
    raw->setDescription("Numbers that are no colours");
    raw->setEncoding("data");
    raw->setIsData(true);
    config.addColorSpace(raw);
}

void add_display_space(OCIO::Config &config, const char *name, const char *encoding,
                       const OCIO::ConstTransformRcPtr &from_reference) {
    OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_DISPLAY);
    space->setName(name);
    space->setFamily("Display");
    space->setEncoding(encoding);
    space->setBitDepth(OCIO::BIT_DEPTH_F32);
    if (from_reference)
        space->setTransform(from_reference, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
    config.addColorSpace(space);
}

void add_view_transform(OCIO::Config &config, const char *name, const std::string &description,
                        const OCIO::ConstTransformRcPtr &transform) {
    OCIO::ViewTransformRcPtr view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
    view->setName(name);
    view->setDescription(description.c_str());
    view->setTransform(transform, OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
    config.addViewTransform(view);
}

/// A display of white 100 cd/m2: all views, and the numbers as they are.
void add_display(OCIO::Config &config, const char *name, const OCIO::ConstTransformRcPtr &coded) {
    add_display_space(config, name, "sdr-video", coded);
    for (const std::string &view : view_names())
        config.addDisplayView(name, view.c_str(), view.c_str(), name, "", "",
                              view_description(view).c_str());
    config.addDisplayView(name, kRaw, kRaw, "");
}

void add_bright_display(OCIO::Config &config, const char *name, const char *style) {
    add_display_space(config, name, "hdr-video", builtin(style));
    config.addDisplayView(name, "Plain", kBrightView, name, "", "", "");
    config.addDisplayView(name, kRaw, kRaw, "");
}

void add_displays(OCIO::Config &config) {
    add_display_space(config, kDisplayReference, "display-linear", nullptr);
    add_view_transform(config, "Plain", view_description("Plain"), matrix(glm::dmat3(1.0)));
    add_view_transform(config, "Soft", view_description("Soft"),
                       group({matrix(srgb_from_xyz()), shoulder(), matrix(xyz_from_srgb())}));
    add_view_transform(config, kBrightView, "linear light, diffuse white at 203 cd/m2",
                       matrix(glm::dmat3(kBrightWhite)));
    const auto coded = [](const RgbPrimaries &primaries) {
        return group({matrix(glm::inverse(xyz_from_rgb(primaries))), srgb_curve()});
    };
    add_display(config, "sRGB", coded(kRec709));
    add_display(config, "Display P3", coded(kDisplayP3));
    add_display(config, "Rec.709", builtin("DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709"));
    add_display(config, "Rec.2020", builtin("DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.2020"));
    add_bright_display(config, "Rec.2100-PQ", "DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ");
    add_bright_display(config, "Rec.2100-HLG", "DISPLAY - CIE-XYZ-D65_to_REC.2100-HLG-1000nit");
    config.setDefaultViewTransformName("Plain");
}

void add_looks(OCIO::Config &config, const LampWhite &lamp) {
    for (const Adaptation adapt : {Adaptation::bradford, Adaptation::cat02}) {
        if (!can_adapt(adapt, lamp.white_xyz))
            continue;
        OCIO::LookRcPtr look = OCIO::Look::Create();
        look->setName(look_name(lamp.name, adapt).c_str());
        look->setProcessSpace(kReferenceSpace);
        look->setDescription(
            ("from " + lamp.name + " to D65, adaptation " + to_string(adapt)).c_str());
        look->setTransform(matrix(adaptation_matrix(adapt, lamp.white_xyz, srgb_white())));
        config.addLook(look);
    }
}

void check(const std::vector<LampWhite> &lamps) {
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const std::string where = "lamps." + std::to_string(i);
        if (lamps[i].name.empty())
            throw Error({"the lamp has no name", where, "expected a name such as D65"});
        const glm::dvec3 &white = lamps[i].white_xyz;
        if (!(white.y > 0) || !std::isfinite(white.x + white.y + white.z))
            throw Error({"the lamp '" + lamps[i].name + "' has no white", where,
                         "expected finite X, Y and Z with Y greater than 0"});
        for (std::size_t j = 0; j < i; ++j)
            if (lamps[j].name == lamps[i].name)
                throw Error({"the lamp '" + lamps[i].name + "' is named twice", where,
                             "expected each lamp once"});
    }
}

} // namespace

OCIO::ConstConfigRcPtr make_config(const std::vector<LampWhite> &lamps) {
    check(lamps);
    OCIO::ConfigRcPtr config = OCIO::Config::Create()->createEditableCopy();
    config->setVersion(2, 0);
    config->setName("tsuya");
    config->setDescription("Tsuya: pictures under any lamp, as linear light and on displays");
    add_scene_spaces(*config);
    add_displays(*config);
    for (const LampWhite &lamp : lamps)
        add_looks(*config, lamp);
    for (const auto &[role, space] : std::array<std::pair<const char *, const char *>, 12>{
             {{OCIO::ROLE_SCENE_LINEAR, kLinear},
              {OCIO::ROLE_RENDERING, kLinear},
              {OCIO::ROLE_REFERENCE, kReferenceSpace},
              {OCIO::ROLE_DEFAULT, kLinear},
              {OCIO::ROLE_DATA, kRaw},
              {OCIO::ROLE_COLOR_PICKING, "sRGB"},
              {OCIO::ROLE_MATTE_PAINT, "sRGB"},
              {OCIO::ROLE_TEXTURE_PAINT, "sRGB"},
              {OCIO::ROLE_COMPOSITING_LOG, "ACEScct"},
              {OCIO::ROLE_COLOR_TIMING, "ACEScct"},
              {"aces_interchange", "ACES2065-1"},
              {"cie_xyz_d65_interchange", kDisplayReference}}})
        config->setRole(role, space);
    config->validate();
    return config;
}

void throw_ocio(const std::exception &error, const std::string &where) {
    throw Error({std::string("OpenColorIO: ") + error.what(), where,
                 "expected a config that OpenColorIO reads, with the displays and views that are "
                 "asked for"});
}

} // namespace tsuya
