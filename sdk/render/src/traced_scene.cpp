#include "traced_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "position_error.h"
#include "prepared_state.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// The shading normal is bent until the viewer is this much above its horizon.
constexpr float kLeastCosine = 1e-3f;

// Normals of the corners that are farther from the triangle's are those of no surface that bulges
// over it: beyond 45 degrees the triangle hides what it should let pass.
constexpr float kLeastCornerCosine = 0.7071f;

// [Hanika] From a point of a triangle to the smooth surface of which the corners have the normals:
// to the planes through the corners, where they lie above the point, by the weights of the corners.
// \param side 1, or -1 where the normals are those of the other side
// \param geometric normal of the triangle on the viewer's side
glm::vec3 bulge_at(const glm::vec3 &point, const std::array<glm::vec3, 3> &corner,
                   const std::array<glm::vec3, 3> &normal, float side, const glm::vec3 &barycentric,
                   const glm::vec3 &geometric) {
    glm::vec3 sum(0);
    for (int i = 0; i < 3; ++i) {
        const auto c = static_cast<std::size_t>(i);
        if (!(side * glm::dot(normal[c], geometric) > kLeastCornerCosine))
            return glm::vec3(0);
        const float below = side * glm::dot(corner[c] - point, normal[c]);
        sum += barycentric[i] * side * std::max(0.0f, below) * normal[c];
    }
    return sum;
}

// The middle of the scene, rounded to a part of its size: still objects keep their places about it
// where others move.
glm::dvec3 middle_of(const Scene &scene) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const Object &object : scene.objects)
        for (const glm::dvec3 &p : scene.surfaces[object.surface.value].position) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const glm::dvec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const double size = std::max({half.x, half.y, half.z});
    if (!(size > 0))
        return middle;
    // A power of two: a scene that is scaled by one is rounded as before
    const double step = std::ldexp(0.5, std::ilogb(size));
    return step * glm::round(middle / step);
}

double radius_of(const Scene &scene, const glm::dvec3 &centre) {
    double radius2 = 0;
    for (const Object &object : scene.objects)
        for (const glm::dvec3 &p : scene.surfaces[object.surface.value].position)
            radius2 = std::max(radius2, glm::dot(p - centre, p - centre));
    return std::sqrt(radius2);
}

ChannelValues values_of(const Spectrum &spectrum, const SpectralBasis &basis) {
    const std::vector<float> projected = project(spectrum, basis);
    ChannelValues values{};
    std::copy(projected.begin(), projected.end(), values.begin());
    return values;
}

// Of a fabric_at_depths.
ChannelValues values_at_depths(const Spectrum &spectrum, int channels) {
    ChannelValues values{};
    for (int k = 0; k < channels; ++k)
        values[static_cast<std::size_t>(k)] = static_cast<float>(spectrum.at(place_of(k)));
    return values;
}

Colours colours_of(const Material &material, const SpectralBasis &basis, bool at_depths) {
    const auto values = [&](const Spectrum &spectrum) {
        return at_depths ? values_at_depths(spectrum, basis.count) : values_of(spectrum, basis);
    };
    Colours c{values(material.dye),       values(material.transmittance),
              values(material.weft_tint), values(material.warp_tint),
              values(material.weft_body), values(material.warp_body)};
    // Least squares may leave the range where a spectrum has a steep edge
    for (ChannelValues *const colour : {&c.dye, &c.weft, &c.warp})
        for (float &value : *colour)
            value = std::min(value, 1.0f);
    for (std::size_t k = 0; k < c.dye.size(); ++k) {
        c.weft_body[k] = std::min(c.weft_body[k], 1 - c.dye[k]);
        c.warp_body[k] = std::min(c.warp_body[k], 1 - c.dye[k]);
        c.transmittance[k] =
            std::min(c.transmittance[k], 1 - c.dye[k] - std::max(c.weft_body[k], c.warp_body[k]));
    }
    return c;
}

// Of the fabric's own back, in the frame that has the weft in the place of the warp.
Colours exchanged(Colours c) {
    std::swap(c.weft, c.warp);
    std::swap(c.weft_body, c.warp_body);
    return c;
}

MeanColours means_of(const Colours &c, int channels) {
    const auto mean = [&](const ChannelValues &v) {
        return std::accumulate(v.begin(), v.begin() + channels, 0.0f) /
               static_cast<float>(channels);
    };
    return {mean(c.dye), mean(c.transmittance), 0.5f * (mean(c.weft) + mean(c.warp)),
            0.5f * (mean(c.weft_body) + mean(c.warp_body))};
}

} // namespace

