#include "tsuya/scene/compare_sheet.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "tsuya/color/color_rendering.h"
#include "tsuya/color/difference_map.h"
#include "tsuya/color/shown_picture.h"
#include "tsuya/color/srgb.h"
#include "tsuya/scene/own_lamps.h"

namespace tsuya::scene {
namespace {

/// The means over blocks of side x side pixels, channel by channel.
void average(const float *from, int width, int height, std::size_t channels, int side, float *to) {
    for (int y = 0; y < height; y += side)
        for (int x = 0; x < width; x += side, to += channels) {
            const int right = std::min(x + side, width), below = std::min(y + side, height);
            const float share = 1.0f / static_cast<float>((right - x) * (below - y));
            for (int v = y; v < below; ++v)
                for (int u = x; u < right; ++u) {
                    const float *const pixel =
                        from + (static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(u)) *
                                   channels;
                    for (std::size_t c = 0; c < channels; ++c)
                        to[c] += share * pixel[c];
                }
        }
}

Image smaller_image(const Image &image, int side) {
    Image small = Image::make((image.width + side - 1) / side, (image.height + side - 1) / side,
                              image.channels);
    average(image.data.data(), image.width, image.height, image.channels.size(), side,
            small.data.data());
    return small;
}

std::string decimal(double value, int decimals) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << value;
    return text.str();
}

/// CIELAB is known: the white beside it has no stimulus that is 0, as under a single line.
bool is_known(const glm::dvec3 &lab) {
    return std::isfinite(lab.x) && std::isfinite(lab.y) && std::isfinite(lab.z);
}

/// The colour of a swatch: CIELAB beside a lamp's white, shown beside the display's as bright as in
/// the pictures. Grey where it is not known. \param stops exposure that the colour has in it
glm::dvec3 swatch_color(const glm::dvec3 &lab, double stops, const DisplayOptions &look) {
    if (!is_known(lab))
        return glm::dvec3(0.5);
    const glm::dvec3 xyz = xyz_of_lab(lab, srgb_white());
    Image one = Image::make(1, 1, {"X", "Y", "Z"});
    for (int c = 0; c < 3; ++c)
        one.data[static_cast<std::size_t>(c)] = static_cast<float>(xyz[c]);
    DisplayOptions shown = look;
    shown.adapt = Adaptation::none;
    shown.exposure_stops = look.exposure_stops - stops;
    const Image rgb = display(one, srgb_white(), shown);
    return {rgb.data[0], rgb.data[1], rgb.data[2]};
}

/// The parts whose colours are shown: fabrics, else the garment.
std::vector<const PartReport *> shown_parts(std::span<const PartReport> parts) {
    std::vector<const PartReport *> shown;
    for (const char *kind : {"fabric", "garment"}) {
        for (const PartReport &part : parts)
            if (part.kind == kind)
                shown.push_back(&part);
        if (!shown.empty())
            break;
    }
    return shown;
}

} // namespace

SpectralImage smaller_transport(const SpectralImage &transport, int side) {
    if (side <= 1)
        return transport;
    SpectralImage small = SpectralImage::make((transport.width + side - 1) / side,
                                              (transport.height + side - 1) / side, transport.basis,
                                              transport.groups);
    small.depths = transport.depths;
    small.metadata = transport.metadata;
    const auto channels = static_cast<std::size_t>(transport.basis.count);
    for (std::size_t g = 0; g < transport.groups.size(); ++g)
        average(transport.pixel(g, 0, 0), transport.width, transport.height, channels, side,
                small.pixel(g, 0, 0));
    if (transport.alpha)
        small.alpha = smaller_image(*transport.alpha, side);
    for (std::size_t i = 0; i < transport.aovs.size(); ++i)
        if (transport.aovs[i].channels.size() == 1) {
            small.aovs.push_back(smaller_image(transport.aovs[i], side));
            small.aov_names.push_back(transport.aov_names[i]);
        }
    return small;
}

std::string lamp_caption(const NamedLamp &lamp) {
    const std::string name = lamp.caption.empty() ? lamp.name : lamp.caption;
    if (lamp.name == kOwnLamps)
        return name;
    const LampFigures figures = lamp_figures(lamp.spectrum);
    return figures.ra ? name + "\nRa " + decimal(*figures.ra, 0) : name;
}

CompareSheet::CompareSheet(std::vector<NamedLamp> lamps, const DisplayOptions &look,
                           Observer observer, double figure_stops)
    : lamps_(std::move(lamps)), look_(look), observer_(observer), figure_stops_(figure_stops) {
    for (const NamedLamp &lamp : lamps_)
        captions_.push_back(lamp_caption(lamp));
    sheet_.columns = sheet_columns(lamps_.size());
}

