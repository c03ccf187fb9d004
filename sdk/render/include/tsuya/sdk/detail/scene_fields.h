#pragma once
/// \file
/// The fields of a scene and of the settings of a render, see fields.h. What is not `in_picture`
/// may change between an interrupted render and its resumption.

#include "tsuya/sdk/detail/fabric_fields.h"
#include "tsuya/sdk/render.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

template <class F, class Tag> void each_field(F &&f, Index<Tag> &index) {
    f(detail::Field{"value"}, index.value);
}
template <class F, class Tag> void each_field(F &&f, const Index<Tag> &index) {
    f(detail::Field{"value"}, index.value);
}

template <class F, detail::MaybeConst<Surface> T> void each_field(F &&f, T &surface) {
    auto &[position, normal, warp, weft, uv, triangle, panel, panel_name] = surface;
    f(detail::Field{"position"}, position);
    f(detail::Field{"normal"}, normal);
    f(detail::Field{"warp"}, warp);
    f(detail::Field{"weft"}, weft);
    f(detail::Field{"uv"}, uv);
    f(detail::Field{"triangle"}, triangle);
    f(detail::Field{"panel"}, panel);
    f(detail::Field{.key = "panel_name", .in_picture = false}, panel_name);
}

template <class F, detail::MaybeConst<Texture> T> void each_field(F &&f, T &texture) {
    auto &[width, height, channels, data] = texture;
    f(detail::Field{"width"}, width);
    f(detail::Field{"height"}, height);
    f(detail::Field{"channels"}, channels);
    f(detail::Field{"data"}, data);
}

template <class F, detail::MaybeConst<Placement> T> void each_field(F &&f, T &placement) {
    auto &[width, origin, turn, repeat] = placement;
    f(detail::Field{"width"}, width);
    f(detail::Field{"origin"}, origin);
    f(detail::Field{"turn"}, turn);
    f(detail::Field{"repeat"}, repeat);
}

template <class F, detail::MaybeConst<PrintLayer> T> void each_field(F &&f, T &layer) {
    auto &[picture, inks] = layer;
    f(detail::Field{"picture"}, picture);
    f(detail::Field{"inks"}, inks);
}

template <class F, detail::MaybeConst<Print> T> void each_field(F &&f, T &print) {
    auto &[name, layers, placement] = print;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"layers"}, layers);
    f(detail::Field{"placement"}, placement);
}

template <class F, detail::MaybeConst<Opacity> T> void each_field(F &&f, T &opacity) {
    auto &[picture, placement] = opacity;
    f(detail::Field{"picture"}, picture);
    f(detail::Field{"placement"}, placement);
}

template <class F, detail::MaybeConst<PanelFabric> T> void each_field(F &&f, T &panel_fabric) {
    auto &[panel, fabric, back, print, back_print, opacity] = panel_fabric;
    f(detail::Field{"panel"}, panel);
    f(detail::Field{"fabric"}, fabric);
    f(detail::Field{"back"}, back);
    f(detail::Field{"print"}, print);
    f(detail::Field{"back_print"}, back_print);
    f(detail::Field{"opacity"}, opacity);
}

template <class F, detail::MaybeConst<Object> T> void each_field(F &&f, T &object) {
    auto &[name, surface, fabric, back, print, back_print, opacity, panels, garment] = object;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"surface"}, surface);
    f(detail::Field{"fabric"}, fabric);
    f(detail::Field{"back"}, back);
    f(detail::Field{"print"}, print);
    f(detail::Field{"back_print"}, back_print);
    f(detail::Field{"opacity"}, opacity);
    f(detail::Field{"panels"}, panels);
    f(detail::Field{"garment"}, garment);
}

template <class F, detail::MaybeConst<LightBehaviour> T> void each_field(F &&f, T &behaviour) {
    auto &[visible, blocks, shadows] = behaviour;
    f(detail::Field{"visible"}, visible);
    f(detail::Field{"blocks"}, blocks);
    f(detail::Field{"shadows"}, shadows);
}

