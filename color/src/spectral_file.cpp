#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <unordered_map>

#include "channels.h"
#include "depth_attributes.h"
#include "pictures.h"
#include "rows.h"
#include "tsuya/color/image_file.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light_group.h"

namespace tsuya {
namespace {

// Rises when a file of an earlier version could not be read as before.
constexpr const char *kSchema = "tsuya-spectral-1";
constexpr const char *kMetaPrefix = "tsuya:meta:";
constexpr const char *kAlphaKey = "tsuya:alpha", *kAlphaChannel = "A";
constexpr const char *kOurs = "expected an EXR that tsuya wrote";

std::string group_key(std::size_t i) { return "tsuya:group." + std::to_string(i); }
std::string aov_key(std::size_t i) { return "tsuya:aov." + std::to_string(i); }
std::string aov_channel_key(std::size_t aov, std::size_t channel) {
    return aov_key(aov) + ".channel." + std::to_string(channel);
}
// Other programs know the channels of a Cryptomatte by their own names.
std::string aov_channel_name(const std::string &aov, const std::string &channel) {
    const bool is_cryptomatte = aov.starts_with("Crypto") && channel.starts_with(aov);
    return is_cryptomatte ? channel : "aov." + aov + '.' + channel;
}
bool is_cryptomatte_key(const std::string &key) { return key.starts_with("cryptomatte/"); }

std::string basis_text(const SpectralBasis &basis) {
    std::ostringstream text;
    text.precision(17);
    text << "hat " << basis.count << ' ' << basis.first_nm << ' ' << basis.last_nm;
    return text.str();
}

std::vector<std::string> group_channels(const std::string &group, const SpectralImage &image) {
    return transport_channel_names(group, image.basis, image.depths.has_value());
}

void check(const SpectralImage &image, const std::string &where) {
    const SpectralBasis &basis = image.basis;
    const bool good_basis = basis.count > 0 && std::isfinite(basis.first_nm) &&
                            std::isfinite(basis.last_nm) && basis.first_nm < basis.last_nm;
    const std::size_t values = static_cast<std::size_t>(std::max(0, image.width)) *
                               static_cast<std::size_t>(std::max(0, image.height)) *
                               static_cast<std::size_t>(std::max(0, basis.count)) *
                               image.groups.size();
    if (!good_basis || values == 0 || image.transport.size() != values)
        throw Error({"the transport holds " + std::to_string(image.transport.size()) +
                         " values where its size, groups and basis say " + std::to_string(values),
                     where, "expected width x height x channels x groups values, at least one"});
    if (image.depths) {
        check_dye_depths(*image.depths, where);
        if (image.depths->node.size() != static_cast<std::size_t>(basis.count))
            throw Error({detail::counted(image.depths->node.size(), "depth") + " of dye for " +
                             detail::counted(static_cast<std::size_t>(basis.count), "channel"),
                         where, "expected one for each"});
    }
    if (image.aovs.size() != image.aov_names.size())
        throw Error({detail::counted(image.aovs.size(), "AOV") + " given with " +
                         detail::counted(image.aov_names.size(), "name"),
                     where, "expected a name for each"});
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        check_image(image.aovs[i], where + ": aovs." + image.aov_names[i]);
        if (image.aovs[i].width != image.width || image.aovs[i].height != image.height)
            throw Error({"the AOV '" + image.aov_names[i] + "' has another size", where,
                         "expected the size of the picture"});
    }
    if (image.alpha)
        check_image(*image.alpha, where + ": alpha");
    if (image.alpha && (image.alpha->width != image.width || image.alpha->height != image.height ||
                        image.alpha->channels.size() != 1))
        throw Error({"alpha is no picture of the same size", where,
                     "expected the size of the picture, and one channel"});
    if (image.data_window) {
        const auto [x0, y0, x1, y1] = *image.data_window;
        if (!(0 <= x0 && x0 < x1 && x1 <= image.width && 0 <= y0 && y0 < y1 && y1 <= image.height))
            throw Error({"the data window does not lie in the picture", where,
                         "expected x0 < x1 and y0 < y1 within its size"});
    }
    for (const std::string &group : image.groups)
        check_light_group(group, where);
    if (std::find(image.aov_names.begin(), image.aov_names.end(), "") != image.aov_names.end())
        throw Error({"an AOV has no name", where, "expected names"});
}

void describe(const SpectralImage &image, OutputPicture &picture) {
    picture.attributes["tsuya:schema"] = kSchema;
    if (image.depths) {
        write_depths(*image.depths, picture.attributes);
    } else {
        picture.attributes["tsuya:basis"] = basis_text(image.basis);
        // [Fichet] section 3: the version of the layout, and the unit of the S0 channels. Transport
        // is relative to the lamp, so it has none.
        picture.attributes["spectralLayoutVersion"] = "1.0";
        picture.attributes["emissiveUnits"] = "relative to the lamp";
    }
    for (std::size_t g = 0; g < image.groups.size(); ++g) {
        picture.attributes[group_key(g)] = image.groups[g];
        for (std::string &name : group_channels(image.groups[g], image))
            picture.channels.push_back(std::move(name));
    }
    if (image.alpha) {
        picture.attributes[kAlphaKey] = kAlphaChannel;
        picture.channels.emplace_back(kAlphaChannel);
    }
    picture.exact_from = picture.channels.size();
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        picture.attributes[aov_key(i)] = image.aov_names[i];
        for (std::size_t c = 0; c < image.aovs[i].channels.size(); ++c) {
            const std::string &channel = image.aovs[i].channels[c];
            picture.attributes[aov_channel_key(i, c)] = channel;
            picture.channels.push_back(aov_channel_name(image.aov_names[i], channel));
        }
    }
    for (const auto &[key, value] : image.metadata)
        picture.attributes[is_cryptomatte_key(key) ? key : kMetaPrefix + key] = value;
}