TracedScene::TracedScene(const Scene &the_scene, const Plan &the_plan, const SpectralBasis &basis,
                         PreparedScene &prepared, bool keep, const Progress &progress)
    : scene(the_scene), plan(the_plan), centre(middle_of(the_scene)),
      accelerator(prepared.state_->accelerator),
      lights(the_scene, the_plan, centre, radius_of(the_scene, centre)),
      camera(the_scene.camera, centre) {
    const PhaseClock of_bvh;
    prepared.state_->accelerator.update(scene, centre, keep, progress);
    phases.push_back(of_bvh.end("bvh"));
    const PhaseClock of_tables;
    prepare_prints(basis);
    prepare_sides();
    prepare_fabrics(basis, prepared.state_->materials, progress);
    phases.push_back(of_tables.end("tables"));
}

void TracedScene::prepare_prints(const SpectralBasis &basis) {
    channels_ = basis.count;
    if (scene.prints.empty() && scene.opacities.empty())
        return;
    for (const Texture &texture : scene.textures)
        textures_.emplace_back(texture);
    for (const Print &print : scene.prints)
        prints_.emplace_back(print, textures_, basis);
    for (const auto &[picture, placement] : scene.opacities) {
        const MipTexture &texture = textures_[picture.value];
        opacities_.push_back(
            {&texture, ClothPlace(placement, texture.width_over_height()), placement.repeat});
    }
    for (const Fabric &fabric : scene.fabrics)
        dyes_.push_back({values_of(fabric.colours.dye_of_weft(), basis),
                         values_of(fabric.colours.dye_of_warp(), basis)});
}

std::uint32_t TracedScene::cloth_of(const Cloth &cloth) {
    const auto known = std::find(cloths_.begin(), cloths_.end(), cloth);
    const auto index = static_cast<std::uint32_t>(known - cloths_.begin());
    if (known == cloths_.end())
        cloths_.push_back(cloth);
    return index;
}

void TracedScene::prepare_sides() {
    for (std::uint32_t i = 0; i < scene.fabrics.size(); ++i)
        cloths_.push_back({i, {}});
    for (const Object &object : scene.objects) {
        const Surface &surface = scene.surfaces[object.surface.value];
        const auto sides = [&](const auto &of) {
            const auto number = [](const auto &index) {
                return index ? std::optional(index->value) : std::nullopt;
            };
            const std::uint32_t face = cloth_of({of.fabric.value, number(of.print)});
            Sides made{face, face, !of.back && !surface.warp.empty(), {}};
            if (of.back)
                made.back = cloth_of({of.back->value, number(of.back_print)});
            if (of.opacity)
                made.opacity = of.opacity->value;
            return made;
        };
        std::vector<Sides> of_panel(object.panels.empty() ? 1 : panel_count(surface),
                                    sides(object));
        for (const PanelFabric &panel : object.panels)
            of_panel[panel.panel] = sides(panel);
        sides_.push_back(std::move(of_panel));
    }
}

void TracedScene::prepare_fabrics(const SpectralBasis &basis, KeptMaterials &materials,
                                  const Progress &progress) {
    std::vector<VaryingColours> varying;
    if (!plan.dyes.empty()) {
        varying = varying_colours(scene).fabrics;
        find_most_dye(varying, materials, progress);
    }
    const std::optional<DyeDepths> depths = depths_of(plan.dyes, most_dye, basis.count);
    for (const Cloth &cloth : cloths_) {
        if (progress.stopped())
            throw Interrupted("stopped while the fabrics were prepared");
        const Fabric &fabric = scene.fabrics[cloth.fabric];
        const std::string where = "fabrics." + fabric.name;
        const bool idle = !plan.fabrics[cloth.fabric];
        const Fabric shown = cloth.print ? as_printed(cloth, basis)
                             : depths    ? fabric_at_depths(fabric, varying[cloth.fabric], *depths)
                                         : fabric;
        const Material material = idle ? Material{} : materials.resolve(shown, where, progress);
        colours.push_back(colours_of(material, basis, depths.has_value()));
        const MeanColours means = means_of(colours.back(), basis.count);
        shading.emplace_back(material, means, plan.keeps_idle_parts);
        wide_shading.emplace_back();
        if (const auto wide =
                plan.widens && !idle ? materials.widened(shown, material, progress) : std::nullopt)
            wide_shading.back().emplace(*wide, means, plan.keeps_idle_parts);
        for (Problem &warning : weave_warnings(material, where))
            warnings.push_back(std::move(warning));
        of_dye_.push_back(material.of_dye);
        weft_share_.push_back(static_cast<float>(material.weft_share));
    }
    for (std::size_t i = 0; i < cloths_.size(); ++i)
        colours.push_back(exchanged(colours[i]));
}

