#include "tsuya/scene/own_lamps.h"

#include <algorithm>

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

} // namespace

void note_own_lamps(SpectralImage &image, std::span<const std::string> lamps) {
    for (std::size_t g = 0; g < image.groups.size() && g < lamps.size(); ++g)
        if (!lamps[g].empty())
            image.metadata[key_of(image.groups[g])] = lamps[g];
}

std::vector<NamedLamp> own_lamps(const SpectralImage &image) {
    std::vector<NamedLamp> lamps;
    for (const std::string &group : image.groups) {
        const auto spec = image.metadata.find(key_of(group));
        if (spec == image.metadata.end())
            throw Error({"light group '" + group + "' has no lamp of its own", "lamp",
                         "expected a lamp for it in the scene file, or " + group + "=LAMP"});
        lamps.push_back(lamp_of(spec->second));
    }
    return lamps;
}

void check_picture_lamps(std::span<const std::string> specs) {
    const std::vector<std::string> rest = others(specs);
    if (!rest.empty() || specs.empty())
        check_lamps(rest);
}

std::vector<NamedLamp> parse_picture_lamps(std::span<const std::string> specs,
                                           const std::filesystem::path &folder) {
    const std::vector<std::string> rest = others(specs);
    std::vector<NamedLamp> lamps;
    if (!rest.empty() || specs.empty())
        lamps = parse_lamps(rest, folder);
    const auto own = std::find(specs.begin(), specs.end(), kOwnLamps);
    if (own != specs.end())
        lamps.insert(lamps.begin() + (own - specs.begin()),
                     NamedLamp{.name = kOwnLamps, .caption = "lamps of the lights' own"});
    return lamps;
}

void check_group_or_own_lamps(std::span<const std::string> specs) {
    check_group_lamps(others(specs));
}

std::vector<NamedLamp> parse_group_or_own_lamps(std::span<const std::string> specs,
                                                const SpectralImage &image,
                                                const std::string &sample) {
    const std::vector<std::string> rest = others(specs);
    if (rest.size() == specs.size())
        return parse_group_lamps(rest, image.groups, {}, sample);
    std::vector<NamedLamp> lamps = own_lamps(image);
    for (const std::string &spec : rest) {
        const std::string name = spec.substr(0, spec.find('='));
        const auto group = std::find(image.groups.begin(), image.groups.end(), name);
        if (name == spec || group == image.groups.end()) {
            if (name == spec)
                throw Error({"'own' and '" + spec + "' are both for all groups", "lamp",
                             "expected one of them, and GROUP=LAMP"});
            parse_group_lamps(rest, image.groups); // says which there are
        }
        const std::vector<std::string> one{spec}, of_it{name};
        lamps[static_cast<std::size_t>(group - image.groups.begin())] =
            parse_group_lamps(one, of_it, {}, sample).front();
    }
    return lamps;
}

} // namespace tsuya::scene
