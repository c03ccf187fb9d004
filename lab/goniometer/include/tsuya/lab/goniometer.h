#pragma once
/// \file
/// The virtual goniometer: the reflectance of a weave that exists only as filaments, found by
/// tracing photons.
///
/// A photon starts above a uniformly random point of one repeat and meets filaments. At the surface
/// of a filament it is reflected by facets whose slopes are Gaussian (Beckmann's distribution with
/// Smith's shadowing [Walter]) with the exact Fresnel term of unpolarised light. What single
/// reflections lose in the roughness comes back as a broad lobe [KullaConty], so that the surface
/// alone neither makes nor loses light.
///
/// What enters a filament whose `transmission` is 0 is lost. Any other filament is a body with a
/// rough boundary: light refracts in and out by the same facets and the exact Fresnel term, total
/// reflection included, and is absorbed along its way by the dye. What the roughness loses there
/// comes back too, so that a clear filament keeps all light. Particles of delustrant in it turn
/// light by the angle of [Henyey], after ways of exponential lengths. All of this is reciprocal.
/// Where light goes through filaments, all of them are made thinner by one factor until each two
/// are apart by 1 % of the sum of their radii; an overlap of more than 20 % is an error.
///
/// At every hit one of the asked views is chosen, in proportion to what it would see, and
/// connected by a ray: values are of the exact direction, without a solid angle about it.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/lab/filaments.h"
#include "tsuya/sdk/directions.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::lab {

/// Which light is measured.
enum class LightPart {
    all,
    surface, ///< light that never entered a filament
    body     ///< light that has been in one: what the dye colours
};

/// How long to trace, what is counted, and how finely filaments are built.
struct GoniometerSettings {
    /// Per direction of light, > 0; rounded up to whole batches of kPhotonsPerBatch.
    std::uint64_t photons = 1u << 20;
    /// A light is done when the sum of the standard errors of its views is this share of the sum of
    /// their values; 0: at `photons` only.
    double error = 0;
    double seconds = 0;     ///< stop after about this long; 0: never. The one stop that varies
    std::uint32_t seed = 1; ///< other seeds give independent results
    int threads = 0;        ///< 0: all. The result does not depend on it
    LightPart part = LightPart::all; ///< of what leaves the cloth; energies are of it too
    int max_bounces = 0;             ///< reflections after the first that are followed; 0: all
    /// Photons with less energy than this, of 1 at the start, play Russian roulette: they end, or
    /// go on with this energy, so that nothing is lost on average. In (0, 1].
    double energy_bound = 0.5;
    double turn_per_segment = 0.02; ///< of a round filament's axis, radians; of others 5 times it
    int section_points = 24;        ///< of a section that is not round, 12 to 256
    /// Where the sums are kept every 30 seconds and at a stop; empty: nowhere. The caller removes
    /// it when the table is written: a table that cannot be written costs half a minute then.
    std::filesystem::path checkpoint{};
    bool resume = false; ///< go on from `checkpoint` if it is there
};

/// Photons of one batch: the grain of determinism, of stopping and of the checkpoint.
inline constexpr std::uint64_t kPhotonsPerBatch = 8192;

/// The energy of one direction of light, shares of what arrived, with their standard errors.
struct LightReport {
    double theta_i = 0, phi_i = 0; ///< radians
    std::uint64_t photons = 0;
    double reflected = 0, reflected_sigma = 0;
    double transmitted = 0, transmitted_sigma = 0;
    double relative_error = 0; ///< as of GoniometerSettings::error
};

/// What `measure` found.
struct Measurement {
    /// Rows in the order of the pairs, with sigma_per_sr; without those of lights of no photon.
    ReflectanceTable table{};
    std::vector<LightReport> lights{};
    std::uint64_t photons = 0, rays = 0; ///< of this run, without what was resumed
    double seconds = 0;                  ///< of this run
    bool interrupted = false;            ///< by progress.stop; what there is, is given
};

/// Measures. On one build the result is bit-identical for any number of threads and after stop and
/// resume (stops by time excepted). Throws Error: no directions, angles out of range, settings out
/// of range, a repeat that breaks its rules, a slope deviation outside [0.005, 0.5], a checkpoint
/// of another measurement.
Measurement measure(const FilamentRepeat &repeat, const Directions &directions,
                    const GoniometerSettings &settings, const Progress &progress = {});

} // namespace tsuya::lab