void TracedScene::find_most_dye(const std::vector<VaryingColours> &varying,
                                KeptMaterials &materials, const Progress &progress) {
    const std::optional<DyeDepths> whole = depths_of(plan.dyes, most_dye, plan.channels);
    for (std::size_t i = 0; i < varying.size(); ++i)
        for (const auto &dye : {varying[i].weft_dye, varying[i].warp_dye})
            if (dye && plan.dyes[*dye].open) {
                Fabric fabric = fabric_at_depths(scene.fabrics[i], varying[i], *whole);
                fabric.weave.reset(); // from far it shows as much
                const Material material =
                    materials.resolve(fabric, "fabrics." + fabric.name, progress);
                most_dye[*dye] = std::min(most_dye[*dye], material.most_dye);
            }
}

// With the mean of the print and of its own as its dye: so it has the parts that both need, samples
// them in due proportion, and the dyes of a shot cloth stay apart.
Fabric TracedScene::as_printed(const Cloth &cloth, const SpectralBasis &basis) const {
    Fabric fabric = scene.fabrics[cloth.fabric];
    const auto mean = [&](const ChannelValues &own) {
        ChannelValues dye = own;
        prints_[*cloth.print].mean_dye(dye);
        Spectrum spectrum{{}, {}};
        for (int k = 0; k < basis.count; ++k) {
            spectrum.wavelength_nm.push_back(basis.centre_nm(k));
            const auto i = static_cast<std::size_t>(k);
            spectrum.value.push_back(
                static_cast<double>(std::clamp(0.5f * (own[i] + dye[i]), 0.0f, 1.0f)));
        }
        return spectrum;
    };
    FabricColours &dyed = fabric.colours;
    const bool one_dye = dyed.dye_of_weft() == dyed.dye_of_warp();
    const Spectrum weft = mean(dyes_[cloth.fabric].weft), warp = mean(dyes_[cloth.fabric].warp);
    dyed.dye_all(weft);
    if (!one_dye) {
        dyed.weft_dye = weft;
        dyed.warp_dye = warp;
    }
    return fabric;
}

Colours TracedScene::printed(const SurfacePoint &point, float distance, bool seen_by_camera) const {
    // What a bounce sees is blurred: an angle of some degrees is fine enough
    constexpr float kBounceAngle = 0.05f;
    const Cloth &cloth = cloths_[point.cloth];
    Colours c = colours[point.colours];
    Dyes dyes = dyes_[cloth.fabric];
    prints_[*cloth.print].dye(
        point.uv, seen_by_camera ? camera.pixel_width(distance) : distance * kBounceAngle,
        dyes.weft, dyes.warp);
    if (point.colours != point.cloth) // its own back
        std::swap(dyes.weft, dyes.warp);
    const std::vector<glm::vec2> &of_dye = of_dye_[point.cloth];
    const float steps = static_cast<float>(of_dye.size() - 1);
    const auto albedos = [&](float dye) {
        const float at = std::clamp(dye, 0.0f, 1.0f) * steps;
        const auto below = std::min(static_cast<std::size_t>(at), of_dye.size() - 2);
        return glm::mix(of_dye[below], of_dye[below + 1], at - static_cast<float>(below));
    };
    const float share =
        point.colours == point.cloth ? weft_share_[point.cloth] : 1 - weft_share_[point.cloth];
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels_); ++k) {
        const glm::vec2 weft = albedos(dyes.weft[k]), warp = albedos(dyes.warp[k]);
        c.dye[k] = std::min(glm::mix(warp.x, weft.x, share), 1.0f);
        c.weft_body[k] = std::min(weft.y, 1 - c.dye[k]);
        c.warp_body[k] = std::min(warp.y, 1 - c.dye[k]);
        c.transmittance[k] =
            std::min(c.transmittance[k], 1 - c.dye[k] - std::max(c.weft_body[k], c.warp_body[k]));
    }
    return c;
}

const TracedScene::Sides &TracedScene::sides_at(const Hit &hit) const {
    const std::vector<Sides> &of_panel = sides_[hit.object];
    return of_panel.size() == 1 ? of_panel.front() : of_panel[panel_of(hit)];
}

float TracedScene::opacity(const Hit &hit, float footprint) const {
    const Sides &sides = sides_at(hit);
    if (!sides.opacity)
        return 1;
    const auto &[picture, place, repeat] = opacities_[*sides.opacity];
    const float cover =
        picture->at(place.at(uv_at(hit)), footprint * place.widths_per_metre(), repeat).w;
    constexpr float kWhole = 0.9999f; // what interpolation leaves of 1
    return cover > kWhole ? 1.0f : cover;
}

