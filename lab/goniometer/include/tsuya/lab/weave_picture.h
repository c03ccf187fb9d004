#pragma once
/// \file
/// The picture of a weave close up, and its draft as point paper.
///
///     const Image cloth = weave_picture(weave("silk charmeuse"));

#include "tsuya/lab/weave.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::lab {

/// Size and view of a picture of a weave.
struct WeavePictureSettings {
    int width = 900, height = 900; ///< pixels, 16 to 8192
    /// Metres of cloth from left to right; 0: a whole repeat in both directions, no less than 4
    /// crossings and no more than 12.
    double across = 0;
    double tilt = 0;            ///< of the viewer from straight above to -y, radians, 0 to 1.3
    int samples_per_pixel = 16; ///< a square number, 1 to 1024
    int threads = 0;            ///< 0: all. The picture does not depend on it
    GeometryOptions geometry{}; ///< of the filaments
};

/// Metres of cloth that the picture has from left to right.
double width_of_picture(const Weave &weave, const WeavePictureSettings &settings = {});

/// The filaments of the weave from the face, without perspective, the warp upright and the first
/// end and pick at the lower left: linear R, G, B (Rec. 709) in [0, 1]. A lamp stands at the upper
/// left, a sky of even light above all. Colours are the transmission of the yarns; black ones are
/// drawn as dark grey, and the picture is as bright as its brightest yarn lets it be: this is a
/// picture to read the weave from, not a measurement. The lower left corner has a bar whose length
/// is scale_bar. Throws Error: settings out of range, and as build_filaments; Interrupted.
Image weave_picture(const Weave &weave, const WeavePictureSettings &settings = {},
                    const Progress &progress = {});

/// The draft as point paper, as if drawn on the same part of the cloth and seen from the same side:
/// a crossing with the warp above is dark, one with the weft above bright, and a frame is
/// around the first repeat. Throws Error: settings out of range, and as check_weave.
Image draft_picture(const Weave &weave, const WeavePictureSettings &settings = {});

/// Length of the bar, metres: 1, 2 or 5 times a power of ten, about a fifth of the width.
double scale_bar(const Weave &weave, const WeavePictureSettings &settings = {});

} // namespace tsuya::lab