template <class F, detail::MaybeConst<RectangleLight> T> void each_field(F &&f, T &light) {
    auto &[name, corner, edge_u, edge_v, radiance, group, behaviour] = light;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"corner"}, corner);
    f(detail::Field{"edge_u"}, edge_u);
    f(detail::Field{"edge_v"}, edge_v);
    f(detail::Field{.key = "radiance", .low = 0}, radiance);
    f(detail::Field{"group"}, group);
    f(detail::Field{"behaviour"}, behaviour);
}

template <class F, detail::MaybeConst<DiskLight> T> void each_field(F &&f, T &light) {
    auto &[name, centre, direction, radius, radiance, group, behaviour] = light;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"centre"}, centre);
    f(detail::Field{"direction"}, direction);
    f(detail::Field{.key = "radius", .low = 0}, radius);
    f(detail::Field{.key = "radiance", .low = 0}, radiance);
    f(detail::Field{"group"}, group);
    f(detail::Field{"behaviour"}, behaviour);
}

template <class F, detail::MaybeConst<SphereLight> T> void each_field(F &&f, T &light) {
    auto &[name, centre, radius, radiance, group, behaviour] = light;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"centre"}, centre);
    f(detail::Field{.key = "radius", .low = 0}, radius);
    f(detail::Field{.key = "radiance", .low = 0}, radiance);
    f(detail::Field{"group"}, group);
    f(detail::Field{"behaviour"}, behaviour);
}

template <class F, detail::MaybeConst<IntensityProfile> T> void each_field(F &&f, T &profile) {
    auto &[vertical, horizontal, candela] = profile;
    f(detail::Field{"vertical"}, vertical);
    f(detail::Field{"horizontal"}, horizontal);
    f(detail::Field{"candela"}, candela);
}

template <class F, detail::MaybeConst<PointLight> T> void each_field(F &&f, T &light) {
    auto &[name, position, intensity, direction, full_angle, cone_angle, group, shadows, profile,
           zero_plane] = light;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"position"}, position);
    f(detail::Field{.key = "intensity", .low = 0}, intensity);
    f(detail::Field{"direction"}, direction);
    f(detail::Field{.key = "full_angle", .low = 0}, full_angle);
    f(detail::Field{.key = "cone_angle", .low = 0}, cone_angle);
    f(detail::Field{"group"}, group);
    f(detail::Field{"shadows"}, shadows);
    f(detail::Field{"profile"}, profile);
    f(detail::Field{"zero_plane"}, zero_plane);
}

template <class F, detail::MaybeConst<SunLight> T> void each_field(F &&f, T &light) {
    auto &[name, to_light, angular_radius, irradiance, group, visible, shadows] = light;
    f(detail::Field{.key = "name", .in_picture = false}, name);
    f(detail::Field{"to_light"}, to_light);
    f(detail::Field{.key = "angular_radius", .low = 0}, angular_radius);
    f(detail::Field{.key = "irradiance", .low = 0}, irradiance);
    f(detail::Field{"group"}, group);
    f(detail::Field{"visible"}, visible);
    f(detail::Field{"shadows"}, shadows);
}

template <class F, detail::MaybeConst<Image> T> void each_field(F &&f, T &image) {
    auto &[width, height, channels, data] = image;
    f(detail::Field{"width"}, width);
    f(detail::Field{"height"}, height);
    f(detail::Field{"channels"}, channels);
    f(detail::Field{"data"}, data);
}

template <class F, detail::MaybeConst<Environment> T> void each_field(F &&f, T &environment) {
    auto &[radiance, picture, group, visible, turn, further_groups] = environment;
    f(detail::Field{.key = "radiance", .low = 0}, radiance);
    f(detail::Field{"picture"}, picture);
    f(detail::Field{"group"}, group);
    f(detail::Field{"visible"}, visible);
    f(detail::Field{"turn"}, turn);
    f(detail::Field{"further_groups"}, further_groups);
}

