#include "aov.h"

#include <algorithm>
#include <array>

#include "cryptomatte.h"
#include "dye_channels.h"
#include "tsuya/sdk/plan.h"

namespace tsuya {
namespace {

// What an AOV is made of.
enum class Source { first_hit, light, film };

struct Entry {
    Aov aov;
    const char *name; // of ids that of their Cryptomatte layer
    Source source;
};

constexpr std::array<Entry, 17> kEntries{{
    {Aov::coverage, "coverage", Source::first_hit},
    {Aov::garment, "garment", Source::first_hit},
    {Aov::depth, "depth", Source::first_hit},
    {Aov::normal, "normal", Source::first_hit},
    {Aov::warp, "warp", Source::first_hit},
    {Aov::weft, "weft", Source::first_hit},
    {Aov::uv, "uv", Source::first_hit},
    {Aov::albedo, "albedo", Source::first_hit},
    {Aov::direct, "direct", Source::light},
    {Aov::indirect, "indirect", Source::light},
    {Aov::surface, "surface", Source::light},
    {Aov::body, "body", Source::light},
    {Aov::samples, "samples", Source::film},
    {Aov::error, "error", Source::film},
    {Aov::object_ids, "CryptoObject", Source::first_hit},
    {Aov::fabric_ids, "CryptoFabric", Source::first_hit},
    {Aov::panel_ids, "CryptoPanel", Source::first_hit},
}};

const Entry &entry_of(Aov aov) {
    return *std::find_if(kEntries.begin(), kEntries.end(),
                         [&](const Entry &entry) { return entry.aov == aov; });
}

std::string name_or(const std::string &name, const char *kind, std::size_t i) {
    return name.empty() ? kind + std::to_string(i) : name;
}

} // namespace

std::vector<std::string> aov_names() {
    std::vector<std::string> names;
    for (const Entry &entry : kEntries)
        names.emplace_back(entry.name);
    return names;
}

std::vector<Aov> aovs_of(const RenderSettings &settings) {
    std::vector<Aov> aovs;
    for (const std::string &name : settings.aovs)
        aovs.push_back(std::find_if(kEntries.begin(), kEntries.end(), [&](const Entry &entry) {
                           return entry.name == name;
                       })->aov);
    return aovs;
}

std::vector<std::string> channels_of(Aov aov, const Scene &scene, int channels) {
    const std::vector<DyeVariable> dyes = planned_dyes(scene);
    const SpectralBasis basis = basis_of(dyes, channels);
    const bool at_depths = !dyes.empty();
    std::vector<std::string> names;
    switch (aov) {
    case Aov::normal:
    case Aov::warp:
    case Aov::weft:
        return {"X", "Y", "Z"};
    case Aov::uv:
        return {"U", "V"};
    case Aov::depth:
        return {"Z"};
    case Aov::samples:
    case Aov::error:
        return {"Y"};
    case Aov::coverage:
    case Aov::garment:
        return {"A"};
    case Aov::albedo:
        return channel_names(basis, at_depths);
    case Aov::direct:
    case Aov::indirect:
    case Aov::surface:
    case Aov::body:
        for (const std::string &group : scene.light_groups)
            for (const std::string &name : channel_names(basis, at_depths))
                names.push_back(group + '.' + name);
        return names;
    case Aov::object_ids:
    case Aov::fabric_ids:
    case Aov::panel_ids:
        break;
    }
    return id_channels(entry_of(aov).name);
}

bool is_of_first_hit(Aov aov) { return entry_of(aov).source == Source::first_hit; }

bool is_part_of_light(Aov aov) { return entry_of(aov).source == Source::light; }

bool is_ids(Aov aov) {
    return aov == Aov::object_ids || aov == Aov::fabric_ids || aov == Aov::panel_ids;
}

bool asks_for(const RenderSettings &settings, bool (*kind)(Aov)) {
    const std::vector<Aov> aovs = aovs_of(settings);
    return std::any_of(aovs.begin(), aovs.end(), kind);
}

std::vector<std::string> id_names(Aov aov, const Scene &scene) {
    std::vector<std::string> names;
    if (aov == Aov::fabric_ids)
        for (std::size_t i = 0; i < scene.fabrics.size(); ++i)
            names.push_back(name_or(scene.fabrics[i].name, "fabric", i));
    else
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const std::string object = name_or(scene.objects[i].name, "object", i);
            if (aov == Aov::object_ids) {
                names.push_back(object);
                continue;
            }
            const Surface &surface = scene.surfaces[scene.objects[i].surface.value];
            for (std::size_t p = 0; p < panel_count(surface); ++p)
                names.push_back(p < surface.panel_name.size()
                                    ? object + "/" + name_or(surface.panel_name[p], "panel", p)
                                    : object);
        }
    return names;
}

std::vector<std::uint32_t> first_panels(const Scene &scene) {
    std::vector<std::uint32_t> first;
    std::uint32_t count = 0;
    for (const Object &object : scene.objects) {
        first.push_back(count);
        count += static_cast<std::uint32_t>(panel_count(scene.surfaces[object.surface.value]));
    }
    return first;
}

} // namespace tsuya
