#include "tsuya/sdk/plan.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>

#include "aov.h"
#include "dye_channels.h"
#include "film.h"
#include "light_reach.h"
#include "lights.h"
#include "near_cloths.h"
#include "plan_features.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/fabric_fields.h"
#include "tsuya/sdk/render.h"

namespace tsuya {
namespace {

std::string name_in(const Scene &scene, std::size_t light) {
    const std::string &name = name_of(scene.lights[light]);
    return name.empty() ? "lights[" + std::to_string(light) + "]" : "'" + name + "'";
}

// `'a', 'b' and 12 more`
std::string some_of(std::span<const std::string> names) {
    constexpr std::size_t kShown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
        text += (i > 0 ? ", " : "") + names[i];
    return names.size() > kShown ? text + " and " + std::to_string(names.size() - kShown) + " more"
                                 : text;
}

// The light is seen, or what it hides, though it be dark.
bool is_thing(const Light &light) {
    return std::visit(
        [](const auto &l) {
            if constexpr (requires { l.behaviour; })
                return l.behaviour.visible || l.behaviour.blocks;
            else
                return false;
        },
        light);
}

bool is_visible(const Light &light) {
    return std::visit(
        [](const auto &l) {
            if constexpr (requires { l.behaviour; })
                return l.behaviour.visible;
            else if constexpr (requires { l.visible; })
                return l.visible;
            else
                return false;
        },
        light);
}

// Makes the plan of a scene, part by part.
class Planner {
  public:
    Planner(const Scene &scene, const RenderSettings &settings)
        : scene_(scene), settings_(settings) {}

    Plan make() {
        channels();
        parts();
        bounces();
        weaves();
        tables();
        lights();
        environment();
        cloth();
        results();
        std::stable_sort(p.features.begin(), p.features.end(), [](const auto &a, const auto &b) {
            return place_of(a.name) < place_of(b.name);
        });
        return std::move(p);
    }

  private:
    static std::size_t place_of(std::string_view name) {
        return static_cast<std::size_t>(
            std::find(kFeatureNames.begin(), kFeatureNames.end(), name) - kFeatureNames.begin());
    }
    void tell(FeatureId id, bool on, std::string why, std::optional<Saving> saves = {}) {
        if (saves && saves->of_sample < cost::kLeastShare)
            saves->of_sample = 0;
        p.features.push_back({std::string(name_of(id)), on, std::move(why), saves});
    }
    // It is done though it is idle.
    bool keeps(FeatureId id) const {
        return !settings_.skip || std::find(settings_.keep.begin(), settings_.keep.end(),
                                            name_of(id)) != settings_.keep.end();
    }
    // Tells of what is left out where it is idle. \return whether it is
    bool leave_out(FeatureId id, bool idle, const std::string &why_idle, const std::string &why_not,
                   std::optional<Saving> saves = {}) {
        const bool off = idle && !keeps(id);
        tell(id, !off,
             off    ? why_idle
             : idle ? "it is kept, though " + why_idle
                    : why_not,
             off ? saves : std::nullopt);
        return off;
    }
    // What is there where it is asked for or the scene has it.
    void note(FeatureId id, bool on, const std::string &why, const std::string &why_not,
              const Saving &saves) {
        tell(id, on, on ? why : why_not, on ? std::nullopt : std::optional(saves));
    }

    void channels() {
        p.channels = as_planned(scene_, settings_).channels;
        p.dyes = planned_dyes(scene_);
        std::string names;
        for (const DyeVariable &dye : p.dyes)
            names += (names.empty() ? "'" : " and '") + dye.name + "'";
        tell(FeatureId::dye_depths, !p.dyes.empty(),
             p.dyes.empty() ? "no dye is open" : "the colours that vary are " + names);
    }

    bool is_open(std::size_t fabric) const {
        return std::any_of(scene_.open_dyes.begin(), scene_.open_dyes.end(),
                           [&](FabricIndex open) { return open.value == fabric; });
    }

    // A row for what some of the fabrics have. \return whether any has it
    template <class Has> bool part(FeatureId id, std::optional<Saving> saves, Has &&has) {
        std::vector<std::string> without;
        std::size_t used = 0;
        for (std::size_t i = 0; i < scene_.fabrics.size(); ++i) {
            if (!p.fabrics[i])
                continue;
            ++used;
            if (!has(i))
                without.push_back("'" + scene_.fabrics[i].name + "'");
        }
        const bool any = without.size() < used;
        leave_out(id, !any, "no fabric has it",
                  without.empty() ? "every fabric has it"
                                  : "all fabrics have it but " + some_of(without),
                  saves);
        p.keeps_idle_parts |= keeps(id);
        return any;
    }

