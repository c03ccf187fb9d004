#include "tsuya/color/config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <OpenColorIO/OpenColorIO.h>
#include <glm/matrix.hpp>

#include "channels.h"
#include "display_curve.h"
#include "made_config.h"
#include "rows.h"
#include "shoulder.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace OCIO = OCIO_NAMESPACE;

namespace tsuya {
namespace {

// Pixels of a display stay in [0, 1]; what was not finite before stays visible as NaN.
void clamp_pixel(const glm::vec3 &light, float *rgb) {
    const bool finite = std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z);
    for (int c = 0; c < 3; ++c)
        rgb[c] = finite ? std::clamp(rgb[c], 0.0f, 1.0f) : std::numeric_limits<float>::quiet_NaN();
}

/// R, G, B of each pixel: `matrix` times X, Y, Z, then `code(row of pixels, width)` row by row.
template <class Code> Image coded(const Image &xyz, const glm::dmat3 &matrix, const Code &code) {
    const std::array<std::size_t, 3> from = channel_indices(xyz, {"X", "Y", "Z"}, "picture");
    const glm::mat3 first(matrix);
    Image rgb = Image::make(xyz.width, xyz.height, {"R", "G", "B"});
    for_rows(xyz.height, static_cast<std::size_t>(xyz.width) * 3, [&](int begin, int end) {
        std::vector<glm::vec3> row(static_cast<std::size_t>(xyz.width), glm::vec3(0.0f));
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < xyz.width; ++x) {
                const float *in = xyz.pixel(x, y);
                glm::vec3 &v = row[static_cast<std::size_t>(x)];
                v = first * glm::vec3(in[from[0]], in[from[1]], in[from[2]]);
                std::copy_n(&v.x, 3, rgb.pixel(x, y));
            }
            code(rgb.pixel(0, y), xyz.width);
            for (int x = 0; x < xyz.width; ++x)
                clamp_pixel(row[static_cast<std::size_t>(x)], rgb.pixel(x, y));
        }
    });
    return rgb;
}

Image processed(const OCIO::ConstProcessorRcPtr &processor, const Image &xyz,
                const glm::dmat3 &matrix) {
    const auto cpu = processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
    return coded(xyz, matrix, [&](float *row, int width) {
        OCIO::PackedImageDesc description(row, width, 1, OCIO::CHANNEL_ORDERING_RGB);
        cpu->apply(description);
    });
}

std::vector<std::string> displays_of(const OCIO::ConstConfigRcPtr &config) {
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumDisplays(); ++i)
        names.emplace_back(config->getDisplay(i));
    return names;
}

std::vector<std::string> views_of(const OCIO::ConstConfigRcPtr &config,
                                  const std::string &display) {
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumViews(display.c_str()); ++i)
        names.emplace_back(config->getView(display.c_str(), i));
    return names;
}

/// A name that the config has, or its first where none is given.
std::string chosen(const std::string &name, const std::vector<std::string> &known,
                   const std::string &what, const std::string &where) {
    if (name.empty() && !known.empty())
        return known.front();
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error(
            {"there is no " + what + " '" + name + "'", where, accepted_names(name, known)});
    return name;
}

/// By a config of the user's: through ACES2065-1, which it must know.
Image display_by_file(const Image &xyz, const glm::dmat3 &matrix, const DisplayOptions &options) {
    const std::string where = options.config.string();
    try {
        const auto config = OCIO::Config::CreateFromFile(where.c_str());
        if (!config->hasRole("aces_interchange"))
            throw Error({"the config has no role aces_interchange", where,
                         "expected a config for OpenColorIO 2 with that role"});
        const std::string display = chosen(options.display, displays_of(config), "display", where);
        const std::string view =
            chosen(options.view, views_of(config, display), "view", where + ", " + display);
        const auto to_aces = make_config({})->getProcessor(kReferenceSpace, "ACES2065-1");
        const auto to_display = config->getProcessor("aces_interchange", display.c_str(),
                                                     view.c_str(), OCIO::TRANSFORM_DIR_FORWARD);
        const auto first = to_aces->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS),
                   second = to_display->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
        return coded(xyz, matrix, [&](float *row, int width) {
            OCIO::PackedImageDesc description(row, width, 1, OCIO::CHANNEL_ORDERING_RGB);
            first->apply(description);
            second->apply(description);
        });
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, where);
    }
}

std::string view_of(const DisplayOptions &options) {
    return options.view.empty() ? "Plain" : options.view;
}

} // namespace

std::vector<std::string> view_names() { return {"Plain", "Soft"}; }

std::string view_description(std::string_view view) {
    if (view == "Plain")
        return "linear light clamped to the display, exact colorimetry";
    if (view == "Soft")
        return "as Plain, with a shoulder above 0.5 that keeps highlights from clipping";
    throw Error({"there is no view '" + std::string(view) + "'", "view",
                 accepted_names(view, view_names())});
}

std::vector<std::string> display_names() {
    return {"sRGB", "Display P3", "Rec.709", "Rec.2020", "Rec.2100-PQ", "Rec.2100-HLG"};
}

