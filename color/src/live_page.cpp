#include "tsuya/color/live_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "page/page_data.h"
#include "page/page_files.h"
#include "page/plane_bytes.h"
#include "pictures.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

void check_image(const PageDress &dress, const std::string &where) {
    const SpectralImage &image = dress.image;
    const bool positive =
        image.width > 0 && image.height > 0 && image.basis.count > 0 && !image.groups.empty();
    const std::size_t pixels =
        positive ? static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)
                 : 0;
    if (!positive || image.transport.size() !=
                         pixels * image.groups.size() * static_cast<std::size_t>(image.basis.count))
        throw Error({"the picture '" + dress.name + "' holds " +
                         std::to_string(image.transport.size()) + " numbers",
                     where, "expected width x height x light groups x channels, at least one"});
    if (image.emissive)
        throw Error({"the picture '" + dress.name + "' is radiance, whose lamp cannot be exchanged",
                     where, "expected light transport"});
    if (!image.depths)
        return;
    check_dye_depths(*image.depths, where);
    if (image.depths->node.size() != static_cast<std::size_t>(image.basis.count))
        throw Error({"the picture '" + dress.name + "' has " + std::to_string(image.basis.count) +
                         " channels for " + std::to_string(image.depths->node.size()) +
                         " depths of dye",
                     where, "expected one channel for each depth"});
}

template <class Named> void check_names(const std::vector<Named> &all, const std::string &where) {
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (all[i].name == all[j].name)
                throw Error({"the name '" + all[i].name + "' is used twice",
                             where + "." + std::to_string(i), "expected each name once"});
}

void check(std::span<const PageDress> dresses, const PageOptions &options) {
    if (dresses.empty())
        throw Error({"a page of no picture", "dresses", "expected at least one"});
    for (std::size_t i = 0; i < dresses.size(); ++i)
        check_image(dresses[i], "dresses." + std::to_string(i));
    if (options.lamps.empty())
        throw Error({"a page without a lamp", "lamps", "expected at least one"});
    check_names(options.lamps, "lamps");
    for (const NamedLamp &lamp : options.lamps)
        white_of(lamp.spectrum);
    check_names(options.dyes, "dyes");
    for (const NamedDye &dye : options.dyes)
        check_spectrum(dye.spectrum, 0, 1, "dyes." + dye.name);
    view_description(options.look.view);
    if (!std::isfinite(options.look.exposure_stops))
        throw Error({"the exposure is not finite", "exposure", "expected stops such as -1 or 0.5"});
}

/// All planes of a dress, compressed, in base64: those of its light groups, then its coverage.
std::string planes_text(const PageDress &dress, const PackedPicture &packed) {
    std::string bytes;
    for (const PackedGroup &group : packed.groups)
        for (const CodePlane &plane : group.planes)
            bytes += plane_bytes(plane.codes, dress.image.width);
    std::vector<std::uint16_t> coverage(packed.groups[0].planes[0].codes.size());
    for (const std::size_t pixel :
         judged_pixels(dress.image, std::numeric_limits<std::size_t>::max()))
        coverage[pixel] = 1;
    bytes += plane_bytes(coverage, dress.image.width);
    return base64(picture_writer().deflate(bytes));
}

std::string html_text(std::string_view text) {
    std::string escaped;
    for (const char c : text)
        if (c == '<')
            escaped += "&lt;";
        else if (c == '&')
            escaped += "&amp;";
        else
            escaped += c;
    return escaped;
}

std::string_view file_text(std::string_view name) {
    const std::span<const PageFile> files = page_files();
    return std::find_if(files.begin(), files.end(),
                        [&](const PageFile &file) { return file.name == name; })
        ->text;
}

std::string all_scripts() {
    std::string text;
    for (const PageFile &file : page_files())
        if (file.name.ends_with(".js"))
            text.append(file.text).append("\n");
    return text;
}

/// The template with each `{{name}}` replaced.
std::string filled(std::string_view html,
                   const std::vector<std::pair<std::string, std::string>> &parts) {
    std::string page;
    while (!html.empty()) {
        const std::size_t open = html.find("{{"), close = html.find("}}");
        page += html.substr(0, open);
        if (open == std::string_view::npos)
            break;
        const std::string_view name = html.substr(open + 2, close - open - 2);
        page += std::find_if(parts.begin(), parts.end(), [&](const auto &part) {
                    return part.first == name;
                })->second;
        html.remove_prefix(close + 2);
    }
    return page;
}

} // namespace

LivePage live_page(std::span<const PageDress> dresses, const PageOptions &options) {
    check(dresses, options);
    LivePage made;
    std::vector<PackedPicture> packed;
    std::string planes;
    for (std::size_t i = 0; i < dresses.size(); ++i) {
        packed.push_back(pack_picture(dresses[i].image, options.most_error));
        made.errors.push_back(packed.back().error);
        planes += "<script type=\"text/plain\" id=\"planes-" + std::to_string(i) + "\">" +
                  planes_text(dresses[i], packed.back()) + "</script>\n";
        // Codes are in the text now
        for (PackedGroup &group : packed.back().groups)
            for (CodePlane &plane : group.planes)
                plane.codes = {};
    }
    made.html = filled(file_text("page.html"), {{"title", html_text(options.title)},
                                                {"style", std::string(file_text("style.css"))},
                                                {"shader", std::string(file_text("picture.glsl"))},
                                                {"data", page_data(dresses, packed, options)},
                                                {"planes", planes},
                                                {"script", all_scripts()}});
    return made;
}

} // namespace tsuya