/// The whole picture of a file that has a part of it.
SpectralImage empty_picture(const InputPicture &picture, const SpectralBasis &basis,
                            std::vector<std::string> groups, const std::string &where) {
    const auto [x, y, width, height] = picture.place;
    const Image &part = picture.image;
    if (x < 0 || y < 0 || x > width - part.width || y > height - part.height)
        throw Error({"the data window reaches out of the display window", where, kOurs});
    detail::need_memory(static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                            part.channels.size() * sizeof(float),
                        std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                            detail::counted(part.channels.size(), "channel"),
                        where, "expected a smaller picture");
    SpectralImage image = SpectralImage::make(width, height, basis, std::move(groups));
    if (part.width < width || part.height < height)
        image.data_window = {x, y, x + part.width, y + part.height};
    return image;
}

SpectralBasis parse_basis(const std::string &attribute, const std::string &where) {
    SpectralBasis basis;
    std::string kind;
    std::istringstream text(attribute);
    if (!(text >> kind >> basis.count >> basis.first_nm >> basis.last_nm) || kind != "hat" ||
        basis.count < 1 || !(basis.first_nm < basis.last_nm))
        throw Error({"the attribute tsuya:basis is missing or wrong", where,
                     "expected hat COUNT FIRST_NM LAST_NM, or depths COUNT"});
    return basis;
}

/// What the attributes of a file say, with the pictures still empty.
SpectralImage parse_header(const InputPicture &picture, const std::string &where) {
    const auto find = [&](const std::string &key) {
        const auto found = picture.attributes.find(key);
        return found == picture.attributes.end() ? nullptr : &found->second;
    };
    const std::string *schema = find("tsuya:schema");
    if (picture.format != "openexr" || !schema)
        throw Error({"the file is no spectral picture", where, kOurs});
    if (*schema != kSchema)
        throw Error({"the file has the schema '" + *schema + "'", where,
                     std::string("expected ") + kSchema});
    std::optional<DyeDepths> depths = read_depths(picture.attributes, where);
    const std::string *basis_value = find("tsuya:basis");
    const SpectralBasis basis = depths
                                    ? SpectralBasis{.count = static_cast<int>(depths->node.size())}
                                    : parse_basis(basis_value ? *basis_value : "", where);
    std::vector<std::string> groups;
    while (const std::string *group = find(group_key(groups.size())))
        groups.push_back(*group);
    if (groups.empty())
        throw Error({"the attribute tsuya:group.0 is missing", where, kOurs});
    SpectralImage image = empty_picture(picture, basis, std::move(groups), where);
    image.depths = std::move(depths);
    if (find(kAlphaKey))
        image.alpha = Image::make(image.width, image.height, {kAlphaChannel});
    while (const std::string *aov = find(aov_key(image.aovs.size()))) {
        std::vector<std::string> channels;
        while (const auto *channel = find(aov_channel_key(image.aovs.size(), channels.size())))
            channels.push_back(*channel);
        image.aovs.push_back(Image::make(image.width, image.height, std::move(channels)));
        image.aov_names.push_back(*aov);
    }
    for (const auto &[key, value] : picture.attributes)
        if (key.starts_with(kMetaPrefix))
            image.metadata[key.substr(std::string_view(kMetaPrefix).size())] = value;
        else if (is_cryptomatte_key(key))
            image.metadata[key] = value;
    return image;
}

