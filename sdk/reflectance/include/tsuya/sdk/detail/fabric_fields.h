#pragma once
/// \file
/// The fields of a fabric, see fields.h: their keys in F.fabric.toml and the values accepted there.
///
/// To add one: its member, and its line here. The reader and writer of files take it from here, and
/// so does the fingerprint by which an interrupted render knows its fabrics again.

#include "tsuya/sdk/detail/fields.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya {

template <class F, detail::MaybeConst<Spectrum> T> void each_field(F &&f, T &spectrum) {
    auto &[wavelength_nm, value] = spectrum;
    f(detail::Field{"wavelength_nm"}, wavelength_nm);
    f(detail::Field{"value"}, value);
}

template <class F, detail::MaybeConst<FabricColours> T> void each_field(F &&f, T &colours) {
    auto &[dye, weft_dye, warp_dye, lustre, delustre, transmittance, specular_tint, weft_tint,
           warp_tint] = colours;
    f(detail::Field{.key = "dye", .low = 0, .high = 1}, dye);
    f(detail::Field{.key = "weft_dye", .low = 0, .high = 1}, weft_dye);
    f(detail::Field{.key = "warp_dye", .low = 0, .high = 1}, warp_dye);
    f(detail::Field{.key = "lustre", .written = lustre != Lustre::bright}, lustre);
    f(detail::Field{.key = "delustre", .low = 0, .high = 1}, delustre);
    f(
        detail::Field{
            .key = "transmittance", .low = 0, .high = 1, .written = transmittance.any_above_zero()},
        transmittance);
    f(detail::Field{.key = "specular_tint", .low = 0, .high = 1}, specular_tint);
    f(detail::Field{.key = "weft_tint", .low = 0, .high = 1}, weft_tint);
    f(detail::Field{.key = "warp_tint", .low = 0, .high = 1}, warp_tint);
}

template <class F, detail::MaybeConst<GgxFacets> T> void each_field(F &&f, T &facets) {
    auto &[alpha_weft, alpha_warp, f0, refractive_index] = facets;
    f(detail::Field{.key = "alpha_weft", .low = 1e-4, .high = 1, .required = true}, alpha_weft);
    f(detail::Field{.key = "alpha_warp", .low = 1e-4, .high = 1, .required = true}, alpha_warp);
    f(detail::Field{.key = "refractive_index", .low = 1.001, .high = 10}, refractive_index);
    f(detail::Field{.key = "f0", .low = 1e-6, .high = 1, .written = !refractive_index}, f0);
}

template <class F, detail::MaybeConst<YarnLobes> T> void each_field(F &&f, T &lobes) {
    auto &[f0, roughness, surface, pit, even, loose, dive] = lobes;
    f(detail::Field{.key = "f0", .low = 1e-6, .high = 1, .required = true}, f0);
    f(detail::Field{.key = "roughness", .low = 0.005, .high = 1, .required = true}, roughness);
    f(detail::Field{.key = "even", .low = 0, .high = 1, .required = true}, even);
    f(detail::Field{.key = "loose", .low = 0, .high = 100, .written = loose > 0}, loose);
    f(detail::Field{.key = "dive", .low = 0, .high = 10, .written = dive > 0}, dive);
    f(detail::Field{.key = "pit_weft", .low = 0, .high = 10, .required = true}, pit[0]);
    f(detail::Field{.key = "pit_warp", .low = 0, .high = 10, .required = true}, pit[1]);
    f(detail::Field{.key = "surface_weft", .low = 0, .required = true}, surface[0]);
    f(detail::Field{.key = "surface_warp", .low = 0, .required = true}, surface[1]);
}

template <class F, detail::MaybeConst<BardSmoothness> T> void each_field(F &&f, T &smoothness) {
    auto &[weft_support, warp_support, noise_share] = smoothness;
    f(detail::Field{.key = "weft_support", .low = 0.01, .high = 100, .required = true},
      weft_support);
    f(detail::Field{.key = "warp_support", .low = 0.01, .high = 100, .required = true},
      warp_support);
    f(detail::Field{.key = "noise_share", .low = 1e-12, .high = 1, .required = true}, noise_share);
}

/// What was fitted is fixed by the rest.
template <class F> void each_field(F &&f, const BardView &view) {
    const auto &[theta, phi, brdf_per_sr, sigma_per_sr, fitted_per_sr] = view;
    f(detail::Field{"theta"}, theta);
    f(detail::Field{"phi"}, phi);
    f(detail::Field{"brdf_per_sr"}, brdf_per_sr);
    f(detail::Field{"sigma_per_sr"}, sigma_per_sr);
    f(detail::Field{.key = "fitted_per_sr", .in_picture = false}, fitted_per_sr);
}

