#pragma once
/// \file
/// From a scene to lamp-free light transport.

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/phase.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/prepared_scene.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/scene.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// When a render is done: at the first that is reached.
struct StopRule {
    int samples_per_pixel = 64; ///< 1 to 65536; at most, where an error is given
    /// Each part of the picture is done when the mean absolute error of its pixels is below this
    /// share of their mean value, or of a twentieth of what a tenth of the parts exceed, where they
    /// are darker: smooth parts are done first. Where channels are depths of dye, both at the
    /// darkest and at the lightest of them. Above 0, finite.
    std::optional<double> relative_error{};
    /// Of tracing, over all runs that a checkpoint joins; not reproducible. Above 0, finite.
    std::optional<double> seconds{};
};

struct RenderResult;

/// Settings of `render` beside the scene.
struct RenderSettings {
    StopRule stop{};
    int channels = 16;    ///< 8, 16 or 32
    int max_bounces = 12; ///< 0: direct light only; 1 to 4096: further scattering
    int threads = 0;      ///< 0: all
    std::uint32_t seed = 0;
    std::optional<std::array<int, 4>> crop{}; ///< x0, y0, x1, y1 in pixels, half open
    std::vector<std::string> aovs{};          ///< names of AOVs, see aov_names; each once
    /// Keeps what part of each pixel objects cover, see SpectralImage::alpha. The camera does not
    /// see lights and the environment then; objects see them as before.
    bool alpha = false;
    /// Filters the noise out of the finished picture, guided by what the camera sees: for pictures
    /// to be looked at, not for measurements. Every light group and channel of a pixel is filtered
    /// by the same weights, and so is alpha, so that the picture can be relit as before. Needs 2
    /// samples per pixel.
    /// An interrupted render and snapshots are not filtered, nor are the AOVs.
    bool denoise = false;
    /// Light that was scattered diffusely meets wider lobes from then on, see widened_material.h:
    /// for pictures to be looked at, not for measurements. It takes the specks out of a picture and
    /// changes its energy a little, see RenderStats::widening_change.
    bool widen_after_diffuse = false;
    /// false: do even what the plan shows to be idle; the picture must not change
    bool skip = true;
    /// The same of some features, by their names, see feature_names; those that are there only
    /// where they are asked for, such as a lens, have nothing to keep.
    std::vector<std::string> keep{};
    /// The file in which a render keeps what it has; empty: none. Replaced atomically while it
    /// runs, and at its end, interrupted or not: it is the caller who removes it, once the picture
    /// is safe. A checkpoint that cannot be written does not end the render, see
    /// RenderResult::warnings; an older one stays whole then.
    std::filesystem::path checkpoint{};
    double checkpoint_seconds = 60; ///< between checkpoints, finite; 0: only at the end
    /// Go on from `checkpoint` if that file exists. A checkpoint of a render that is complete gives
    /// its picture at once.
    bool resume = false;
    /// Where it becomes true (a signal handler may set it), the render sets it to false and gives
    /// the picture so far to `snapshot`: within about a second, on the thread that called `render`
    /// or one of its workers, with no tile half done. The render goes on afterwards, to the same
    /// bits. Nothing happens before the first tile is traced. What `snapshot` throws ends the
    /// render.
    std::atomic<bool> *snapshot_wanted = nullptr;
    std::function<void(const RenderResult &)> snapshot{};
};

/// Names of AOVs for RenderSettings::aovs. Each is a mean over all samples of a pixel, of which
/// those that meet nothing count as 0; what is not asked for is not computed. None is denoised. A
/// light that the camera sees straight counts as direct and as surface.
/// - coverage, garment (A): share of the pixel that objects cover, that garments cover
/// - depth (Z): distance from the eye, the lens or the eye's plane, metres
/// - normal, warp, weft (X, Y, Z): unit directions in the scene, of the shading normal on the
///   viewer's side and of the yarns
/// - uv (U, V): place on the cloth, metres
/// - albedo (T.400,000nm, ...): share of light that the dyed part reflects, without the surface of
///   its fibres
/// - direct, indirect (key.T.400,000nm, ...): transport straight from lights to what the camera
///   sees, and all other; together the transport
/// - surface, body (the same): transport to the camera by the surface of the fibres, and by their
///   dyed part and through the cloth; together the transport
/// - samples (Y): number of the pixel's
/// - error (Y): half the difference of two independent halves of the samples, of the mean over
///   groups and channels; of one pixel in four, which stands for its neighbours, unless
///   StopRule::relative_error or RenderSettings::denoise is set
/// - CryptoObject, CryptoFabric, CryptoPanel (CryptoObject00.R, ...): ids and coverage of the six
///   names that cover most, largest first, as [Cryptomatte] has them: of the object, of the fabric
///   on the side that is seen, and OBJECT/PANEL. The image's metadata have the names
///   (cryptomatte/...)
std::vector<std::string> aov_names();