    void parts() {
        const std::vector<bool> used = fabrics_in_use(scene_);
        p.fabrics = used;
        const auto transmits = [&](std::size_t i) {
            return scene_.fabrics[i].colours.transmittance.any_above_zero();
        };
        // Of a specular part without weight no time was measured
        p.any_specular = part(FeatureId::specular, std::nullopt,
                              [&](std::size_t i) { return has_specular(scene_.fabrics[i]); });
        p.any_diffuse = part(FeatureId::diffuse, Saving{}, [&](std::size_t i) {
            return scene_.fabrics[i].colours.any_dye() || is_open(i) || transmits(i);
        });
        std::size_t thin = 0;
        for (std::size_t i = 0; i < used.size(); ++i)
            thin += used[i] && transmits(i) ? 1 : 0;
        tell(FeatureId::transmittance, thin > 0,
             thin > 0 ? "light goes through " + detail::counted(thin, "fabric")
                      : "no light goes through a fabric");
    }

    void bounces() {
        const bool scatters = p.any_specular || p.any_diffuse;
        p.max_bounces = settings_.max_bounces;
        if (settings_.max_bounces == 0)
            tell(FeatureId::bounces, false, "direct light alone is asked for");
        else if (leave_out(FeatureId::bounces, !scatters, "nothing scatters light",
                           "up to " + std::to_string(settings_.max_bounces)))
            p.max_bounces = 0;
        p.widens = settings_.widen_after_diffuse && p.max_bounces > 0;
        note(FeatureId::wider_lobes, p.widens, "after diffuse scattering",
             settings_.widen_after_diffuse ? "there are no bounces" : "none are asked for",
             {.of_sample = p.max_bounces > 0 ? cost::kWiderLobes : 0});
    }

    void tables() {
        std::vector<std::string> idle, sharing;
        std::set<std::uint64_t> made;
        for (std::size_t i = 0; i < scene_.fabrics.size(); ++i) {
            const Fabric &fabric = scene_.fabrics[i];
            if (!p.fabrics[i])
                idle.push_back("'" + fabric.name + "'");
            else if (reflects(fabric.specular) && !made.insert(hash_of(fabric.specular)).second)
                sharing.push_back("'" + fabric.name + "'");
        }
        if (keeps(FeatureId::idle_tables)) {
            p.fabrics.assign(p.fabrics.size(), true);
            tell(FeatureId::idle_tables, true, "they are kept");
        } else
            tell_tables(FeatureId::idle_tables, false, idle,
                        idle.empty() ? "every fabric dresses something" : "nothing is dressed in ");
        tell_tables(FeatureId::own_tables, sharing.empty(), sharing,
                    sharing.empty() ? "no two have the same specular part"
                                    : "another has the specular part of ");
    }

    void tell_tables(FeatureId id, bool on, const std::vector<std::string> &names,
                     const std::string &why) {
        const auto n = static_cast<double>(names.size());
        const Saving saves{.seconds = n * cost::kTableSeconds, .bytes = n * cost::kTableBytes};
        tell(id, on, why + some_of(names), names.empty() ? std::nullopt : std::optional(saves));
    }

    void weaves() {
        p.near_cloths = near_cloths(scene_, p.fabrics);
        std::string texts;
        for (const NearCloth &cloth : p.near_cloths)
            texts += (texts.empty() ? "" : "; ") + text_of(cloth);
        tell(FeatureId::weave,
             std::any_of(p.near_cloths.begin(), p.near_cloths.end(),
                         [](const NearCloth &cloth) { return cloth.within > 0; }),
             texts.empty() ? "no fabric has one" : texts);
    }

    static std::uint64_t hash_of(const Specular &specular) {
        detail::FieldHasher hasher;
        hasher.add(specular);
        return hasher.result();
    }

    void lights() {
        std::vector<std::size_t> lit;
        std::vector<std::string> dark, far;
        for (std::size_t i = 0; i < scene_.lights.size(); ++i)
            if (emission_of(scene_.lights[i]) > 0 || is_thing(scene_.lights[i]) ||
                keeps(FeatureId::dark_lights))
                lit.push_back(i);
            else
                dark.push_back(name_in(scene_, i));
        const std::vector<std::string> beyond = out_of_reach(scene_);
        for (const std::size_t i : lit)
            if (beyond[i].empty() || is_thing(scene_.lights[i]) || keeps(FeatureId::far_lights))
                p.lights.push_back(i);
            else
                far.push_back(name_in(scene_, i) + " " + beyond[i]);
        tell_lights(FeatureId::dark_lights, dark, "there are none", cost::kDarkLight);
        tell_lights(FeatureId::far_lights, far, "every light reaches a surface", 0);
        const bool choose = p.lights.size() > kFewLights;
        tell(FeatureId::light_choice, choose,
             choose
                 ? "at each point few of " + std::to_string(p.lights.size()) + " lights are sampled"
                 : "each light is sampled at what the camera sees");
        p.lights_seen = !settings_.alpha;
        const bool visible = std::any_of(scene_.lights.begin(), scene_.lights.end(), is_visible);
        tell(FeatureId::lights_seen, p.lights_seen && visible,
             !p.lights_seen ? "the picture has alpha"
             : visible      ? "the camera sees lights"
                            : "none is visible to the camera");
    }