std::string display_description(std::string_view display) {
    constexpr std::array<std::array<const char *, 2>, 6> kDescriptions{
        {{"sRGB", "primaries of Rec. 709, curve of sRGB"},
         {"Display P3", "primaries of P3, curve of sRGB"},
         {"Rec.709", "primaries of Rec. 709, curve of Rec. 1886"},
         {"Rec.2020", "primaries of Rec. 2020, curve of Rec. 1886"},
         {"Rec.2100-PQ", "high dynamic range, perceptual quantizer, white at 203 cd/m2"},
         {"Rec.2100-HLG", "high dynamic range, hybrid log-gamma, white at 203 cd/m2"}}};
    for (const auto &[name, description] : kDescriptions)
        if (display == name)
            return description;
    throw Error({"there is no display '" + std::string(display) + "'", "display",
                 accepted_names(display, display_names())});
}

double soft_shoulder(double linear) {
    const double stops = std::log2(linear / kMidGrey);
    return stops > knee_stops() ? kMidGrey * std::exp2(shoulder_stops(stops)) : linear;
}

std::string look_name(const std::string &lamp, Adaptation adapt) {
    return adapt == Adaptation::none ? "" : lamp + " " + to_string(adapt);
}

void check_display_options(const DisplayOptions &options) {
    if (!std::isfinite(options.exposure_stops))
        throw Error({"the exposure is not finite", "exposure", "expected stops such as -1 or 0.5"});
    if (!options.config.empty())
        return;
    view_description(view_of(options));
    display_description(options.display);
    if (options.display.starts_with("Rec.2100") && view_of(options) != "Plain")
        throw Error({"the display " + options.display + " has no view " + options.view, "view",
                     "expected Plain: it shows highlights as they are"});
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
    check_display_options(options);
    if (options.adapt != Adaptation::none && options.degree != 1)
        throw Error({"the degree of adaptation is " + std::to_string(options.degree), "degree",
                     "expected 1: the looks of a config adapt fully"});
    const std::string look = look_name(lamp, options.adapt);
    if (const auto known = looks();
        !look.empty() && std::find(known.begin(), known.end(), look) == known.end())
        throw Error({"the display config has no look '" + look + "'", impl_->where,
                     accepted_names(look, known)});
    try {
        OCIO::GroupTransformRcPtr all = OCIO::GroupTransform::Create();
        if (!look.empty()) {
            OCIO::LookTransformRcPtr adapt = OCIO::LookTransform::Create();
            adapt->setSrc(kReferenceSpace);
            adapt->setDst(kReferenceSpace);
            adapt->setLooks(look.c_str());
            all->appendTransform(adapt);
        }
        OCIO::DisplayViewTransformRcPtr shown = OCIO::DisplayViewTransform::Create();
        shown->setSrc(kReferenceSpace);
        shown->setDisplay(options.display.c_str());
        shown->setView(view_of(options).c_str());
        all->appendTransform(shown);
        return processed(impl_->config->getProcessor(all), xyz,
                         glm::dmat3(std::exp2(options.exposure_stops)));
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, impl_->where);
    }
}

std::vector<std::string> DisplayConfig::color_spaces() const {
    std::vector<std::string> names;
    const int count =
        impl_->config->getNumColorSpaces(OCIO::SEARCH_REFERENCE_SPACE_ALL, OCIO::COLORSPACE_ALL);
    for (int i = 0; i < count; ++i)
        names.emplace_back(impl_->config->getColorSpaceNameByIndex(OCIO::SEARCH_REFERENCE_SPACE_ALL,
                                                                   OCIO::COLORSPACE_ALL, i));
    std::sort(names.begin(), names.end()); // a file has an order of its own
    return names;
}

std::vector<std::string> DisplayConfig::looks() const {
    std::vector<std::string> names;
    for (int i = 0; i < impl_->config->getNumLooks(); ++i)
        names.emplace_back(impl_->config->getLookNameByIndex(i));
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

DisplayConfig full_config() {
    std::vector<LampWhite> lamps;
    for (const std::string &name : lamp_names())
        lamps.push_back({name, white_of(lamp(name))});
    return DisplayConfig(lamps);
}

Image display(const Image &xyz, const glm::dvec3 &lamp_white_xyz, const DisplayOptions &options) {
    check_display_options(options);
    const glm::dmat3 adapt =
        std::exp2(options.exposure_stops) *
        adaptation_matrix(options.adapt, lamp_white_xyz, srgb_white(), options.degree);
    if (!options.config.empty())
        return display_by_file(xyz, adapt, options);
    if (options.display == "sRGB") {
        const DisplayCurve &curve = DisplayCurve::of(view_of(options));
        return coded(xyz, srgb_from_xyz() * adapt, [&](float *row, int width) {
            for (int i = 0; i < 3 * width; ++i)
                row[i] = curve.code(row[i]);
        });
    }
    try {
        const auto processor =
            make_config({})->getProcessor(kReferenceSpace, options.display.c_str(),
                                          view_of(options).c_str(), OCIO::TRANSFORM_DIR_FORWARD);
        return processed(processor, xyz, adapt);
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, "display config");
    }
}

} // namespace tsuya