/// Rays by what they look for. One that goes on through a hole counts again.
struct RayCounts {
    std::uint64_t camera = 0; ///< what the camera sees
    std::uint64_t shadow = 0; ///< what keeps light from cloth
    std::uint64_t bounce = 0; ///< what light comes from to cloth

    std::uint64_t all() const { return camera + shadow + bounce; } ///< the sum
    RayCounts &operator+=(const RayCounts &other) {                ///< adds kind by kind
        camera += other.camera;
        shadow += other.shadow;
        bounce += other.bounce;
        return *this;
    }
    bool operator==(const RayCounts &) const = default;
};

/// What a render did.
struct RenderStats {
    double samples_per_pixel = 0; ///< mean over the picture
    double seconds = 0;
    double build_seconds = 0; ///< of the BVH and the materials
    /// Estimate of the mean absolute error of the pixels, all groups and channels together, over
    /// their mean value; where channels are depths of dye, the larger one of those at the darkest
    /// and at the lightest depth. Where StopRule::relative_error is given, all pixels tell it, else
    /// a quarter of them, whose samples are spread a little less evenly: it is somewhat too high
    /// then.
    double relative_error = 0;
    std::optional<double> error_asked{}; ///< StopRule::relative_error
    /// The part of the picture that reached it; 1 where none was asked for.
    double error_reached_share = 1;
    /// By which share RenderSettings::denoise changed the mean of the picture; empty where it was
    /// not done. The errors are those of the picture before.
    std::optional<double> denoise_change{};
    std::uint64_t samples = 0; ///< of all pixels
    /// By which share RenderSettings::widen_after_diffuse changed the mean of the picture: an
    /// estimate from one sample of eight, the noisier the narrower the lobes. Empty where nothing
    /// was widened.
    std::optional<double> widening_change{};
    RayCounts rays{};
    std::uint64_t not_finite = 0; ///< samples left out because they were NaN or infinite
    std::uint64_t triangles = 0;
    std::vector<Phase> phases{};         ///< those that were done of: bvh, tables, trace, denoise
    PreparedUse prepared{};              ///< what this render built, and what it found
    std::uint64_t peak_memory_bytes = 0; ///< of the process, up to the end of the render
    bool interrupted = false;
};

/// The light transport, what was done for it, and warnings for the user.
struct RenderResult {
    SpectralImage image{};
    RenderStats stats{};
    /// What went wrong and did not cost the picture: samples that are not finite, fabric_warnings,
    /// a checkpoint that could not be written. To be shown.
    std::vector<Problem> warnings{};
};

/// A key of all that decides a picture: hashes of scene, settings and stop rule, 48 hexadecimal
/// digits. A render with a checkpoint that is complete has it in its image's metadata as
/// "render_key".
std::string render_key(const Scene &scene, const RenderSettings &settings);

/// Renders. On one build the picture is bit-identical for any number of threads, and after stop and
/// resume (stops by time excepted). Throws Error for a scene or settings that break their rules,
/// for more memory than is available, and where more than 1 % of the first samples are not finite.
/// Where progress.stop becomes true, returns what it has with stats.interrupted set; stopped during
/// preparation that is a picture of 0, or what the checkpoint had.
/// \param prepared gives what renders before have built and gets what this one builds; may be null.
/// The picture is the same.
RenderResult render(const Scene &scene, const RenderSettings &settings,
                    const Progress &progress = {}, PreparedScene *prepared = nullptr);

} // namespace tsuya