    void tell_lights(FeatureId id, const std::vector<std::string> &left_out,
                     const std::string &none, double of_one) {
        if (keeps(id))
            tell(id, true, "they are kept");
        else
            tell(id, false, left_out.empty() ? none : some_of(left_out),
                 of_lights(left_out.size(), of_one));
    }

    // Of few lights, each of which is sampled where the camera looks.
    std::optional<Saving> of_lights(std::size_t left_out, double of_one) const {
        const std::size_t all = p.lights.size() + left_out;
        if (left_out == 0 || all > kFewLights)
            return std::nullopt;
        return Saving{.of_sample = static_cast<double>(left_out) * of_one};
    }

    void environment() {
        const bool there = scene_.environment.has_value();
        p.environment =
            there &&
            !leave_out(FeatureId::environment, scene_.environment->radiance == 0, "it is dark",
                       "it shines", Saving{.of_sample = cost::kEnvironmentSampling});
        if (!there)
            tell(FeatureId::environment, false, "there is none");
        const bool even = p.environment && !scene_.environment->picture;
        tell(FeatureId::environment_rays, p.environment && !even,
             !p.environment ? "there is no environment"
             : even         ? "it is even, and the surfaces' own sampling meets it"
                            : "it has a picture",
             even ? std::optional(Saving{.of_sample = cost::kEnvironmentSampling}) : std::nullopt);
        // With holes, a ray to the environment looks for what it meets
        p.short_last_rays = leave_out(
            FeatureId::last_rays, !p.environment || scene_.opacities.empty(),
            p.environment ? "after the last point of a path it counts whether a ray meets anything"
                          : "after the last point of a path lights alone count",
            "cloth with holes stands before an environment",
            Saving{.of_sample = (p.environment ? 0 : cost::kWholeLastRay) / (1 + p.max_bounces)});
    }

    void cloth() {
        std::size_t printed = 0, panels = 0;
        const auto count = [&](const auto &of) {
            ++panels;
            printed += of.print || of.back_print ? 1 : 0;
        };
        for (const Object &object : scene_.objects) {
            count(object);
            std::for_each(object.panels.begin(), object.panels.end(), count);
        }
        note(FeatureId::prints, printed > 0,
             "looked up on " + std::to_string(printed) + " of " + detail::counted(panels, "piece") +
                 " of cloth",
             "no cloth is printed", {.of_sample = cost::kPrints});
        note(FeatureId::holes, !scene_.opacities.empty(), "looked for along every ray",
             "no cloth has any", {.of_sample = cost::kHoles});
        tell(FeatureId::lens, scene_.camera.lens.has_value(),
             scene_.camera.lens ? "what is out of focus is blurred" : "the camera has none");
    }

    double bytes_with(const RenderSettings &other) const {
        RenderSettings now = settings_, then = other;
        now.channels = then.channels = p.channels;
        return static_cast<double>(Film::bytes_needed(scene_, then)) -
               static_cast<double>(Film::bytes_needed(scene_, now));
    }

    void results() {
        RenderSettings with = settings_;
        with.aovs = aov_names();
        note(FeatureId::aovs, !settings_.aovs.empty(),
             detail::counted(settings_.aovs.size(), "is asked for", "are asked for"),
             "none are asked for", {.of_sample = cost::kAovs, .bytes = bytes_with(with)});
        note(FeatureId::light_parts, asks_for(settings_, is_part_of_light), "they are asked for",
             "none are asked for", {.of_sample = cost::kLightParts});
        with = settings_;
        with.alpha = true;
        note(FeatureId::alpha, settings_.alpha, "it is asked for", "it is not asked for",
             {.of_sample = cost::kAlpha, .bytes = bytes_with(with)});
        with = settings_;
        with.denoise = true;
        note(FeatureId::denoiser, settings_.denoise, "it is asked for", "it is not asked for",
             {.bytes = bytes_with(with)});
    }

    const Scene &scene_;
    const RenderSettings &settings_;
    Plan p{};
};

} // namespace

std::vector<std::string> feature_names() { return {kFeatureNames.begin(), kFeatureNames.end()}; }

const Feature &Plan::feature(std::string_view name) const {
    for (const Feature &feature : features)
        if (feature.name == name)
            return feature;
    throw std::out_of_range("no feature '" + std::string(name) + "'");
}

Plan plan(const Scene &scene, const RenderSettings &settings) {
    return Planner(scene, settings).make();
}

} // namespace tsuya
