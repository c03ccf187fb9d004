#include "tsuya/color/config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <OpenColorIO/OpenColorIO.h>

#include "channels.h"
#include "rows.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace OCIO = OCIO_NAMESPACE;

namespace tsuya {
namespace {

constexpr const char *kReference = "CIE XYZ D65";
constexpr const char *kLinear = "Linear Rec.709";
constexpr const char *kDisplay = "sRGB";

// The shoulder works in stops above mid grey: straight to kKneeStops, then an exponential that
// nears white but never reaches it.
constexpr double kMidGrey = 0.18;
constexpr double kKneeStops = 1.0;

double white_stops() { return std::log2(1.0 / kMidGrey); }

double shoulder_stops(double stops) {
    const double room = white_stops() - kKneeStops;
    return stops <= kKneeStops ? stops
                               : kKneeStops + room * (1.0 - std::exp(-(stops - kKneeStops) / room));
}

double shoulder_slope(double stops) {
    const double room = white_stops() - kKneeStops;
    return stops <= kKneeStops ? 1.0 : std::exp(-(stops - kKneeStops) / room);
}

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

// [IEC61966] the transfer curve; negative light runs along its straight piece.
OCIO::ExponentWithLinearTransformRcPtr encode() {
    OCIO::ExponentWithLinearTransformRcPtr transform = OCIO::ExponentWithLinearTransform::Create();
    transform->setGamma({2.4, 2.4, 2.4, 1.0});
    transform->setOffset({0.055, 0.055, 0.055, 0.0});
    transform->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    return transform;
}

// OpenColorIO's linear grading style counts stops from mid grey too, so that the curve is saved as
// a few points and needs no table file.
OCIO::GradingRGBCurveTransformRcPtr shoulder() {
    constexpr std::array kStops{-7.0, 0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 8.0, 12.0};
    OCIO::GradingRGBCurveRcPtr curves = OCIO::GradingRGBCurve::Create(OCIO::GRADING_LIN);
    OCIO::GradingBSplineCurveRcPtr master = curves->getCurve(OCIO::RGB_MASTER);
    master->setNumControlPoints(kStops.size());
    for (std::size_t i = 0; i < kStops.size(); ++i) {
        master->getControlPoint(i) = {static_cast<float>(kStops[i]),
                                      static_cast<float>(shoulder_stops(kStops[i]))};
        master->setSlope(i, static_cast<float>(shoulder_slope(kStops[i])));
    }
    OCIO::GradingRGBCurveTransformRcPtr transform =
        OCIO::GradingRGBCurveTransform::Create(OCIO::GRADING_LIN);
    transform->setValue(curves);
    return transform;
}

void add_space(OCIO::Config &config, const std::string &name, const std::string &description,
               const OCIO::ConstTransformRcPtr &transform,
               OCIO::ColorSpaceDirection direction = OCIO::COLORSPACE_DIR_TO_REFERENCE) {
    OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
    space->setName(name.c_str());
    space->setDescription(description.c_str());
    space->setBitDepth(OCIO::BIT_DEPTH_F32);
    if (transform)
        space->setTransform(transform, direction);
    config.addColorSpace(space);
}

void add_view(OCIO::Config &config, const std::string &view) {
    OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(matrix(srgb_from_xyz()));
    if (view == "Soft")
        group->appendTransform(shoulder());
    group->appendTransform(encode());
    const std::string space = std::string(kDisplay) + ' ' + view;
    add_space(config, space, view_description(view), group, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
    config.addDisplayView(kDisplay, view.c_str(), space.c_str(), "");
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

OCIO::ConstConfigRcPtr make_config(const std::vector<LampWhite> &lamps) {
    OCIO::ConfigRcPtr config = OCIO::Config::Create()->createEditableCopy();
    config->setVersion(2, 0);
    config->setDescription("Tsuya: pictures under any lamp, as XYZ and on an sRGB display");
    add_space(*config, kReference, "XYZ, scene-referred, white of sRGB", nullptr);
    add_space(*config, kLinear, "Linear light, primaries of Rec. 709", matrix(xyz_from_srgb()));
    for (const LampWhite &lamp : lamps)
        for (const Adaptation adapt : {Adaptation::none, Adaptation::bradford, Adaptation::cat02})
            if (can_adapt(adapt, lamp.white_xyz))
                add_space(*config, color_space_name(lamp.name, adapt),
                          "XYZ under " + lamp.name + ", adaptation " + to_string(adapt),
                          matrix(adaptation_matrix(adapt, lamp.white_xyz, srgb_white())));
    for (const std::string &view : view_names())
        add_view(*config, view);
    config->setRole(OCIO::ROLE_SCENE_LINEAR, kLinear);
    config->setRole(OCIO::ROLE_REFERENCE, kReference);
    config->setRole(OCIO::ROLE_DEFAULT, kReference);
    config->validate();
    return config;
}

[[noreturn]] void throw_ocio(const OCIO::Exception &error, const std::string &where) {
    throw Error({std::string("OpenColorIO: ") + error.what(), where,
                 "expected a config that this library made"});
}

// Display pixels stay in [0, 1]; what was not finite before stays visible as NaN.
void clamp_pixel(const glm::vec3 &xyz, float *rgb) {
    const bool finite = std::isfinite(xyz.x) && std::isfinite(xyz.y) && std::isfinite(xyz.z);
    for (int c = 0; c < 3; ++c)
        rgb[c] = finite ? std::clamp(rgb[c], 0.0f, 1.0f) : std::numeric_limits<float>::quiet_NaN();
}

/// \param first_matrix is applied before the processor
Image apply(const OCIO::ConstCPUProcessorRcPtr &processor, const Image &xyz,
            const glm::dmat3 &first_matrix) {
    const std::array<std::size_t, 3> from = channel_indices(xyz, {"X", "Y", "Z"}, "picture");
    const glm::mat3 before(first_matrix);
    Image rgb = Image::make(xyz.width, xyz.height, {"R", "G", "B"});
    const auto row_size = static_cast<std::size_t>(xyz.width) * 3;
    for_rows(xyz.height, row_size, [&](int first, int end) {
        std::vector<glm::vec3> row(static_cast<std::size_t>(xyz.width), glm::vec3(0.0f));
        for (int y = first; y < end; ++y) {
            float *out = rgb.pixel(0, y);
            for (int x = 0; x < xyz.width; ++x) {
                const float *in = xyz.pixel(x, y);
                glm::vec3 &v = row[static_cast<std::size_t>(x)];
                v = before * glm::vec3(in[from[0]], in[from[1]], in[from[2]]);
                std::copy_n(&v.x, 3, rgb.pixel(x, y));
            }
            OCIO::PackedImageDesc description(out, xyz.width, 1, OCIO::CHANNEL_ORDERING_RGB);
            processor->apply(description);
            for (int x = 0; x < xyz.width; ++x)
                clamp_pixel(row[static_cast<std::size_t>(x)], rgb.pixel(x, y));
        }
    });
    return rgb;
}

} // namespace

std::vector<std::string> view_names() { return {"Plain", "Soft"}; }

std::string view_description(std::string_view view) {
    if (view == "Plain")
        return "linear light clamped to sRGB, exact colorimetry";
    if (view == "Soft")
        return "as Plain, with a shoulder above 0.36 that keeps highlights from clipping";
    throw Error({"there is no view '" + std::string(view) + "'", "view",
                 accepted_names(view, view_names())});
}

double soft_shoulder(double linear) {
    const double stops = std::log2(linear / kMidGrey);
    return stops > kKneeStops ? kMidGrey * std::exp2(shoulder_stops(stops)) : linear;
}

std::string color_space_name(const std::string &lamp, Adaptation adapt) {
    return lamp + (adapt == Adaptation::none ? " as seen" : " " + to_string(adapt));
}

struct DisplayConfig::Impl {
    OCIO::ConstConfigRcPtr config;
    std::string where;
};

DisplayConfig::DisplayConfig(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DisplayConfig::~DisplayConfig() = default;
DisplayConfig::DisplayConfig(DisplayConfig &&) noexcept = default;
DisplayConfig &DisplayConfig::operator=(DisplayConfig &&) noexcept = default;

DisplayConfig::DisplayConfig(const std::vector<LampWhite> &lamps) {
    check(lamps);
    try {
        impl_ = std::make_unique<Impl>(Impl{make_config(lamps), "display config"});
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, "display config");
    }
}

DisplayConfig DisplayConfig::load(const std::filesystem::path &path) {
    try {
        auto impl = std::make_unique<Impl>(
            Impl{OCIO::Config::CreateFromFile(path.string().c_str()), path.string()});
        impl->config->validate();
        return DisplayConfig(std::move(impl));
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, path.string());
    }
}

Image DisplayConfig::display(const Image &xyz, const std::string &lamp,
                             const DisplayOptions &options) const {
    view_description(options.view);
    const std::string space = color_space_name(lamp, options.adapt);
    if (const auto known = color_spaces();
        std::find(known.begin(), known.end(), space) == known.end())
        throw Error({"the display config has no colour space '" + space + "'", impl_->where,
                     accepted_names(space, known)});
    if (!std::isfinite(options.exposure_stops))
        throw Error({"the exposure is not finite", "exposure", "expected stops such as -1 or 0.5"});
    try {
        const auto processor = impl_->config->getProcessor(
            space.c_str(), kDisplay, options.view.c_str(), OCIO::TRANSFORM_DIR_FORWARD);
        return apply(processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS), xyz,
                     glm::dmat3(std::exp2(options.exposure_stops)));
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, impl_->where);
    }
}

