#pragma once
/// \file
/// From a weave to filaments: yarn paths that touch without passing through each other, and the
/// filaments in them.
///
///     const FilamentRepeat repeat = build_filaments(weave("black polyester satin"));
///
/// **Paths.** A yarn's axis stays above or below its straight line in the cloth, as in [Peirce].
/// Its height is that of an elastic thread under tension, with some stiffness, that rests on the
/// yarns it crosses: the heights of all yarns of the repeat together have the least energy under
/// the condition that no two yarns come nearer than half the sum of their thicknesses. So floats
/// are nearly straight, and the crimp divides itself between warp and weft by Yarn::tension.
///
/// **Jamming.** There is a limit to how close yarns of one section lie ([Peirce]: a plain weave of
/// round yarns is jammed where sqrt(1 - (p / D)^2) of warp and of weft sum to 1, p being the
/// spacing and D the sum of the diameters). Beyond it the yarns squeeze each other: all become
/// narrower, and so thicker, by the fewest per cent that let them pass, at most ten.
///
/// **Filaments** lie in rings parallel to the section of their yarn, so that twist moves each along
/// its ring and they never touch: any two are apart by about 1 % of the sum of their radii. A yarn
/// that is wider than the spacing is pressed by its neighbours (see Yarn), and its filaments, which
/// stay as thick as they are, move into rings of the pressed section.

#include <cstdint>
#include <vector>

#include "tsuya/lab/filaments.h"
#include "tsuya/lab/weave.h"

namespace tsuya::lab {

/// How finely yarns and filaments are built, and where.
struct GeometryOptions {
    /// Points of a path per crossing, even, 4 to 64. The points lie on the curve, which is the
    /// periodic Catmull-Rom spline through them.
    int points_per_crossing = 12;
    double wavelength_nm = 589; ///< of the optics; see refractive_index()
    std::uint64_t seed = 1;     ///< of the places of filaments in their yarns
    /// Length over which a yarn resists bending against its tension, as a share of the spacing of
    /// the yarns it crosses; 0 (a thread) to 1. Yarns of fine filaments bend easily; a stiff yarn
    /// bows up over a wide flat one and touches it at its edges only.
    double stiffness_length = 0.05;
    /// Repeats of the draft in the rectangle along x and y, 1 to 16; 0: as many as bring the twist,
    /// which must be a whole number of turns, within 10 % of what was asked (at most 4).
    int tiles_x = 0, tiles_y = 0;
};

/// What was built, in metres unless said otherwise.
struct WeaveReport {
    double cover = 0;            ///< share of the plane that some yarn covers, 0 to 1
    double warp_on_face = 0;     ///< share of the plane where warp is what is seen from above
    double weft_on_face = 0;     ///< the same of weft; the two sum to `cover`
    double thickness = 0;        ///< of the cloth
    double warp_thickness = 0;   ///< of a warp yarn as it lies in the cloth
    double weft_thickness = 0;   ///< the same of weft
    double warp_weft_gap = 0;    ///< least distance between surfaces; < 0 where they overlap
    double neighbour_gap = 0;    ///< least distance between yarns of the same system; 0: pressed
    double squeeze = 0;          ///< share of their width that jammed yarns lost to pass each other
    double warp_crimp = 0;       ///< length of a warp yarn over that of the cloth, less 1
    double weft_crimp = 0;       ///< the same of weft
    double warp_fill = 0;        ///< share of a warp yarn's section that filaments fill
    double weft_fill = 0;        ///< the same of weft
    double warp_decitex = 0;     ///< of a warp yarn: what its filaments weigh, grams per 10 km
    double weft_decitex = 0;     ///< the same of weft
    double mass_per_m2 = 0;      ///< of the cloth, kg, with the length that crimp and twist take up
    double warp_twist_per_m = 0; ///< turns per metre after rounding to whole turns in the repeat
    double weft_twist_per_m = 0; ///< the same of weft
};

/// Filaments of one repeat, centred on z = 0 with the face of the cloth at +z. The turn of a
/// section is counted from the direction across the yarn in the plane of the cloth, right-handed
/// about the path; between the last point and the first it is to be taken modulo a whole turn.
/// Throws Error if the weave fails check_weave, an option is out of range, the repeat would need
/// more than 20 million points, or the yarns find no paths clear of each other.
FilamentRepeat build_filaments(const Weave &weave, const GeometryOptions &options = {});

/// Numbers about the same geometry. Throws like build_filaments.
WeaveReport report_weave(const Weave &weave, const GeometryOptions &options = {});

} // namespace tsuya::lab
