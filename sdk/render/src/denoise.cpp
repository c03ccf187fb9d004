#include "denoise.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <numeric>

#include <tbb/parallel_for.h>

#include "denoise_guide.h"
#include "tsuya/sdk/detail/flush_denormals.h"

namespace tsuya {
namespace {

using Planes = GuidePlanes;

// Patches that differ by more than this share of their noise are different. [Rousselle2012]
constexpr float kStrength = 0.45f;
// Directions that differ by so much are different: of normals and of warps.
constexpr float kNormalWidth = 0.3f, kWarpWidth = 0.5f;
constexpr float kObjectWidth = 0.2f; // of an object's index, in pixels that see several
constexpr float kLeastVariance = 1e-10f;

constexpr float square(float v) { return v * v; }

// Nearly exp(-distance), 0 from 8 on.
inline float bump(float distance) {
    const float root = std::max(0.0f, 1 - 0.125f * distance);
    return square(square(square(root)));
}

// One tile and what lies around it.
class TileFilter {
  public:
    TileFilter(const Film &film, const GuidePlanes &guide, const Tile &tile)
        : film_(film), guide_(guide), tile_(tile), width_(tile.x1 - tile.x0),
          height_(tile.y1 - tile.y0),
          transport_(film.groups * static_cast<std::size_t>(film.channels)),
          values_(transport_ + (film.covered.empty() ? 0 : 1)), even_(take(0)), odd_(take(1)) {}

    // Sets the pixels of the tile.
    void run(SpectralImage &image) {
        const auto pixels = static_cast<std::size_t>(width_ * height_);
        sums_.assign(2 * pixels * values_, 0.0f);
        weights_.assign(2 * pixels, 0.0f);
        for (int dy = -kWindow; dy <= kWindow; ++dy)
            for (int dx = -kWindow; dx <= kWindow; ++dx) {
                compare_pixels(dx, dy);
                for (int y = 0; y < height_; ++y) {
                    compare_patches(y);
                    weigh(y, dx, dy);
                    add(y, dx, dy);
                }
            }
        write(image);
    }

  private:
    static constexpr int kMostPixels = 32 + 2 * kPatch; // in a row of a tile and its patches
    using Row = std::array<float, kMostPixels>;

    // Means of a half, in the tile and a window around it. [y][x][group][k]
    std::vector<float> take(int half) const;
    void compare_pixels(int dx, int dy);
    void compare_patches(int y);
    void weigh(int y, int dx, int dy);
    void add(int y, int dx, int dy);
    void write(SpectralImage &image) const;

