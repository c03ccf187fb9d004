#include "spectral_reader.h"

#include <unordered_map>

#include "depth_attributes.h"
#include "spectral_layout.h"
#include "tsuya/color/image_file.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using namespace layout;

const std::string *find(const InputPicture &part, const std::string &key) {
    const auto found = part.attributes.find(key);
    return found == part.attributes.end() ? nullptr : &found->second;
}

/// Where the channels of a picture are in a file.
class Places {
  public:
    Places(const std::vector<InputPicture> &parts, const std::string &where)
        : parts_(parts), where_(where),
          in_one_part_(*find(parts.front(), kSchemaKey) == kFirstSchema) {}

    struct Place {
        const InputPicture *part;
        std::vector<std::size_t> channels;
    };
    Place of_group(const SpectralImage &image, std::size_t g) const {
        const std::vector<std::string> names =
            channel_names(image.basis, image.depths.has_value(), image.emissive);
        if (!in_one_part_)
            return in_part(part_of_group(image.groups[g]), names);
        std::vector<std::string> first_names;
        for (const std::string &name : names) {
            const std::string rest = name.substr(name.find('.') + 1);
            first_names.push_back(image.groups[g] + (image.depths ? "." : ".S0.") + rest);
        }
        return in_part("", first_names);
    }
    Place of_alpha() const { return in_part(in_one_part_ ? "" : kPicturePart, {kAlphaChannel}); }
    Place of_aov(const SpectralImage &image, std::size_t i) const {
        const std::string &aov = image.aov_names[i];
        std::vector<std::string> names = image.aovs[i].channels;
        if (!in_one_part_)
            return in_part(part_of_aov(aov), names);
        for (std::string &name : names)
            if (!aov.starts_with("Crypto") || !name.starts_with(aov))
                name.insert(0, "aov." + aov + '.');
        return in_part("", names);
    }

  private:
    /// \param name empty: the first
    Place in_part(const std::string &name, const std::vector<std::string> &channels) const {
        for (const InputPicture &part : parts_)
            if (name.empty() || part.part == name)
                return {&part, find_channels(part, channels, where_)};
        throw Error({"the part '" + name + "' is missing", where_, kOurs});
    }

    const std::vector<InputPicture> &parts_;
    const std::string &where_;
    bool in_one_part_;
};

/// The parts of the light in AOVs of the first layout were called radiance.
std::string as_transport(std::string name) {
    if (const std::size_t at = name.find(".S0."); at != std::string::npos)
        name.replace(at, 4, ".T.");
    return name;
}

/// What the attributes of a file say, with the pictures still empty.
SpectralImage parse_header(const InputPicture &part, const std::string &where) {
    const std::string &schema = *find(part, kSchemaKey);
    if (schema != kSchema && schema != kFirstSchema)
        throw Error({"the file has the schema '" + schema + "'", where,
                     std::string("expected ") + kSchema + " or " + kFirstSchema});
    std::optional<DyeDepths> depths = read_depths(part.attributes, where);
    const std::string *basis_value = find(part, kBasisKey);
    const SpectralBasis basis = depths
                                    ? SpectralBasis{.count = static_cast<int>(depths->node.size())}
                                    : parse_basis(basis_value ? *basis_value : "", where);
    std::vector<std::string> groups;
    while (const std::string *group = find(part, group_key(groups.size())))
        groups.push_back(*group);
    if (groups.empty())
        throw Error({"the attribute tsuya:group.0 is missing", where, kOurs});
    SpectralImage image = empty_spectral(part, basis, std::move(groups), where);
    image.depths = std::move(depths);
    if (find(part, kAlphaKey))
        image.alpha = Image::make(image.width, image.height, {kAlphaChannel});
    while (const std::string *aov = find(part, aov_key(image.aovs.size()))) {
        std::vector<std::string> channels;
        while (const auto *channel =
                   find(part, aov_channel_key(image.aovs.size(), channels.size())))
            channels.push_back(*channel);
        image.aovs.push_back(Image::make(image.width, image.height, std::move(channels)));
        image.aov_names.push_back(*aov);
    }
    for (const auto &[key, value] : part.attributes)
        if (key.starts_with(kMetaPrefix))
            image.metadata[key.substr(std::string_view(kMetaPrefix).size())] = value;
        else if (is_cryptomatte_key(key))
            image.metadata[key] = value;
    return image;
}

} // namespace

SpectralImage empty_spectral(const InputPicture &part, const SpectralBasis &basis,
                             std::vector<std::string> groups, const std::string &where) {
    const auto [x, y, width, height] = part.place;
    if (x < 0 || y < 0 || x > width - part.image.width || y > height - part.image.height)
        throw Error({"the data window reaches out of the display window", where, kOurs});
    const std::size_t channels = groups.size() * static_cast<std::size_t>(basis.count);
    detail::need_memory(static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                            channels * sizeof(float),
                        std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                            detail::counted(channels, "channel"),
                        where, "expected a smaller picture");
    SpectralImage image = SpectralImage::make(width, height, basis, std::move(groups));
    if (part.image.width < width || part.image.height < height)
        image.data_window = {x, y, x + part.image.width, y + part.image.height};
    return image;
}

std::vector<std::size_t> find_channels(const InputPicture &part,
                                       const std::vector<std::string> &names,
                                       const std::string &where) {
    std::unordered_map<std::string, std::size_t> index;
    for (std::size_t c = 0; c < part.image.channels.size(); ++c)
        index[part.image.channels[c]] = c;
    std::vector<std::size_t> indices;
    for (const std::string &name : names) {
        const auto found = index.find(name);
        if (found == index.end())
            throw Error({"the channel '" + name + "' is missing", where, kOurs});
        indices.push_back(found->second);
    }
    return indices;
}

SpectralImage read_own_spectral(const std::vector<InputPicture> &parts, const std::string &where) {
    SpectralImage image = parse_header(parts.front(), where);
    const Places places(parts, where);
    const auto copy = [&](const Places::Place &place, auto &&to) {
        const InputPicture &part = *place.part, &first = parts.front();
        const bool same_place = part.place.x == first.place.x && part.place.y == first.place.y &&
                                part.image.width == first.image.width &&
                                part.image.height == first.image.height;
        if (!same_place)
            throw Error({"the part '" + part.part + "' has another data window", where, kOurs});
        copy_channels(part, place.channels, to);
    };
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        copy(places.of_group(image, g), [&](int x, int y) { return image.pixel(g, x, y); });
    if (image.alpha)
        copy(places.of_alpha(), [&](int x, int y) { return image.alpha->pixel(x, y); });
    for (std::size_t i = 0; i < image.aovs.size(); ++i)
        copy(places.of_aov(image, i), [&](int x, int y) { return image.aovs[i].pixel(x, y); });
    for (Image &aov : image.aovs)
        for (std::string &name : aov.channels)
            name = as_transport(std::move(name));
    return image;
}

SpectralImage read_spectral_exr(const std::filesystem::path &path) {
    const std::vector<InputPicture> parts = picture_reader().read_parts(path);
    if (parts.front().format != "openexr")
        throw Error({"the file is no spectral picture", path.string(), kOurs});
    return find(parts.front(), kSchemaKey) ? read_own_spectral(parts, path.string())
                                           : read_foreign_spectral(parts, path.string());
}

} // namespace tsuya
