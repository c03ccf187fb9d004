/// The weaves that can be named. No sample was measured. Counts, deniers and weights are those of
/// such cloth in the trade, from the sources beside each; where none is named they are ours, in the
/// usual range ([Adanur] and [Robinson] explain the constructions). Widths and thicknesses of yarns
/// by themselves are ours: multifilament yarns of low twist lie flat, which [Peirce] leaves free,
/// and the thickness is that at which the filaments, packed in rings, are as thick as their count
/// says. A circle of d decitex and density rho (polyester 1380, silk 1340, viscose 1520 kg/m^3) has
/// the area d / rho; report_weave() finds the decitex again. Dense warps are wider than their
/// spacing and press each other flat.
///
/// Raw silk of 20/22 denier is 23.3 decitex of nine cocoons' double threads, and loses 23 % as it
/// is degummed [Sericin]. That leaves 18 filaments of 18 decitex. A momme is 4.306 g/m^2.
///
/// The roughness of filaments along their axis is that of measured cloth, [Sadeghi] Table II: the
/// flat threads of a polyester satin scatter by 2.5 degrees about the cone of their tangent, those
/// of silk by 4 to 5. In the same table the flat warp of the satin has tangents at 0, 18 and 32
/// degrees and the weft lies level: crowded ends leave the weft no room to bend, and all crimp is
/// in the warp, whose floats then lie flat. So the weft of satins is given the larger tension.
#include "tsuya/lab/weave.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kPolyesterRoughness = 0.044; // radians
constexpr double kStraight = 100;             // tension of a weft that lies level

/// Dress satin of 75 denier / 36 filaments (83 decitex) both ways, 95 g/m^2. Nothing that enters a
/// black filament leaves it.
Weave black_polyester_satin() {
    Yarn warp{.per_cm = 76,
              .width = 0.160e-3,
              .flattening = 0.381,
              .filaments = 36,
              .surface_roughness = kPolyesterRoughness};
    Yarn weft = warp;
    weft.per_cm = 34;
    weft.width = 0.180e-3;
    weft.flattening = 0.339;
    weft.tension = kStraight;
    return {"black polyester satin", parse_draft("satin 5"), warp, weft};
}

/// Degummed silk: triangular filaments with rounded corners, undyed.
Yarn silk(double per_cm, double width, double flattening, int filaments) {
    return {.per_cm = per_cm,
            .width = width,
            .flattening = flattening,
            .filaments = filaments,
            .section = FilamentSection::triangular,
            .corner_rounding = 0.4,
            .material = FiberMaterial::silk,
            .transmission = {0.8, 0.78, 0.7}};
}

/// 19 momme, the weight of dresses: warp 2 x 20/22 denier without twist, weft 4 x 20/22 denier with
/// a crepe's twist. Weights of the trade are 12, 16, 19 and 30 momme, and up to 2600 turns are
/// usual [CrepeSatin]; 300 to 600 threads to the square inch (406 here) in floats over 4 or 7
/// [CrepeBackSatin]; wefts of crepe are 2 to 4 x 20/22 denier [CrepeWeft]. Denser ends would be
/// taller than wide, as circles about triangular filaments are what is packed.
Weave silk_charmeuse() {
    const Yarn warp = silk(112, 0.100e-3, 0.645, 36);
    Yarn weft = silk(46, 0.1245e-3, 0.98, 72);
    weft.twist_per_m = 1400; // a turn in a repeat of the draft, which keeps the cell small
    weft.tension = kStraight;
    return {"silk charmeuse", parse_draft("satin 8"), warp, weft};
}

/// "190T": 112 ends and 78 picks to the inch of 75 denier / 36 filaments.
Weave polyester_taffeta() {
    Yarn warp{.per_cm = 44,
              .width = 0.240e-3,
              .flattening = 0.191,
              .filaments = 36,
              .surface_roughness = kPolyesterRoughness};
    Yarn weft = warp;
    weft.per_cm = 31;
    weft.width = 0.250e-3;
    weft.flattening = 0.183;
    return {"polyester taffeta", parse_draft("plain"), warp, weft};
}

/// Habotai of 8 momme, which is light and sheer [Babu]. 2 x 20/22 denier both ways, without twist.
Weave silk_habotai() {
    const Yarn warp = silk(50, 0.170e-3, 0.214, 36);
    Yarn weft = warp;
    weft.per_cm = 45;
    return {"silk habotai", parse_draft("plain"), warp, weft};
}

/// Twill lining of viscose: 84 decitex / 30 filaments both ways, black.
Weave twill_lining() {
    Yarn warp{.per_cm = 50,
              .width = 0.210e-3,
              .flattening = 0.229,
              .filaments = 30,
              .material = FiberMaterial::cellulose};
    Yarn weft = warp;
    weft.per_cm = 34;
    weft.width = 0.230e-3;
    weft.flattening = 0.209;
    return {"twill lining", parse_draft("twill 2/2"), warp, weft};
}

/// Silk taffeta of 10 momme, 56.4 ends of 2 x 20/22 and 36.5 picks of 2 x 30/40 denier to the
/// centimetre [DoupioniTaffeta], red warp and green weft; dyes chosen by us.
Weave shot_silk() {
    Yarn warp = silk(56.4, 0.190e-3, 0.191, 36);
    warp.transmission = {0.65, 0.08, 0.10};
    Yarn weft = silk(36.5, 0.220e-3, 0.220, 60);
    weft.transmission = {0.08, 0.45, 0.15};
    return {"shot silk", parse_draft("plain"), warp, weft};
}

std::vector<Weave> presets() {
    return {black_polyester_satin(), silk_charmeuse(), polyester_taffeta(),
            silk_habotai(),          twill_lining(),   shot_silk()};
}

} // namespace

std::vector<std::string> weave_names() {
    std::vector<std::string> names;
    for (const Weave &preset : presets())
        names.push_back(preset.name);
    return names;
}

Weave weave(std::string_view name, const std::string &where) {
    for (Weave &preset : presets())
        if (preset.name == name)
            return preset;
    throw Error({"unknown weave \"" + std::string(name) + "\"", where,
                 accepted_names(name, weave_names())});
}

} // namespace tsuya::lab
