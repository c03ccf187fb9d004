#include "tsuya/sdk/tabulated.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "models/facets.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/great_circle.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr std::size_t kLeastLights = 4, kLeastViews = 6;
constexpr double kSameDirection = 1e-6; // in x, y and z
constexpr float kLowest = 1e-5f;        // cosine that stands for the horizon itself
constexpr float kAlmostOne = 1 - 1e-5f;
constexpr int kAlbedoSamples = 2048;

// A direction rounded, so that mirror images meet again.
using Key = std::pair<long, long>;
Key key_of(const glm::dvec3 &d) {
    return {std::lround(d.x / kSameDirection), std::lround(d.y / kSameDirection)};
}

std::vector<glm::dvec3> mirrors_of(Symmetry symmetry) {
    std::vector<glm::dvec3> all = {{1, 1, 1}};
    if (symmetry != Symmetry::none)
        all.push_back({-1, -1, 1});
    if (symmetry == Symmetry::orthotropic)
        all.insert(all.end(), {{1, -1, 1}, {-1, 1, 1}});
    return all;
}

struct ViewSum {
    glm::dvec3 to_viewer;
    double sum = 0, count = 0;
};
struct LightSum {
    glm::dvec3 to_light;
    std::map<Key, ViewSum> views{};
};

// All rows with their mirror images; those in one pair of directions together.
std::map<Key, LightSum> gather(const ReflectanceTable &table) {
    std::map<Key, LightSum> lights;
    for (const ReflectanceRow &row : table.rows)
        for (const glm::dvec3 &mirror : mirrors_of(table.symmetry)) {
            const glm::dvec3 l = mirror * row.to_light();
            const glm::dvec3 v = mirror * row.to_viewer();
            LightSum &light = lights.try_emplace(key_of(l), LightSum{.to_light = l}).first->second;
            ViewSum &view =
                light.views.try_emplace(key_of(v), ViewSum{.to_viewer = v}).first->second;
            view.sum += row.brdf_per_sr;
            view.count += 1;
        }
    return lights;
}

// rho for a regular value of 1
float unit_value(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    FacetTerms terms = FacetTerms::scaled(1, 1, to_light, to_viewer);
    return terms.per_sr(std::max(to_light.z, kLowest), std::max(to_viewer.z, kLowest));
}

} // namespace

TabulatedCore::TabulatedCore(const ReflectanceTable &table, const std::string &where,
                             const Progress &progress) {
    check_table(table, where);
    const std::map<Key, LightSum> gathered = gather(table);
    std::vector<glm::dvec3> to_lights;
    for (const auto &[key, light] : gathered) {
        Light made{.to_light = light.to_light};
        std::vector<glm::dvec3> to_viewers;
        for (const auto &[view_key, view] : light.views) {
            to_viewers.push_back(view.to_viewer);
            made.value.push_back(static_cast<float>(
                view.sum / view.count / unit_value(made.to_light, glm::vec3(view.to_viewer))));
        }
        if (to_viewers.size() < kLeastViews)
            throw Error({"a direction of light has " + detail::counted(to_viewers.size(), "view"),
                         where, "expected 6 or more of each"});
        made.views = RingGrid(to_viewers);
        to_lights.push_back(light.to_light);
        lights_.push_back(std::move(made));
    }
    if (lights_.size() < kLeastLights)
        throw Error({"the table has light from " + std::to_string(lights_.size()) +
                         " directions, mirror images among them",
                     where, "expected light from 4 or more, as `--directions paper` has it"});
    grid_ = RingGrid(to_lights);

    view_sampler_ = DirectionSampler([&](const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
        stop_if_asked(progress);
        return terms(to_light, to_viewer).cos(to_viewer.z, to_light.z);
    });
    light_sampler_ = DirectionSampler([&](const glm::vec3 &to_viewer, const glm::vec3 &to_light) {
        stop_if_asked(progress);
        return f_cos(to_light, to_viewer);
    });
    light_albedo_ = AlbedoTable(table.symmetry, [&](const glm::vec3 &to_light) {
        return mean_weight_of_views(*this, to_light, progress, kAlbedoSamples);
    });
    view_albedo_ = AlbedoTable(table.symmetry, [&](const glm::vec3 &to_viewer) {
        return mean_weight_of_lights(*this, to_viewer, progress, kAlbedoSamples);
    });
}

FacetTerms TabulatedCore::terms(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    const glm::vec3 basic = to_basic(to_light, to_viewer).basic;
    const RingGrid::Corners about = grid_.about(to_light);
    float sum = 0;
    for (int k = 0; k < about.count; ++k) {
        const RingGrid::Corner &corner = about.corner[k];
        const Light &light = lights_[corner.index];
        const glm::vec3 seen =
            corner.weight > kAlmostOne ? to_viewer : view_of_basic(light.to_light, basic).to_viewer;
        const RingGrid::Corners views = light.views.about(seen);
        for (int i = 0; i < views.count; ++i)
            sum += corner.weight * views.corner[i].weight * light.value[views.corner[i].index];
    }
    return FacetTerms::scaled(sum, 1, to_light, to_viewer);
}

float TabulatedCore::f_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return terms(to_light, to_viewer).cos(to_light.z, to_viewer.z);
}

WeighedLight TabulatedCore::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return {f_cos(to_light, to_viewer), light_sampler_.pdf(to_viewer, to_light)};
}

WeighedLight TabulatedCore::weigh_view(const glm::vec3 &to_light,
                                       const glm::vec3 &to_viewer) const {
    return {terms(to_light, to_viewer).cos(to_viewer.z, to_light.z),
            view_sampler_.pdf(to_light, to_viewer)};
}

glm::vec3 TabulatedCore::draw(const glm::vec3 &to_viewer, const glm::vec3 &u) const {
    return light_sampler_.sample(to_viewer, u);
}

glm::vec3 TabulatedCore::draw_view(const glm::vec3 &to_light, const glm::vec3 &u) const {
    return view_sampler_.sample(to_light, u);
}

float TabulatedCore::albedo(const glm::vec3 &to_light) const { return light_albedo_.at(to_light); }

float TabulatedCore::albedo_of_view(const glm::vec3 &to_viewer) const {
    return view_albedo_.at(to_viewer);
}

TabulatedCore::TabulatedCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<TabulatedCore>;

} // namespace tsuya