std::vector<std::string> DisplayConfig::color_spaces() const {
    std::vector<std::string> names;
    for (int i = 0; i < impl_->config->getNumColorSpaces(); ++i)
        names.emplace_back(impl_->config->getColorSpaceNameByIndex(i));
    return names;
}

std::string DisplayConfig::text() const {
    std::ostringstream stream;
    try {
        impl_->config->serialize(stream);
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, impl_->where);
    }
    return stream.str();
}

void DisplayConfig::save(const std::filesystem::path &path) const { write_file(path, text()); }

Image display(const Image &xyz, const glm::dvec3 &lamp_white_xyz, const DisplayOptions &options) {
    const glm::dmat3 adapt =
        adaptation_matrix(options.adapt, lamp_white_xyz, srgb_white(), options.degree);
    view_description(options.view);
    if (!std::isfinite(options.exposure_stops))
        throw Error({"the exposure is not finite", "exposure", "expected stops such as -1 or 0.5"});
    try {
        const auto processor = make_config({})->getProcessor(
            kReference, kDisplay, options.view.c_str(), OCIO::TRANSFORM_DIR_FORWARD);
        return apply(processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS), xyz,
                     std::exp2(options.exposure_stops) * adapt);
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, "display config");
    }
}

} // namespace tsuya