/// A BARD is made by fitting and has no members to be set: what it was made of.
template <class F> void each_field(F &&f, const Bard &bard) {
    f(detail::Field{"symmetry"}, bard.symmetry());
    f(detail::Field{"smoothness"}, bard.smoothness());
    f(detail::Field{"views"}, bard.views());
}

template <class F, detail::MaybeConst<ReflectanceRow> T> void each_field(F &&f, T &row) {
    auto &[theta_i, phi_i, theta_r, phi_r, brdf_per_sr, sigma_per_sr] = row;
    f(detail::Field{"theta_i"}, theta_i);
    f(detail::Field{"phi_i"}, phi_i);
    f(detail::Field{"theta_r"}, theta_r);
    f(detail::Field{"phi_r"}, phi_r);
    f(detail::Field{"brdf_per_sr"}, brdf_per_sr);
    f(detail::Field{"sigma_per_sr"}, sigma_per_sr);
}

template <class F, detail::MaybeConst<ReflectanceTable> T> void each_field(F &&f, T &table) {
    auto &[keys, symmetry, symmetry_declared, rows] = table;
    f(detail::Field{.key = "keys", .in_picture = false}, keys);
    f(detail::Field{"symmetry"}, symmetry);
    f(detail::Field{.key = "symmetry_declared", .in_picture = false}, symmetry_declared);
    f(detail::Field{"rows"}, rows);
}

template <class F, detail::MaybeConst<CarriedViews> T> void each_field(F &&f, T &views) {
    auto &[bard, model, f0] = views;
    f(detail::Field{"bard"}, bard);
    f(detail::Field{"model"}, model);
    f(detail::Field{.key = "f0", .low = 1e-6, .high = 1}, f0);
}

template <class F, detail::MaybeConst<TabulatedSpecular> T> void each_field(F &&f, T &tabulated) {
    auto &[table, file] = tabulated;
    f(detail::Field{"table"}, table);
    f(detail::Field{.key = "file", .in_picture = false}, file);
}

template <class F, detail::MaybeConst<Irregularity> T> void each_field(F &&f, T &irregularity) {
    auto &[thickness, filament, slubs_per_m, slub_length, slub_gain, seed] = irregularity;
    const Irregularity usual;
    const bool has_slubs = slubs_per_m > 0;
    f(detail::Field{.key = "thickness", .low = 0, .high = 0.3, .written = thickness > 0},
      thickness);
    f(
        detail::Field{
            .key = "filament", .low = 0, .high = 0.3, .written = filament != usual.filament},
        filament);
    f(detail::Field{.key = "slubs_per_m", .low = 0, .high = 100, .written = has_slubs},
      slubs_per_m);
    f(detail::Field{.key = "slub_length_m", .low = 0.001, .high = 1, .written = has_slubs},
      slub_length);
    f(detail::Field{.key = "slub_gain", .low = 0, .high = 5, .written = has_slubs}, slub_gain);
    f(detail::Field{.key = "seed", .low = 0, .high = 1e9, .written = seed != usual.seed}, seed);
}

template <class F, detail::MaybeConst<WeavePlace> T> void each_field(F &&f, T &place) {
    auto &[system, thread, slope, along, across, height] = place;
    f(detail::Field{"system"}, system);
    f(detail::Field{"thread"}, thread);
    f(detail::Field{"slope"}, slope);
    f(detail::Field{"along"}, along);
    f(detail::Field{"across"}, across);
    f(detail::Field{"height"}, height);
}

template <class F, detail::MaybeConst<WeaveMap> T> void each_field(F &&f, T &map) {
    auto &[repeat, size, threads, filaments, place] = map;
    f(detail::Field{"repeat"}, repeat);
    f(detail::Field{"size"}, size);
    f(detail::Field{"threads"}, threads);
    f(detail::Field{"filaments"}, filaments);
    f(detail::Field{"place"}, place);
}

/// The map is what is seen, wherever it came from.
template <class F, detail::MaybeConst<ClothWeave> T> void each_field(F &&f, T &weave) {
    auto &[preset, file, irregularity, map] = weave;
    f(detail::Field{.key = "preset", .written = !preset.empty(), .in_picture = false}, preset);
    f(detail::Field{.key = "file", .written = !file.empty(), .in_picture = false}, file);
    f(detail::Field{"irregularity"}, irregularity);
    f(detail::Field{"map"}, map);
}

template <class F, detail::MaybeConst<Fabric> T> void each_field(F &&f, T &fabric) {
    auto &[name, keys, specular, spare, colours, weave] = fabric;
    f(detail::Field{.key = "name", .required = true, .in_picture = false}, name);
    f(detail::Field{.key = "provenance", .in_picture = false}, keys);
    f(detail::Field{"specular"}, specular);
    f(detail::Field{.key = "spare", .in_picture = false}, spare);
    f(detail::Field{"colours"}, colours);
    f(detail::Field{"weave"}, weave);
}

} // namespace tsuya