std::uint32_t TracedScene::panel_of(const Hit &hit) const {
    const Surface &surface = surface_of(hit);
    return surface.panel.empty() ? 0 : surface.panel[hit.triangle];
}

glm::vec3 TracedScene::weft_at(const Hit &hit, const SurfacePoint &point) const {
    const Surface &surface = surface_of(hit);
    if (surface.warp.empty())
        return glm::vec3(0);
    const glm::uvec3 t = surface.triangle[hit.triangle];
    const glm::vec3 weft = surface.weft.empty() ? glm::cross(point.warp, point.frame.normal)
                                                : hit.barycentric.x * surface.weft[t.x] +
                                                      hit.barycentric.y * surface.weft[t.y] +
                                                      hit.barycentric.z * surface.weft[t.z];
    const float length = glm::length(weft);
    return length > 0 ? weft / length : weft;
}

glm::vec2 TracedScene::uv_at(const Hit &hit) const {
    const Surface &surface = surface_of(hit);
    if (surface.uv.empty())
        return glm::vec2(0);
    const glm::uvec3 t = surface.triangle[hit.triangle];
    return hit.barycentric.x * surface.uv[t.x] + hit.barycentric.y * surface.uv[t.y] +
           hit.barycentric.z * surface.uv[t.z];
}

glm::vec3 TracedScene::behind(const glm::vec3 &direction, const Hit &hit) const {
    const Surface &surface = scene.surfaces[scene.objects[hit.object].surface.value];
    const glm::uvec3 t = surface.triangle[hit.triangle];
    const std::vector<glm::vec3> &positions = accelerator.positions(hit.object);
    const glm::vec3 point = hit.barycentric.x * positions[t.x] +
                            hit.barycentric.y * positions[t.y] + hit.barycentric.z * positions[t.z];
    const glm::vec3 normal = hit.face_normal / glm::length(hit.face_normal);
    const float error = position_error({positions[t.x], positions[t.y], positions[t.z]}, normal);
    return point + (glm::dot(normal, direction) > 0 ? error : -error) * normal;
}

SurfacePoint TracedScene::point(const glm::vec3 &direction, const Hit &hit) const {
    const Object &object = scene.objects[hit.object];
    const Surface &surface = scene.surfaces[object.surface.value];
    const glm::uvec3 t = surface.triangle[hit.triangle];
    const auto interpolate = [&](const std::vector<glm::vec3> &values) {
        return hit.barycentric.x * values[t.x] + hit.barycentric.y * values[t.y] +
               hit.barycentric.z * values[t.z];
    };
    SurfacePoint point;
    // From the corners: more exact than along the ray
    const std::vector<glm::vec3> &positions = accelerator.positions(hit.object);
    point.position = interpolate(positions);
    const Sides &sides = sides_at(hit);
    glm::vec3 geometric = hit.face_normal / glm::length(hit.face_normal);
    const bool behind = glm::dot(geometric, direction) > 0;
    if (behind)
        geometric = -geometric;
    const bool exchanged = behind && sides.own_back;
    point.cloth = behind ? sides.back : sides.face;
    point.colours = point.cloth + (exchanged ? static_cast<std::uint32_t>(cloths_.size()) : 0);
    if (is_printed(point))
        point.uv = uv_at(hit);
    glm::vec3 normal = interpolate(surface.normal);
    const float length = glm::length(normal);
    normal = length > 0 ? normal / length : geometric;
    const float side = glm::dot(normal, geometric) < 0 ? -1.0f : 1.0f;
    normal *= side;
    // A viewer below the shading normal's horizon: bend the normal up to the viewer
    if (const float cosine = -glm::dot(normal, direction); cosine < kLeastCosine)
        normal = glm::normalize(normal - (kLeastCosine - cosine) * direction);
    point.geometric_normal = geometric;
    const std::array corners{positions[t.x], positions[t.y], positions[t.z]};
    point.error = position_error(corners, geometric);
    point.bulge = bulge_at(point.position, corners,
                           {surface.normal[t.x], surface.normal[t.y], surface.normal[t.z]}, side,
                           hit.barycentric, geometric);
    point.frame =
        surface.warp.empty() ? make_frame(normal) : make_frame(normal, interpolate(surface.warp));
    point.warp = point.frame.warp;
    if (exchanged)
        point.frame = {.weft = point.frame.warp, .warp = -point.frame.weft, .normal = normal};
    return point;
}

} // namespace tsuya