/// Channels are looked up by name: OpenImageIO gives them in an order of its own.
class ChannelFinder {
  public:
    ChannelFinder(const Image &image, std::string where) : where_(std::move(where)) {
        for (std::size_t c = 0; c < image.channels.size(); ++c)
            index_[image.channels[c]] = c;
    }
    std::vector<std::size_t> find(const std::vector<std::string> &names) const {
        std::vector<std::size_t> indices;
        for (const std::string &name : names) {
            const auto found = index_.find(name);
            if (found == index_.end())
                throw Error({"the channel '" + name + "' is missing", where_, kOurs});
            indices.push_back(found->second);
        }
        return indices;
    }

  private:
    std::string where_;
    std::unordered_map<std::string, std::size_t> index_;
};

/// Copies the channels `from` of each pixel of row `y` to `out`, side by side.
void copy_row(const Image &image, int y, const std::vector<std::size_t> &from, float *out) {
    const float *in = image.pixel(0, y);
    for (int x = 0; x < image.width; ++x, in += image.channels.size())
        for (const std::size_t channel : from)
            *out++ = in[channel];
}

} // namespace

void write_spectral_exr(const std::filesystem::path &path, const SpectralImage &image,
                        SampleType samples) {
    check(image, path.string());
    const auto [x0, y0, x1, y1] =
        image.data_window.value_or(std::array<int, 4>{0, 0, image.width, image.height});
    OutputPicture picture{.width = x1 - x0, .height = y1 - y0, .samples = samples};
    if (image.data_window)
        picture.place = {x0, y0, image.width, image.height};
    describe(image, picture);
    const auto channels = static_cast<std::size_t>(image.basis.count);
    picture.fill_row = [&, left = x0, right = x1, top = y0](int row, float *out) {
        const int y = top + row;
        for (int x = left; x < right; ++x) {
            for (std::size_t g = 0; g < image.groups.size(); ++g)
                out = std::copy_n(image.pixel(g, x, y), channels, out);
            if (image.alpha)
                *out++ = *image.alpha->pixel(x, y);
            for (const Image &aov : image.aovs)
                out = std::copy_n(aov.pixel(x, y), aov.channels.size(), out);
        }
    };
    picture_writer().write_exr(path, picture);
}

SpectralImage read_spectral_exr(const std::filesystem::path &path) {
    const InputPicture picture = picture_reader().read(path);
    SpectralImage image = parse_header(picture, path.string());
    const ChannelFinder finder(picture.image, path.string());
    std::vector<std::vector<std::size_t>> from_group, from_aov;
    for (const std::string &group : image.groups)
        from_group.push_back(finder.find(group_channels(group, image)));
    const std::vector<std::size_t> from_alpha =
        image.alpha ? finder.find({kAlphaChannel}) : std::vector<std::size_t>{};
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        std::vector<std::string> names;
        for (const std::string &channel : image.aovs[i].channels)
            names.push_back(aov_channel_name(image.aov_names[i], channel));
        from_aov.push_back(finder.find(names));
    }
    const Image &part = picture.image;
    const std::size_t row = static_cast<std::size_t>(part.width) * part.channels.size();
    const auto [left, top, width, height] = picture.place;
    for_rows(part.height, row, [&, left = left, top = top](int first, int end) {
        for (int y = first; y < end; ++y) {
            for (std::size_t g = 0; g < from_group.size(); ++g)
                copy_row(part, y, from_group[g], image.pixel(g, left, top + y));
            if (image.alpha)
                copy_row(part, y, from_alpha, image.alpha->pixel(left, top + y));
            for (std::size_t i = 0; i < from_aov.size(); ++i)
                copy_row(part, y, from_aov[i], image.aovs[i].pixel(left, top + y));
        }
    });
    return image;
}

} // namespace tsuya
