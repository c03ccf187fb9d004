#include "tsuya/scene/picture.h"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/shown_picture.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

/// `SPEC`, for all, or `NAME=SPEC`.
struct NamedSpec {
    std::string name{}; ///< empty: all
    std::string spec{};
};

NamedSpec split_spec(const std::string &spec) {
    const std::size_t equals = spec.find('=');
    if (equals == std::string::npos)
        return {.spec = spec};
    return {spec.substr(0, equals), spec.substr(equals + 1)};
}

NamedLamp labelled(NamedLamp lamp) {
    lamp.name = label_of(lamp.name);
    return lamp;
}

} // namespace

Image xyz_under(const SpectralImage &transport, std::span<const NamedLamp> lamps) {
    return relight(transport, lighting_of_picture(transport, lamps));
}

Image picture_under(const SpectralImage &transport, std::span<const NamedLamp> lamps,
                    const DisplayOptions &look) {
    return picture_under(transport, lighting_of_picture(transport, lamps), look);
}

Image picture_under(const SpectralImage &transport, const Lighting &lighting,
                    const DisplayOptions &look) {
    return shown_picture(transport, lighting, look);
}

DisplayOptions page_look(DisplayOptions look) {
    if (!look.config.empty())
        look.view = default_look().view;
    look.config.clear();
    look.display = default_look().display;
    return look;
}

std::string label_of(const std::string &spec) {
    const auto file = parse_spectrum_file_spec(spec);
    if (!file || spec.find('*') != spec.npos) // a mixture
        return spec;
    return file->path.stem().string() + (file->sample.empty() ? "" : ":" + file->sample);
}

std::string file_stem_of(const std::string &spec) {
    std::string stem = label_of(spec);
    const auto one_of = [](std::string_view all) {
        return [all](char c) { return all.find(c) != all.npos; };
    };
    std::erase_if(stem, one_of("#*%()"));
    std::replace_if(stem.begin(), stem.end(), one_of("/: "), '_');
    return stem;
}

void check_distinct(std::span<const std::string> specs, const std::string &kind) {
    std::map<std::string, std::string> specs_of; // by name
    for (const std::string &spec : specs) {
        const std::string name = file_stem_of(spec);
        std::string folded = name; // some file systems do not tell cases apart
        for (char &c : folded)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (const auto [first, is_new] = specs_of.emplace(folded, spec); !is_new)
            throw Error({"two " + kind + "s have the name '" + name + "': " + first->second +
                             " and " + spec,
                         kind, "expected each " + kind + " once, and files of different names"});
    }
}

void check_lamps(std::span<const std::string> specs) {
    if (specs.empty())
        throw Error({"no lamp is named", "lamps", "expected such as D65,A"});
    const std::vector<std::string> all = expand_lamp_sets(specs);
    for (const std::string &spec : all)
        check_lamp_spec(spec);
    check_distinct(all, "lamp");
}

std::vector<NamedLamp> parse_lamps(std::span<const std::string> specs,
                                   const std::filesystem::path &folder, const std::string &sample) {
    check_lamps(specs);
    std::vector<NamedLamp> lamps;
    for (const std::string &spec : expand_lamp_sets(specs))
        lamps.push_back(labelled(find_lamp(spec, folder, sample)));
    return lamps;
}

void check_group_lamps(std::span<const std::string> specs) {
    std::set<std::string> groups;
    for (const std::string &spec : specs) {
        const NamedSpec one = split_spec(spec);
        if (spec.starts_with('='))
            throw Error(
                {"'" + spec + "' names no light group", "lamp", "expected LAMP or GROUP=LAMP"});
        if (const std::string one_spec[] = {one.spec};
            expand_lamp_sets(one_spec) != std::vector<std::string>{one.spec}) {
            std::string members;
            for (const std::string &member : expand_lamp_sets(one_spec))
                members += (members.empty() ? "" : ", ") + member;
            throw Error(
                {"'" + one.spec + "' is a set of lamps, and a picture has one for each group",
                 "lamp", "expected one of them: " + members});
        }
        check_lamp_spec(one.spec);
        if (!groups.insert(one.name).second)
            throw Error({"two lamps for " + (one.name.empty() ? std::string("all light groups")
                                                              : "group '" + one.name + "'"),
                         "lamp", "expected one; GROUP=LAMP names a group"});
    }
}

std::vector<NamedLamp> parse_group_lamps(std::span<const std::string> specs,
                                         std::span<const std::string> groups,
                                         const std::filesystem::path &folder,
                                         const std::string &sample) {
    check_group_lamps(specs);
    std::vector<std::string> chosen(groups.size());
    std::string rest;
    for (const std::string &spec : specs) {
        const NamedSpec one = split_spec(spec);
        const auto group = std::find(groups.begin(), groups.end(), one.name);
        if (one.name.empty())
            rest = one.spec;
        else if (group == groups.end())
            throw Error(
                {"no light group '" + one.name + "'", "lamp", accepted_names(one.name, groups)});
        else
            chosen[static_cast<std::size_t>(group - groups.begin())] = one.spec;
    }
    std::vector<NamedLamp> lamps;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::string &spec = chosen[g].empty() ? rest : chosen[g];
        if (spec.empty())
            throw Error({"light group '" + groups[g] + "' has no lamp", "lamp",
                         "expected " + groups[g] + "=LAMP, or a LAMP for all"});
        lamps.push_back(labelled(find_lamp(spec, folder, sample)));
    }
    return lamps;
}

std::vector<std::string> show_dyes(SpectralImage &image, std::span<const std::string> specs) {
    if (!specs.empty() && !image.depths)
        throw Error({"the dye of this picture is fixed", "dye",
                     "expected a picture of tryon, or of a scene with dye = \"any\""});
    std::vector<std::string> warnings;
    std::set<std::string> names;
    for (const std::string &spec : specs) {
        const NamedSpec one = split_spec(spec);
        if (!names.insert(one.name).second)
            throw Error({"two dyes for " + (one.name.empty() ? std::string("all open dyes")
                                                             : "'" + one.name + "'"),
                         "dye", "expected one; FABRIC=DYE names a fabric"});
        const NamedDye dye = find_dye(one.spec);
        set_dye(*image.depths, one.name, dye.spectrum);
        warnings.insert(warnings.end(), dye.warnings.begin(), dye.warnings.end());
    }
    return warnings;
}

std::string page_summary(const std::filesystem::path &file, const LivePage &page) {
    std::ostringstream line;
    line << file.string() << ": " << std::fixed << std::setprecision(1)
         << static_cast<double>(page.html.size()) / 1e6 << " MB, colours within CIEDE2000 "
         << std::setprecision(3);
    for (std::size_t i = 0; i < page.errors.size(); ++i)
        line << (i ? ", " : "") << page.errors[i].mean << " (mean) and " << page.errors[i].p99
             << " (99th percentile)";
    line << " of the file's\n";
    return line.str();
}

} // namespace tsuya::scene
