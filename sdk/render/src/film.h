#pragma once
// The sums over samples that a picture is made of, tile by tile.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aov.h"
#include "tsuya/sdk/detail/checkpoint.h"
#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/render.h"

namespace tsuya {

// Errors count against at least this share of a bright part's value, see Film::bright_value.
inline constexpr double kDark = 0.05;

// Depths of dye by which errors are judged.
inline constexpr std::size_t kJudgedDepths = 2;

// What guides the denoiser: normal, warp, albedo in three bands of wavelength, depth, object.
inline constexpr std::size_t kFeatures = 11;

struct Tile {
    int x0, y0, x1, y1;
};

// Sums over samples. Each tile knows how many samples its pixels have.
struct Film {
    Film(const Scene &scene, const RenderSettings &settings);

    int width, height, channels;
    std::size_t groups;
    std::vector<Tile> tiles{};
    std::vector<std::int32_t> done{}; // samples per pixel, per tile
    std::vector<float> sum{};         // [y][x][group][k]
    // [y][x], of the mean over groups and channels: the samples of even index less the others
    std::vector<float> difference{};
    // Where channels are depths of dye, [y][x][depth] of the same, for the mean over groups at the
    // darkest and at the lightest depth; empty elsewhere. A dark dye has relatively more noise, so
    // it is by these that errors are judged.
    std::vector<float> depth_difference{};
    // Whether every pixel's samples are split into two independent sequences, so that their
    // difference tells the error. Else one pixel of four is: one sequence has the smaller error.
    bool all_split;
    std::vector<Aov> aovs;
    std::vector<Image> aov_sums{}; // of aovs
    std::vector<float> covered{};  // [y][x], samples that meet an object, where alpha is wanted
    // For the denoiser, empty where there is none: of the samples of odd index, [y][x][group][k],
    // and of what the camera sees, [y][x][kFeatures].
    std::vector<float> odd_sum{}, features{};
    // Per tile, empty where nothing is widened: see PathTracer::change_by_widening, and samples
    // that told it.
    std::vector<double> change{};
    std::vector<std::uint64_t> told{};
    // kDark of bright_value after the first pass: what is rendered must not depend on how far
    // other tiles are. 0 before. Of the mean over channels, or of each judged depth.
    std::array<double, kJudgedDepths> dark{};
    // The channels of the darkest and of the lightest depth; known when cloths are prepared.
    std::array<std::uint32_t, kJudgedDepths> judged_channel{};
    // What the cloths can show of each dye of the plan at most; known when they are prepared.
    std::array<double, kMostDyes> most_dye{1, 1};
    std::uint64_t not_finite = 0; // samples left out of the sums
    RayCounts rays{};
    double seconds = 0; // of tracing, over all runs

    // Bytes of a film and of the picture that is made of it.
    static std::uint64_t bytes_needed(const Scene &scene, const RenderSettings &settings);

    float *pixel(int x, int y) {
        return sum.data() + at(x, y) * groups * static_cast<std::size_t>(channels);
    }
    const float *pixel(int x, int y) const {
        return sum.data() + at(x, y) * groups * static_cast<std::size_t>(channels);
    }
    // Traced so far, those that are not finite too.
    std::uint64_t samples() const;
    double samples_per_pixel() const; // the mean
    // Estimate of the mean absolute error of the pixels of a tile over their mean value, or over
    // `dark` where they are darker; infinite before there are two samples. Of pixels that are
    // split, the samples of even and of odd index are independent estimates: half their difference
    // is distributed as the error of their mean. Of depths of dye it is the larger one of those
    // that are judged.
    double relative_error(std::size_t tile) const;
    // The same for the whole picture; infinite where no pixel is split.
    double relative_error() const;
    // Sets `dark`, where it is not set.
    void find_dark();
    // Sets what the channels are.
    void set_depths(const DyeDepths &depths);
    // The part of the picture in tiles whose error is at most this.
    double share_within(double error) const;
    // See RenderStats::widening_change.
    std::optional<double> widening_change() const;
    // Means of the sums.
    SpectralImage develop(const Scene &scene, const RenderSettings &settings) const;
    // Of a pixel in a tile.
    std::int32_t samples_at(int x, int y) const;
    // Of a pixel, over groups and channels too.
    double pixel_mean(int x, int y, std::int32_t samples) const;
    // Half the difference of the means of the two halves of a split pixel's samples, of which there
    // are two or more. \param mean of both
    double pixel_error(int x, int y, std::int32_t samples, double mean) const;
    // See all_split.
    bool is_split(int x, int y) const { return all_split || (x % 2 == 0 && y % 2 == 0); }
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }

  private:
    // Sums over the split pixels of a tile of errors and of values.
    struct TileError {
        double errors = 0, values = 0, pixels = 0;
    };
    // Means of a pixel by which errors are judged: that over all channels, or those at depths.
    std::size_t judged_count() const { return depth_difference.empty() ? 1 : kJudgedDepths; }
    double judged_mean(int x, int y, std::int32_t samples, std::size_t judged) const;
    TileError tile_error(std::size_t tile, std::size_t judged) const;
    // Of a tile: a tenth of them are brighter (not the brightest, which may show a lamp).
    double bright_value(std::size_t judged) const;
};

// What must be the same for a render to go on: hashes of scene and settings.
detail::Fingerprint fingerprint(const Scene &scene, const RenderSettings &settings);

// Of each fabric of the scene, 16 hexadecimal digits that change where the fabric does, by keys for
// the metadata of a picture.
std::map<std::string, std::string> fabric_hashes(const Scene &scene);

// The render_key of what has that fingerprint.
std::string render_key(const detail::Fingerprint &fingerprint, const StopRule &stop);

} // namespace tsuya
