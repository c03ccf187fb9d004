/// The weaves that can be named. Their numbers are typical of such cloth in the trade and ours: no
/// sample was measured and no one source gives them all ([Adanur] and [Robinson] explain the
/// constructions and the counts). What ties them together: the width is a little less than the
/// spacing in dense warps, and the thickness is that at which the filaments, packed in rings, are
/// as thick as their count says: a circle of d decitex and density rho (polyester 1380, silk 1340,
/// viscose 1520 kg/m^3) has the area d / rho. Round filaments fill 0.55 to 0.7 of the yarn then.
/// Multifilament yarns of low twist lie flat: thickness over width 0.2 to 0.5, which [Peirce]
/// leaves free.
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
constexpr double kStraight = 50;              // tension of a weft that lies level

/// Dress satin: warp 50 dtex / 24 filaments, weft 84 dtex / 36 filaments. Nothing that enters a
/// black filament leaves it.
Weave black_polyester_satin() {
    Yarn warp{.per_cm = 76,
              .width = 0.125e-3,
              .flattening = 0.40,
              .filaments = 24,
              .surface_roughness = kPolyesterRoughness};
    Yarn weft{.per_cm = 34,
              .width = 0.200e-3,
              .flattening = 0.226,
              .filaments = 36,
              .tension = kStraight,
              .surface_roughness = kPolyesterRoughness};
    return {"black polyester satin", parse_draft("satin 5"), warp, weft};
}

/// About 19 momme: warp two ends of 20/22 denier raw silk as one, weft three with a crepe's twist,
/// degummed: fibres near 1 dtex, triangular with rounded corners, undyed.
Weave silk_charmeuse() {
    Yarn warp{.per_cm = 130,
              .width = 0.074e-3,
              .flattening = 0.78,
              .filaments = 30,
              .section = FilamentSection::triangular,
              .corner_rounding = 0.4,
              .material = FiberMaterial::silk,
              .transmission = {0.8, 0.78, 0.7}};
    Yarn weft = warp;
    weft.per_cm = 45;
    weft.width = 0.092e-3;
    weft.flattening = 0.76;
    weft.filaments = 45;
    weft.twist_per_m = 2000;
    weft.tension = kStraight;
    return {"silk charmeuse", parse_draft("satin 8"), warp, weft};
}

/// "190T": 112 ends and 78 picks to the inch of 75 dtex / 24 filaments.
Weave polyester_taffeta() {
    Yarn warp{.per_cm = 44,
              .width = 0.180e-3,
              .flattening = 0.295,
              .filaments = 24,
              .surface_roughness = kPolyesterRoughness};
    Yarn weft{.per_cm = 31,
              .width = 0.200e-3,
              .flattening = 0.265,
              .filaments = 24,
              .surface_roughness = kPolyesterRoughness};
    return {"polyester taffeta", parse_draft("plain"), warp, weft};
}

/// Twill lining of viscose: 84 dtex / 24 filaments both ways, black.
Weave twill_lining() {
    Yarn warp{.per_cm = 50,
              .width = 0.170e-3,
              .flattening = 0.325,
              .filaments = 24,
              .material = FiberMaterial::cellulose};
    Yarn weft = warp;
    weft.per_cm = 34;
    weft.width = 0.200e-3;
    weft.flattening = 0.265;
    return {"twill lining", parse_draft("twill 2/2"), warp, weft};
}

/// Silk taffeta, red warp and green weft; dyes chosen by us.
Weave shot_silk() {
    Yarn warp{.per_cm = 56,
              .width = 0.140e-3,
              .flattening = 0.33,
              .filaments = 40,
              .section = FilamentSection::triangular,
              .corner_rounding = 0.4,
              .material = FiberMaterial::silk,
              .transmission = {0.65, 0.08, 0.10}};
    Yarn weft = warp;
    weft.per_cm = 40;
    weft.width = 0.180e-3;
    weft.flattening = 0.205;
    weft.transmission = {0.08, 0.45, 0.15};
    return {"shot silk", parse_draft("plain"), warp, weft};
}

} // namespace

std::vector<std::string> weave_names() {
    return {"black polyester satin", "silk charmeuse", "polyester taffeta", "twill lining",
            "shot silk"};
}

Weave weave(std::string_view name, const std::string &where) {
    if (name == "black polyester satin")
        return black_polyester_satin();
    if (name == "silk charmeuse")
        return silk_charmeuse();
    if (name == "polyester taffeta")
        return polyester_taffeta();
    if (name == "twill lining")
        return twill_lining();
    if (name == "shot silk")
        return shot_silk();
    throw Error({"unknown weave \"" + std::string(name) + "\"", where,
                 accepted_names(name, weave_names())});
}

} // namespace tsuya::lab