void CompareSheet::add(const std::string &label, const SpectralImage &transport,
                       std::span<const PartReport> parts) {
    const SpectralImage small = smaller_transport(
        transport, (transport.width + kSheetPictureWidth - 1) / kSheetPictureWidth);
    std::vector<Lighting> lightings;
    for (const NamedLamp &lamp : lamps_)
        lightings.push_back(lighting_of_picture(small, {&lamp, 1}));
    add_pictures(label, small, lightings, true);
    add_pictures(label, small, lightings, false);
    add_maps(small, lightings);
    add_swatches(parts, small.width, small.width / 5);
}

void CompareSheet::add_pictures(const std::string &label, const SpectralImage &transport,
                                const std::vector<Lighting> &lightings, bool adapted) {
    std::vector<SheetPicture> row;
    for (std::size_t i = 0; i < lightings.size(); ++i) {
        DisplayOptions look = look_;
        if (adapted && look.adapt == Adaptation::none)
            look.adapt = Adaptation::cat02;
        if (!adapted || !can_adapt(look.adapt, adopted_white(transport, lightings[i])))
            look.adapt = Adaptation::none;
        const double outside = share_out_of_gamut(transport, lightings[i], look);
        most_out_of_gamut_ = std::max(most_out_of_gamut_, outside);
        const std::string gamut =
            outside < 0.0005 ? "all in gamut" : decimal(100 * outside, 1) + " % out of gamut";
        row.push_back({shown_picture(transport, lightings[i], look),
                       adapted ? captions_[i] +
                                     (captions_[i].find('\n') == std::string::npos ? "\n" : ", ") +
                                     gamut
                               : lightings[i].name + ", " + gamut,
                       {}});
    }
    const std::string what = adapted ? "adapted" : "as a camera\nfor daylight";
    add_rows(sheet_, label.empty() ? what : label + "\n" + what, std::move(row));
}

void CompareSheet::add_maps(const SpectralImage &transport,
                            const std::vector<Lighting> &lightings) {
    const CompareOptions options{.observer = observer_, .exposure_stops = figure_stops_};
    std::vector<SheetPicture> row{difference_legend(transport.width, transport.height)};
    row[0].caption = "CIEDE2000 of the adapted pictures";
    for (std::size_t i = 1; i < lightings.size(); ++i) {
        if (!can_adapt(options.adapt, adopted_white(transport, lightings[i], observer_)) ||
            !can_adapt(options.adapt, adopted_white(transport, lightings[0], observer_))) {
            row.emplace_back();
            continue;
        }
        const Image map = difference_map(transport, lightings[0], lightings[i], options);
        std::vector<double> values;
        for (const float v : map.data)
            if (std::isfinite(v))
                values.push_back(v);
        const Spread spread = spread_of(values);
        row.push_back({picture_of_differences(map),
                       lightings[i].name + " against " + lightings[0].name + ": mean " +
                           decimal(spread.mean, 1) + ", 95 % below " + decimal(spread.p95, 1),
                       {}});
    }
    add_rows(sheet_, "difference", std::move(row));
}

void CompareSheet::add_swatches(std::span<const PartReport> parts, int width, int height) {
    const std::vector<const PartReport *> shown = shown_parts(parts);
    if (shown.empty())
        return;
    std::vector<SheetPicture> row;
    for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp) {
        const auto count = static_cast<int>(shown.size());
        SheetPicture swatches{.image = Image::make(width, height * count, {"R", "G", "B"}),
                              .caption = lamps_[lamp].name};
        for (int p = 0; p < count; ++p) {
            const PartReport &part = *shown[static_cast<std::size_t>(p)];
            const auto observed =
                std::find_if(part.observed.begin(), part.observed.end(),
                             [&](const ObservedPart &one) { return one.observer == observer_; });
            const glm::dvec3 lab = observed->colors[lamp].lab,
                             rgb = swatch_color(lab, figure_stops_, look_);
            for (int y = p * height; y < (p + 1) * height; ++y)
                for (int x = 0; x < width; ++x)
                    for (int c = 0; c < 3; ++c)
                        swatches.image.pixel(x, y)[c] = static_cast<float>(rgb[c]);
            const double middle = (p + 0.5) / count, line = 0.22 / count;
            swatches.marks.push_back(
                {0.04, middle - line, part.name.empty() ? part.kind : part.name});
            swatches.marks.push_back({0.04, middle + line,
                                      is_known(lab)
                                          ? "L* " + decimal(lab.x, 1) + "  a* " +
                                                decimal(lab.y, 1) + "  b* " + decimal(lab.z, 1)
                                          : "no L* a* b*"});
        }
        row.push_back(std::move(swatches));
    }
    add_rows(sheet_,
             observer_ == Observer::cie1964 ? "colours,\n10 degrees" : "colours,\n2 degrees",
             std::move(row));
}

} // namespace tsuya::scene
