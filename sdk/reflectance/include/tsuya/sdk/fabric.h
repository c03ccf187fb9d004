#pragma once
/// \file
/// A fabric as its author describes it, and the material that the renderer shades with.
///
///     Fabric fabric{.name = "satin",
///                   .specular = CarriedViews{.bard = Bard::fit(table, "satin.csv")},
///                   .colours = {.dye = Spectrum::constant(0.4)}};
///     const Material material = resolve(fabric, "fabrics.satin");

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/body.h"
#include "tsuya/sdk/brdf.h"
#include "tsuya/sdk/cloth_weave.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/lustre.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/spectrum.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

class NearYarn;

/// The model of a fabric's file that names none: the one that comes nearest to traced cloth, see
/// sdk/docs/ACCURACY.md.
inline constexpr const char *kDefaultModel = "yarn";

/// How views under light from straight above are carried to all other lights.
enum class ViewModel {
    yarn, ///< yarns fitted to the views
    takeda,
    takeda_printed,
    half_vector,
    ggx,    ///< facets fitted to the views
    lambert ///< the ideal diffuser of the same albedo under light from straight above
};

/// A specular part that is carried from measured views.
struct CarriedViews {
    Bard bard;
    ViewModel model = ViewModel::yarn;
    /// Reflectance of the facets at normal incidence, in (0, 1]. None: a fibre's, kFibreF0; of
    /// `takeda_printed` rho0(0,0), as [Takeda] has it. `ggx` and `lambert` do not look at it.
    std::optional<double> f0{};

    bool operator==(const CarriedViews &) const = default;
};

/// A specular part that is looked up in a table of every light and view.
struct TabulatedSpecular {
    ReflectanceTable table{};
    std::string file{}; ///< that holds the table, from the folder of the fabric's file

    bool operator==(const TabulatedSpecular &) const = default;
};

/// What the specular part is made of. `std::monostate`: the fabric has none.
using Specular =
    std::variant<std::monostate, CarriedViews, YarnLobes, GgxFacets, TabulatedSpecular>;

/// The spectra of a fabric.
struct FabricColours {
    /// Reflectance of the coloured part, 0..1: what a spectrophotometer measures with light at 8
    /// degrees and the specular part excluded
    Spectrum dye = Spectrum::constant(0.0);
    /// The same of one system of yarns, in its place: weft and warp of a shot silk are dyed apart.
    /// For specular parts that tell the systems apart: yarns, given or fitted.
    std::optional<Spectrum> weft_dye{}, warp_dye{};
    Lustre lustre = Lustre::bright; ///< of the filaments, for delustre_of
    /// Share of the coloured part that is Lambertian, 0..1. None: delustre_of the lustre and the
    /// dye at each wavelength for specular parts made of yarns, 1 for all others.
    std::optional<double> delustre{};
    /// Diffuse transmittance of the thin cloth, 0..1, with the dye at most 1: light from behind
    Spectrum transmittance = Spectrum::constant(0.0);
    Spectrum specular_tint = Spectrum::constant(1); ///< colour of the specular part, 0..1
    /// The same of one system of yarns, in its place: weft and warp of a shot silk are dyed apart.
    /// For specular parts that tell the systems apart: yarns, given or fitted.
    std::optional<Spectrum> weft_tint{}, warp_tint{};

    /// Colour of what either system of yarns reflects on its surface.
    const Spectrum &weft() const;
    /// As `weft`, of the other system.
    const Spectrum &warp() const;
    /// Dye of either system.
    const Spectrum &dye_of_weft() const;
    /// As `dye_of_weft`, of the other system.
    const Spectrum &dye_of_warp() const;
    /// Gives both systems this dye.
    void dye_all(const Spectrum &with);
    /// A dye is above 0 somewhere.
    bool any_dye() const;
    bool operator==(const FabricColours &) const = default;
};

/// Authored. The measured black fabric gives the specular part, a dye the diffuse part
/// ([Takeda] Eq. 18).
struct Fabric {
    std::string name{};
    std::map<std::string, std::string> keys{}; ///< provenance
    Specular specular{};
    /// What else is known of the same cloth, at most one of each kind: the views that yarns were
    /// fitted to, facets to compare with. Not rendered; `with_model` makes it the specular part.
    std::vector<Specular> spare{};
    FabricColours colours{};
    /// For where it is seen from near; for specular parts made of yarns, others do not look at it.
    std::optional<ClothWeave> weave{};

    bool operator==(const Fabric &) const = default;
};

/// The description of one kind, as specular part or spare; null where the fabric has none.
template <class Kind> const Kind *find_specular(const Fabric &fabric) {
    if (const Kind *const found = std::get_if<Kind>(&fabric.specular))
        return found;
    for (const Specular &spare : fabric.spare)
        if (const Kind *const found = std::get_if<Kind>(&spare))
            return found;
    return nullptr;
}
/// The same, to be changed.
template <class Kind> Kind *find_specular(Fabric &fabric) {
    return const_cast<Kind *>(find_specular<Kind>(std::as_const(fabric)));
}

/// The fabric's measured views; null where it has none.
const Bard *views_of(const Fabric &fabric);

/// There is a specular part, and not of views that are all 0.
bool reflects(const Specular &specular);

/// The fabric has a specular part that reflects, with a colour.
bool has_specular(const Fabric &fabric);

/// The fabric has a coloured part that follows its yarns: it has a dye, a specular part made of
/// yarns, and no delustre of 1.
bool has_body(const Fabric &fabric);

