#pragma once
/// \file
/// Table 4 of [Takeda]: errors on the ring theta_r = 60 degrees under light at theta_i = 45
/// degrees.

#include <vector>

namespace tsuya::program {

/// Errors of an estimate on a ring of views.
struct RingError {
    double peak_per_cent = 0; ///< difference of the largest values over the largest true one
    double mean_per_cent = 0; ///< mean difference over phi_r over the same
};

/// One plane of incidence.
struct RingErrors {
    const char *plane = "";
    double phi_i_deg = 0;
    double paper_peak_per_sr = 0, paper_peak_per_cent = 0, paper_mean_per_cent = 0;
    RingError ours{};    ///< great-circle form
    RingError printed{}; ///< Eqs. 16-17 as printed
};

/// What the paper's columns are of, and what ours are of.
extern const char *const kRingNote;

/// Weft, bias and warp plane. Ours are those of GGX facets (0.45 along the weft, 0.12 along the
/// warp, f0 0.06), whose views under light from straight above the models get.
std::vector<RingErrors> ring_errors();

} // namespace tsuya::program
