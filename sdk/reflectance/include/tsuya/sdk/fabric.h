#pragma once
/// \file
/// A fabric as its author describes it, and the material that the renderer shades with.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/brdf.h"
#include "tsuya/sdk/spectrum.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// The model of a fabric that names none: the one that comes nearest to traced cloth, see
/// sdk/docs/ACCURACY.md.
inline constexpr const char *kDefaultModel = "yarn";

/// Authored. The measured black fabric gives the specular part, a dye the diffuse part
/// ([Takeda] Eq. 18).
struct Fabric {
    std::string name{};
    std::map<std::string, std::string> keys{}; ///< provenance
    std::string model = kDefaultModel;         ///< of the specular part, see model_names
    std::optional<Bard> bard{};                ///< the measured views, for the models made of them
    std::optional<GgxFacets> ggx{};            ///< for the model `ggx`; none: fitted to the views
    /// For the model `yarn`: fitted to oblique light too; none: fitted to the views. With its own
    /// f0.
    std::optional<YarnLobes> yarn{};
    /// For the model `tabulated`: every light and view, and the file that holds them, from the
    /// folder of the fabric's file.
    std::optional<ReflectanceTable> table{};
    std::string table_file{};
    std::optional<double> f0{};             ///< in (0, 1]; none: rho0(0,0), as [Takeda] has it
    Spectrum dye = Spectrum::constant(0.0); ///< diffuse reflectance, 0..1
    /// Diffuse transmittance of the thin cloth, 0..1, with the dye at most 1: light from behind
    Spectrum transmittance = Spectrum::constant(0.0);
    Spectrum specular_tint = Spectrum::constant(1); ///< colour of the specular part, 0..1
    /// The same of one system of yarns, in its place: weft and warp of a shot silk are dyed apart.
    /// For models that tell the systems apart: `yarn`.
    std::optional<Spectrum> weft_tint{}, warp_tint{};
};

/// Resolved. Local space, see brdf.h; both sides of a cloth are alike.
struct Material {
    std::optional<Brdf> specular{};
    /// Colours of what yarns along the weft reflect, see WeighedLight, and of the rest
    Spectrum weft_tint = Spectrum::constant(1), warp_tint = Spectrum::constant(1);
    Spectrum dye = Spectrum::constant(0), transmittance = Spectrum::constant(0);

    bool has_diffuse() const;  ///< dye or transmittance
    bool has_specular() const; ///< with a colour
};

/// The fabric's f0, or what [Takeda] takes where it has none. Throws Error naming `where` if it is
/// not in (0, 1].
double f0_of(const Fabric &fabric, const std::string &where);

/// A fabric without what its model is made of, or with views that are all 0, has no specular part.
/// Throws Error naming `where`: a spectrum outside 0..1, dye and transmittance above 1 together, f0
/// outside (0, 1], tints of weft and warp for a model that does not tell them apart; as make_brdf.
Material resolve(const Fabric &fabric, const std::string &where);

/// Reads F.fabric.toml, and the table it names. Throws Error with file:line:column; unknown keys
/// and models are refused with the nearest known.
Fabric read_fabric(const std::filesystem::path &file);

/// Writes F.fabric.toml through a temporary file, with the views at normal incidence in it.
void write_fabric(const Fabric &fabric, const std::filesystem::path &file);

} // namespace tsuya