    const Film &film_;
    const GuidePlanes &guide_;
    Tile tile_;
    int width_, height_;
    std::size_t transport_, values_; // of a pixel, with alpha
    std::vector<float> even_, odd_;
    std::vector<float> sums_{}, weights_{}; // [half][y][x], of the sums [group][k]
    std::array<std::array<Row, kMostPixels>, 2> pixel_distance_{}; // [half][y][x], with patches
    std::array<Row, 2> patch_distance_{};                          // [half][x]
    std::array<Row, 2> weight_{};
};

std::vector<float> TileFilter::take(int half) const {
    const int across = width_ + 2 * kWindow, down = height_ + 2 * kWindow;
    std::vector<float> means(static_cast<std::size_t>(across * down) * values_);
    float *to = means.data();
    for (int y = tile_.y0 - kWindow; y < tile_.y1 + kWindow; ++y)
        for (int x = tile_.x0 - kWindow; x < tile_.x1 + kWindow; ++x, to += values_) {
            if (!guide_.is_valid(x, y))
                continue;
            const std::int32_t n = film_.samples_at(x, y), odd = n / 2;
            const float *const all = film_.pixel(x, y);
            const float *const of_odd = film_.odd_sum.data() + (all - film_.sum.data());
            const float scale =
                guide_.scale(half, x, y) / static_cast<float>(half == 0 ? n - odd : odd);
            for (std::size_t i = 0; i < transport_; ++i)
                to[i] = scale * (half == 0 ? all[i] - of_odd[i] : of_odd[i]);
            if (!film_.covered.empty())
                to[transport_] = film_.covered[film_.at(x, y)] / static_cast<float>(n);
        }
    return means;
}

// Squared differences of the bands over their variance, less what noise alone makes of them.
// [Rousselle2012] Eq. 5
void TileFilter::compare_pixels(int dx, int dy) {
    const int across = width_ + 2 * kPatch, down = height_ + 2 * kPatch;
    for (int y = 0; y < down; ++y) {
        const int px = tile_.x0 - kPatch, py = tile_.y0 - kPatch + y;
        float *const of_even = pixel_distance_[0][static_cast<std::size_t>(y)].data();
        float *const of_odd = pixel_distance_[1][static_cast<std::size_t>(y)].data();
        std::fill_n(of_even, across, 0.0f);
        std::fill_n(of_odd, across, 0.0f);
        for (std::size_t b = 0; b < Planes::kBands; ++b) {
            const float *const p_even = guide_.at(Planes::kEven + b, px, py);
            const float *const q_even = guide_.at(Planes::kEven + b, px + dx, py + dy);
            const float *const p_odd = guide_.at(Planes::kOdd + b, px, py);
            const float *const q_odd = guide_.at(Planes::kOdd + b, px + dx, py + dy);
            const float *const p_var = guide_.at(Planes::kVariance + b, px, py);
            const float *const q_var = guide_.at(Planes::kVariance + b, px + dx, py + dy);
            for (int x = 0; x < across; ++x) {
                const float noise = p_var[x] + std::min(p_var[x], q_var[x]);
                const float scale =
                    1 /
                    (Planes::kBands * (kLeastVariance + square(kStrength) * (p_var[x] + q_var[x])));
                of_even[x] += (square(p_even[x] - q_even[x]) - noise) * scale;
                of_odd[x] += (square(p_odd[x] - q_odd[x]) - noise) * scale;
            }
        }
    }
}

void TileFilter::compare_patches(int y) {
    constexpr float kScale = 1.0f / square(2 * kPatch + 1);
    for (std::size_t half = 0; half < 2; ++half) {
        Row column{};
        for (int j = 0; j <= 2 * kPatch; ++j) {
            const Row &row = pixel_distance_[half][static_cast<std::size_t>(y + j)];
            for (std::size_t x = 0; x < column.size(); ++x)
                column[x] += row[x];
        }
        Row &to = patch_distance_[half];
        for (int x = 0; x < width_; ++x) {
            float sum = 0;
            for (int i = 0; i <= 2 * kPatch; ++i)
                sum += column[static_cast<std::size_t>(x + i)];
            to[static_cast<std::size_t>(x)] = std::max(0.0f, sum * kScale);
        }
    }
}

void TileFilter::weigh(int y, int dx, int dy) {
    const int px = tile_.x0, py = tile_.y0 + y;
    Row features{};
    const auto add_squares = [&](std::size_t plane, std::size_t count, auto &&scale) {
        for (std::size_t c = plane; c < plane + count; ++c) {
            const float *const p = guide_.at(c, px, py);
            const float *const q = guide_.at(c, px + dx, py + dy);
            for (int x = 0; x < width_; ++x)
                features[static_cast<std::size_t>(x)] += square(p[x] - q[x]) * scale(x);
        }
    };
    add_squares(Planes::kNormal, 3, [](int) { return 1 / square(kNormalWidth); });
    add_squares(Planes::kWarp, 3, [](int) { return 1 / square(kWarpWidth); });
    add_squares(Planes::kObject, 1, [](int) { return 1 / square(kObjectWidth); });
    const float *const albedo_scale = guide_.at(Planes::kAlbedoScale, px, py);
    add_squares(Planes::kAlbedo, 3, [&](int x) { return albedo_scale[x]; });
    const float *const p = guide_.at(Planes::kDepth, px, py);
    const float *const q = guide_.at(Planes::kDepth, px + dx, py + dy);
    const float *const along_x = guide_.at(Planes::kDepthX, px, py);
    const float *const along_y = guide_.at(Planes::kDepthY, px, py);
    const float *const depth_scale = guide_.at(Planes::kDepthScale, px, py);
    const float *const valid = guide_.at(Planes::kValid, px + dx, py + dy);
    const auto fx = static_cast<float>(dx), fy = static_cast<float>(dy);
    for (int i = 0; i < width_; ++i) {
        const auto x = static_cast<std::size_t>(i);
        const float off_plane = q[i] - p[i] - fx * along_x[i] - fy * along_y[i];
        const float feature = features[x] + square(off_plane) * depth_scale[i];
        // Each half by the other's weights
        weight_[0][x] = valid[i] * bump(feature + patch_distance_[1][x]);
        weight_[1][x] = valid[i] * bump(feature + patch_distance_[0][x]);
    }
}

void TileFilter::add(int y, int dx, int dy) {
    const auto across = static_cast<std::size_t>(width_ + 2 * kWindow);
    const auto row = static_cast<std::size_t>(y * width_);
    const auto pixels = static_cast<std::size_t>(width_ * height_);
    for (std::size_t half = 0; half < 2; ++half) {
        const float *from = (half == 0 ? even_ : odd_).data() +
                            (static_cast<std::size_t>(y + dy + kWindow) * across +
                             static_cast<std::size_t>(dx + kWindow)) *
                                values_;
        float *to = sums_.data() + (half * pixels + row) * values_;
        for (std::size_t x = 0; x < static_cast<std::size_t>(width_); ++x) {
            const float w = weight_[half][x];
            if (w > 0) {
                for (std::size_t i = 0; i < values_; ++i)
                    to[i] += w * from[i];
                weights_[half * pixels + row + x] += w;
            }
            from += values_;
            to += values_;
        }
    }
}

void TileFilter::write(SpectralImage &image) const {
    const auto pixels = static_cast<std::size_t>(width_ * height_);
    const auto channels = static_cast<std::size_t>(film_.channels);
    for (std::size_t p = 0; p < pixels; ++p) {
        const int x = tile_.x0 + static_cast<int>(p) % width_;
        const int y = tile_.y0 + static_cast<int>(p) / width_;
        const float of_even = 0.5f / weights_[p], of_odd = 0.5f / weights_[pixels + p];
        const float *even = sums_.data() + p * values_;
        const float *odd = sums_.data() + (pixels + p) * values_;
        for (std::size_t g = 0; g < film_.groups; ++g) {
            float *const to = image.pixel(g, x, y);
            for (std::size_t k = 0; k < channels; ++k)
                to[k] = of_even * *even++ + of_odd * *odd++;
        }
        if (image.alpha)
            *image.alpha->pixel(x, y) = of_even * *even + of_odd * *odd;
    }
}

double total(const SpectralImage &image) {
    return std::accumulate(image.transport.begin(), image.transport.end(), 0.0);
}

} // namespace

std::optional<double> denoise(const Film &film, const Camera &camera, SpectralImage &image,
                              const Progress &progress) {
    progress("denoise", 0);
    const double before = total(image);
    const GuidePlanes guide(film, camera);
    std::atomic<std::size_t> finished{0};
    std::mutex reporting;
    tbb::parallel_for(std::size_t{0}, film.tiles.size(), [&](std::size_t t) {
        if (progress.stopped())
            return;
        const detail::FlushDenormals flush;
        if (film.done[t] > 1)
            TileFilter(film, guide, film.tiles[t]).run(image);
        ++finished;
        if (const std::unique_lock lock(reporting, std::try_to_lock); lock)
            progress("denoise",
                     static_cast<double>(finished) / static_cast<double>(film.tiles.size()));
    });
    if (finished < film.tiles.size())
        return {};
    return before > 0 ? total(image) / before - 1 : 0.0;
}

} // namespace tsuya