/// The fabric reflects otherwise when it is turned: its surface needs yarn directions. Not so a
/// fabric without specular part, an ideal diffuser, and facets given as wide along the weft as
/// along the warp. What is carried from views counts as directed, whatever they show.
bool needs_frames(const Fabric &fabric);

/// f0, or what the model takes where there is none.
double f0_of(const CarriedViews &views);

/// Throws Error naming `where`, with every rule that is broken: a spectrum outside 0..1; dye and
/// transmittance above 1 together; f0 outside (0, 1]; facets as check_ggx; two descriptions of one
/// kind; tints or dyes of weft and warp, or a delustre below 1, for a specular part that does not
/// tell them apart.
void check_fabric(const Fabric &fabric, const std::string &where);

/// What is allowed and probably not meant, each with its place below `where`: a table of which
/// likely_symmetry knows better, that the model `tabulated` would carry on to light from all sides;
/// a weave below a model that shows none.
std::vector<Problem> fabric_warnings(const Fabric &fabric, const std::string &where);

/// What the models of a specular part tabulate, shared by all materials that have it: no one of
/// them owns it. Null: not made yet, or there is none.
struct ModelTables {
    std::shared_ptr<const Brdf> specular{};
    /// The coloured part that follows the yarns: below the specular part, and below one without a
    /// colour
    std::shared_ptr<const BodyBrdf> body{}, bare_body{};
    /// The same with wider lobes, see widened_material.h
    std::shared_ptr<const Brdf> wide_specular{};
    std::shared_ptr<const BodyBrdf> wide_body{}, wide_bare_body{};

    bool operator==(const ModelTables &) const = default; ///< the same objects

    /// See detail/table_parts.h.
    template <class F, detail::MaybeConst<ModelTables> T> friend void each_part(F &&f, T &t) {
        auto &[of_specular, of_body, of_bare_body, of_wide_specular, of_wide_body,
               of_wide_bare_body] = t;
        for (auto *brdf : {&of_specular, &of_wide_specular})
            f(*brdf);
        for (auto *made : {&of_body, &of_bare_body, &of_wide_body, &of_wide_bare_body})
            f(*made);
    }
};

/// Resolved. Local space, see brdf.h; both sides of a cloth are alike.
struct Material {
    std::shared_ptr<const Brdf> specular{}; ///< see ModelTables; null: none
    /// Colours of what yarns along the weft reflect, see WeighedLight, and of the rest
    Spectrum weft_tint = Spectrum::constant(1), warp_tint = Spectrum::constant(1);
    /// Albedo of the Lambertian part, before the specular part takes its share
    Spectrum dye = Spectrum::constant(0), transmittance = Spectrum::constant(0);
    /// The coloured part that follows the yarns, below the specular part; none: all is Lambertian
    std::shared_ptr<const BodyBrdf> body{};
    Spectrum weft_body = Spectrum::constant(0), warp_body = Spectrum::constant(0); ///< its colours
    /// Albedo of the Lambertian part (x) and colour of the body (y) of another dye on this cloth,
    /// by its reflectance from 0 to 1 in equal steps, for prints
    std::vector<glm::vec2> of_dye{};
    double weft_share = 0.5; ///< of the weft in what both systems show, see YarnLobes
    double most_dye = 1;     ///< a dye of a greater reflectance looks the same; above 0
    /// Of a fabric with a weave whose map is made, and yarns; null: seen from far alone
    std::shared_ptr<const NearYarn> near{};

    bool has_diffuse() const;  ///< Lambertian: dye or transmittance
    bool has_specular() const; ///< with a colour
};

/// Checks the fabric and makes its material. Throws Error naming `where` as check_fabric and as
/// make_brdf; Interrupted where progress asks to stop.
Material resolve(const Fabric &fabric, const std::string &where, const Progress &progress = {});
/// The same with the tables of the fabric's specular part: takes those that are there, so that a
/// cloth in other colours takes no time, and adds those that it makes.
Material resolve(const Fabric &fabric, const std::string &where, ModelTables &tables,
                 const Progress &progress = {});

/// Warns, with its place below `where`, of a material whose weave does not explain its filaments: a
/// system that would need more than 1.2 full covers of them where it lies on the face.
std::vector<Problem> weave_warnings(const Material &material, const std::string &where);

/// What a model lets through to the Lambertian part below it: the mean of 1 - albedo over the
/// cosine-weighted hemisphere, at least 0.001 where the model reflects all. In 0.001..1.
float mean_passed(const Brdf &brdf);

/// The coloured part at one wavelength as a function, for comparisons: what was inside the
/// filaments, without the specular part.
BrdfFunction coloured_part(const Material &material, double wavelength_nm);

/// Reads F.fabric.toml, and the table it names. Throws Error with file:line:column; unknown keys
/// and models are refused with the nearest known. Throws Interrupted.
///
/// The key `model` says which of the descriptions in the file is the specular part, `yarn` where it
/// is missing: `[yarn]` or `[ggx]` where the file has it, else what is carried from `[views]`. The
/// others are spare, so that reading and writing loses nothing.
Fabric read_fabric(const std::filesystem::path &file, const Progress &progress = {});

/// Writes F.fabric.toml by atomic replacement, with the views at normal incidence in it.
void write_fabric(const Fabric &fabric, const std::filesystem::path &file);

} // namespace tsuya
