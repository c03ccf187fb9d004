#include "tsuya/scene/own_lamps.h"

#include <algorithm>
#include <set>

#include "tsuya/color/lamp.h"
#include "tsuya/scene/environment_colours.h"
#include "tsuya/scene/picture.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

std::string key_of(const std::string &group) { return "lamp of " + group; }

NamedLamp lamp_of(const std::string &spec) {
    for (std::size_t k = 0; k < kEnvironmentLamps; ++k)
        if (spec == kEnvironmentLampNames[k])
            return {.name = spec, .spectrum = environment_lamps()[k]};
    NamedLamp lamp = find_lamp(spec);
    lamp.name = label_of(spec);
    return lamp;
}

/// The lamps beside `own`, which may stand among them once.
std::vector<std::string> others(std::span<const std::string> specs) {
    std::vector<std::string> rest;
    std::copy_if(specs.begin(), specs.end(), std::back_inserter(rest),
                 [](const std::string &spec) { return spec != kOwnLamps; });
    if (rest.size() + 1 < specs.size())
        throw Error({"two lamps have the name '" + std::string(kOwnLamps) + "'", "lamps",
                     "expected each lamp once"});
    return rest;
}

/// Specs of the lamps of groups, `own` among them.
struct SplitSpecs {
    std::vector<std::string> plain{}; ///< with another lamp in the place of `own`
    std::set<std::string> named{};    ///< the groups that have a spec of their own
    std::set<std::string> own{};      ///< those of `own`; empty is for all others
};

SplitSpecs split_own(std::span<const std::string> specs) {
    SplitSpecs split;
    for (const std::string &spec : specs) {
        const std::size_t equals = spec.find('=');
        const std::string group = equals == std::string::npos ? "" : spec.substr(0, equals);
        const std::string lamp = equals == std::string::npos ? spec : spec.substr(equals + 1);
        if (equals != std::string::npos)
            split.named.insert(group);
        if (lamp == kOwnLamps)
            split.own.insert(group);
        split.plain.push_back(lamp == kOwnLamps ? spec.substr(0, spec.size() - lamp.size()) + "E"
                                                : spec);
    }
    return split;
}

NamedLamp own_lamp(const SpectralImage &image, const std::string &group) {
    const auto spec = image.metadata.find(key_of(group));
    if (spec == image.metadata.end())
        throw Error({"light group '" + group + "' has no lamp of its own", "lamp",
                     "expected a lamp for it in the scene file, or " + group + "=LAMP"});
    return lamp_of(spec->second);
}

} // namespace

void note_own_lamps(SpectralImage &image, std::span<const std::string> lamps) {
    for (std::size_t g = 0; g < image.groups.size() && g < lamps.size(); ++g)
        if (!lamps[g].empty())
            image.metadata[key_of(image.groups[g])] = lamps[g];
}

std::vector<NamedLamp> own_lamps(const SpectralImage &image) {
    std::vector<NamedLamp> lamps;
    for (const std::string &group : image.groups)
        lamps.push_back(own_lamp(image, group));
    return lamps;
}

std::vector<NamedLamp> page_lamps(const SpectralImage &image, const std::vector<NamedLamp> &lamps) {
    std::vector<NamedLamp> all;
    const auto add = [&](const NamedLamp &lamp) {
        if (std::none_of(all.begin(), all.end(),
                         [&](const NamedLamp &known) { return known.name == lamp.name; }))
            all.push_back(lamp);
    };
    for (const NamedLamp &lamp : lamps)
        if (lamp.name == kOwnLamps)
            for (const NamedLamp &own : own_lamps(image))
                add(own);
        else
            add(lamp);
    return all;
}

Lighting lighting_of_picture(const SpectralImage &image, std::span<const NamedLamp> lamps) {
    if (lamps.size() == 1 && lamps[0].name == kOwnLamps)
        return {lamps[0].name, lamps[0].caption, own_lamps(image)};
    Lighting lighting{.lamps = {lamps.begin(), lamps.end()}};
    if (!lamps.empty()) {
        lighting.name = lamps[0].name;
        lighting.caption = lamps[0].caption;
    }
    return lighting;
}

void write_transport(const std::filesystem::path &path, const SpectralImage &image,
                     SampleType samples) {
    const bool all =
        std::all_of(image.groups.begin(), image.groups.end(), [&](const std::string &group) {
            return image.metadata.count(key_of(group)) > 0;
        });
    SpectralExrOptions options{.samples = samples};
    if (all)
        options.lamps = own_lamps(image);
    write_spectral_exr(path, image, options);
}

void check_picture_lamps(std::span<const std::string> specs) {
    const std::vector<std::string> rest = others(specs);
    if (!rest.empty() || specs.empty())
        check_lamps(rest);
}

std::vector<NamedLamp> parse_picture_lamps(std::span<const std::string> specs,
                                           const std::filesystem::path &folder,
                                           const std::string &sample) {
    const std::vector<std::string> rest = others(specs);
    std::vector<NamedLamp> lamps;
    if (!rest.empty() || specs.empty())
        lamps = parse_lamps(rest, folder, sample);
    const auto own = std::find(specs.begin(), specs.end(), kOwnLamps);
    if (own != specs.end())
        lamps.insert(lamps.begin() + (own - specs.begin()),
                     NamedLamp{.name = kOwnLamps, .caption = "lamps of the lights' own"});
    return lamps;
}

void check_group_or_own_lamps(std::span<const std::string> specs) {
    check_group_lamps(split_own(specs).plain);
}

std::vector<NamedLamp> parse_group_or_own_lamps(std::span<const std::string> specs,
                                                const SpectralImage &image,
                                                const std::string &sample) {
    const SplitSpecs split = split_own(specs);
    std::vector<NamedLamp> lamps = parse_group_lamps(split.plain, image.groups, {}, sample);
    for (std::size_t g = 0; g < image.groups.size(); ++g) {
        const bool named = split.named.count(image.groups[g]) > 0;
        if (split.own.count(named ? image.groups[g] : std::string()) > 0)
            lamps[g] = own_lamp(image, image.groups[g]);
    }
    return lamps;
}

} // namespace tsuya::scene