template <class F, detail::MaybeConst<Lens> T> void each_field(F &&f, T &lens) {
    auto &[f_number, sensor_height, focus_distance, blades] = lens;
    f(detail::Field{"f_number"}, f_number);
    f(detail::Field{"sensor_height"}, sensor_height);
    f(detail::Field{"focus_distance"}, focus_distance);
    f(detail::Field{"blades"}, blades);
}

template <class F, detail::MaybeConst<Camera> T> void each_field(F &&f, T &camera) {
    auto &[eye, target, up, vertical_angle, width, height, orthographic_height, lens, shift] =
        camera;
    f(detail::Field{"eye"}, eye);
    f(detail::Field{"target"}, target);
    f(detail::Field{"up"}, up);
    f(detail::Field{"vertical_angle"}, vertical_angle);
    f(detail::Field{"width"}, width);
    f(detail::Field{"height"}, height);
    f(detail::Field{"orthographic_height"}, orthographic_height);
    f(detail::Field{"lens"}, lens);
    f(detail::Field{"shift"}, shift);
}

template <class F, detail::MaybeConst<Scene> T> void each_field(F &&f, T &scene) {
    auto &[surfaces, fabrics, open_dyes, textures, prints, opacities, objects, light_groups, lights,
           environment, camera] = scene;
    f(detail::Field{"surfaces"}, surfaces);
    f(detail::Field{"fabrics"}, fabrics);
    f(detail::Field{"open_dyes"}, open_dyes);
    f(detail::Field{"textures"}, textures);
    f(detail::Field{"prints"}, prints);
    f(detail::Field{"opacities"}, opacities);
    f(detail::Field{"objects"}, objects);
    f(detail::Field{"light_groups"}, light_groups);
    f(detail::Field{"lights"}, lights);
    f(detail::Field{"environment"}, environment);
    f(detail::Field{"camera"}, camera);
}

template <class F, detail::MaybeConst<StopRule> T> void each_field(F &&f, T &stop) {
    auto &[samples_per_pixel, relative_error, seconds] = stop;
    f(detail::Field{.key = "samples_per_pixel", .in_picture = false}, samples_per_pixel);
    f(detail::Field{.key = "relative_error", .in_picture = false}, relative_error);
    f(detail::Field{.key = "seconds", .in_picture = false}, seconds);
}

template <class F, detail::MaybeConst<RenderSettings> T> void each_field(F &&f, T &settings) {
    // The last two are calls to the caller and hold no value
    [[maybe_unused]] auto &[stop, channels, max_bounces, threads, seed, crop, aovs, alpha, denoise,
                            widen_after_diffuse, skip, keep, checkpoint, checkpoint_seconds, resume,
                            snapshot_wanted, snapshot] = settings;
    f(detail::Field{.key = "stop", .in_picture = false}, stop);
    f(detail::Field{"channels"}, channels);
    f(detail::Field{"max_bounces"}, max_bounces);
    f(detail::Field{.key = "threads", .in_picture = false}, threads);
    f(detail::Field{"seed"}, seed);
    f(detail::Field{"crop"}, crop);
    f(detail::Field{"aovs"}, aovs);
    f(detail::Field{"alpha"}, alpha);
    f(detail::Field{"denoise"}, denoise);
    f(detail::Field{"widen_after_diffuse"}, widen_after_diffuse);
    f(detail::Field{"skip"}, skip);
    f(detail::Field{"keep"}, keep);
    f(detail::Field{.key = "checkpoint", .in_picture = false}, checkpoint);
    f(detail::Field{.key = "checkpoint_seconds", .in_picture = false}, checkpoint_seconds);
    f(detail::Field{.key = "resume", .in_picture = false}, resume);
}

} // namespace tsuya
