#include "tsuya/scene/picture.h"

#include <algorithm>

#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {

Image picture_under(const SpectralImage &transport, std::span<const NamedLamp> lamps,
                    const DisplayOptions &look) {
    std::vector<Spectrum> spectra;
    for (const NamedLamp &lamp : lamps)
        spectra.push_back(lamp.spectrum);
    const Image xyz = relight(transport, spectra);
    return display(xyz, white_of(spectra[0]), look);
}

std::string file_stem_of(const std::string &spec) {
    const std::filesystem::path path(spec);
    std::string stem = path.extension() == ".csv" ? path.stem().string() : spec;
    std::erase(stem, '#');
    std::replace(stem.begin(), stem.end(), '/', '_');
    return stem;
}

std::vector<NamedLamp> parse_lamps(std::span<const std::string> specs,
                                   const std::filesystem::path &folder) {
    if (specs.empty())
        throw Error({"no lamp is named", "lamps", "expected such as D65,A"});
    std::vector<NamedLamp> lamps;
    for (const std::string &spec : specs) {
        NamedLamp lamp{file_stem_of(spec), parse_lamp(spec, folder)};
        if (std::any_of(lamps.begin(), lamps.end(),
                        [&](const NamedLamp &other) { return other.name == lamp.name; }))
            throw Error({"two lamps have the name '" + lamp.name + "', the last is " + spec,
                         "lamps", "expected each lamp once, and files of different names"});
        lamps.push_back(std::move(lamp));
    }
    return lamps;
}

std::vector<NamedLamp> parse_group_lamps(std::span<const std::string> specs,
                                         std::span<const std::string> groups,
                                         const std::filesystem::path &folder) {
    std::vector<std::string> chosen(groups.size());
    std::string rest;
    for (const std::string &spec : specs) {
        const std::size_t equals = spec.find('=');
        std::string *slot = &rest;
        if (equals != std::string::npos) {
            const std::string name = spec.substr(0, equals);
            const auto group = std::find(groups.begin(), groups.end(), name);
            if (group == groups.end())
                throw Error(
                    {"no light group '" + name + "'", "lamp", accepted_names(name, groups)});
            slot = &chosen[static_cast<std::size_t>(group - groups.begin())];
        }
        if (!slot->empty())
            throw Error(
                {"two lamps for " + (slot == &rest ? std::string("all light groups")
                                                   : "group '" + spec.substr(0, equals) + "'"),
                 "lamp", "expected one; GROUP=LAMP names a group"});
        *slot = equals == std::string::npos ? spec : spec.substr(equals + 1);
    }
    std::vector<NamedLamp> lamps;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::string &spec = chosen[g].empty() ? rest : chosen[g];
        if (spec.empty())
            throw Error({"light group '" + groups[g] + "' has no lamp", "lamp",
                         "expected " + groups[g] + "=LAMP, or a LAMP for all"});
        lamps.push_back({file_stem_of(spec), parse_lamp(spec, folder)});
    }
    return lamps;
}

std::string caption_of(const NamedLamp &lamp) {
    const std::vector<std::string> known = lamp_names();
    if (std::find(known.begin(), known.end(), lamp.name) == known.end())
        return lamp.name;
    return lamp.name + ": " + lamp_description(lamp.name);
}

} // namespace tsuya::scene
