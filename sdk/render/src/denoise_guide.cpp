#include "denoise_guide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "channels.h"

namespace tsuya {
namespace {

constexpr int kVarianceWindow = 3; // half the width of the window in which variances are averaged
// A half has a speck where it is above the other by so many times the mean difference of the halves
// around, and above so many times the median of the values around.
constexpr float kSpeckDifferences = 6, kSpeckMedians = 1.5f;
constexpr std::size_t kLeastAround = 8; // values, to tell a speck by
// Albedos that differ by this share, or by this much, are different.
constexpr float kAlbedoShare = 0.1f, kLeastAlbedo = 0.01f;
// Depths that differ from the plane of a pixel by so many pixels' widths are different.
constexpr float kDepthPixels = 4;

template <class Act> void each_row(int from, int to, Act &&act) {
    tbb::parallel_for(from, to, act);
}

// The one nearer to 0.
float lesser(float a, float b) { return std::abs(a) < std::abs(b) ? a : b; }

} // namespace

GuidePlanes::GuidePlanes(const Film &film, const Camera &camera)
    : x0_(film.tiles.front().x0), y0_(film.tiles.front().y0), x1_(film.tiles.back().x1),
      y1_(film.tiles.back().y1), columns_(static_cast<std::size_t>(x1_ - x0_ + 2 * kMargin)),
      rows_(static_cast<std::size_t>(y1_ - y0_ + 2 * kMargin)) {
    data_.resize(kPlanes * columns_ * rows_);
    specks_.resize(columns_ * rows_);
    tbb::parallel_for(std::size_t{0}, film.tiles.size(), [&](std::size_t t) {
        if (film.done[t] > 1)
            take(film, film.tiles[t], film.done[t]);
    });
    find_specks();
    set_variance();
    set_scales(camera);
    fill_margin();
}

void GuidePlanes::take(const Film &film, const Tile &tile, std::int32_t samples) {
    const std::int32_t of_odd_index = samples / 2;
    const auto n = static_cast<float>(samples), odd = static_cast<float>(of_odd_index);
    const auto groups = static_cast<float>(film.groups);
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const float *all = film.pixel(x, y);
            const float *of_odd = film.odd_sum.data() + (all - film.sum.data());
            for (std::size_t g = 0; g < film.groups; ++g) {
                const auto whole = thirds(all, film.channels), half = thirds(of_odd, film.channels);
                for (std::size_t b = 0; b < kBands; ++b) {
                    *at(kEven + b, x, y) += (whole[b] - half[b]) / ((n - odd) * groups);
                    *at(kOdd + b, x, y) += half[b] / (odd * groups);
                }
                all += film.channels;
                of_odd += film.channels;
            }
            const float *const feature = film.features.data() + film.at(x, y) * kFeatures;
            for (std::size_t f = 0; f < kFeatures; ++f)
                *at(kNormal + f, x, y) = feature[f] / n;
            *at(kValid, x, y) = 1;
        }
}

float GuidePlanes::speck_at(int x, int y) const {
    const auto value = [&](std::size_t half, int i, int j) {
        return *at(half, i, j) + *at(half + 1, i, j) + *at(half + 2, i, j);
    };
    const float even = value(kEven, x, y), odd = value(kOdd, x, y);
    float differences = 0;
    std::size_t count = 0;
    std::array<float, 48> values{};
    for (int j = std::max(y - 2, y0_); j < std::min(y + 3, y1_); ++j)
        for (int i = std::max(x - 2, x0_); i < std::min(x + 3, x1_); ++i) {
            if ((i == x && j == y) || !is_valid(i, j))
                continue;
            values[count] = value(kEven, i, j);
            values[count + 1] = value(kOdd, i, j);
            differences += std::abs(values[count] - values[count + 1]);
            count += 2;
        }
    const float most = kSpeckDifferences * 2 * differences / static_cast<float>(count);
    if (count < kLeastAround || std::abs(even - odd) <= most)
        return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    if (std::max(even, odd) <= kSpeckMedians * *middle)
        return 0;
    return even > odd ? (odd + most) / even : -(even + most) / odd;
}

// The other half stands for a half with a speck.
void GuidePlanes::find_specks() {
    each_row(y0_, y1_, [&](int y) {
        for (int x = x0_; x < x1_; ++x)
            if (is_valid(x, y))
                specks_[index(0, x, y)] = speck_at(x, y);
    });
    each_row(y0_, y1_, [&](int y) {
        for (int x = x0_; x < x1_; ++x)
            if (const float speck = specks_[index(0, x, y)]; speck != 0)
                for (std::size_t b = 0; b < kBands; ++b)
                    *at((speck > 0 ? kEven : kOdd) + b, x, y) =
                        *at((speck > 0 ? kOdd : kEven) + b, x, y);
    });
}

// Of each half: half the squared difference of the two, averaged over a window. [Rousselle2012]
void GuidePlanes::set_variance() {
    std::vector<float> sums(columns_ * rows_), counts(columns_ * rows_);
    for (std::size_t b = 0; b < kBands; ++b) {
        each_row(y0_, y1_, [&](int y) {
            for (int x = x0_; x < x1_; ++x) {
                float sum = 0, count = 0;
                for (int i = std::max(x - kVarianceWindow, x0_);
                     i < std::min(x + kVarianceWindow + 1, x1_); ++i) {
                    const float difference = *at(kEven + b, i, y) - *at(kOdd + b, i, y);
                    const bool counted = is_valid(i, y) && specks_[index(0, i, y)] == 0;
                    sum += counted ? 0.5f * difference * difference : 0.0f;
                    count += counted ? 1.0f : 0.0f;
                }
                sums[index(0, x, y)] = sum;
                counts[index(0, x, y)] = count;
            }
        });
        each_row(y0_, y1_, [&](int y) {
            for (int x = x0_; x < x1_; ++x) {
                float sum = 0, count = 0;
                for (int j = std::max(y - kVarianceWindow, y0_);
                     j < std::min(y + kVarianceWindow + 1, y1_); ++j) {
                    sum += sums[index(0, x, j)];
                    count += counts[index(0, x, j)];
                }
                *at(kVariance + b, x, y) = count > 0 ? sum / count : 0.0f;
            }
        });
    }
}

void GuidePlanes::set_scales(const Camera &camera) {
    // Of a pixel in a perspective, or by parallel rays
    const auto angle = static_cast<float>(
        camera.orthographic_height ? 0.0 : camera.vertical_angle / camera.height);
    const auto size = static_cast<float>(camera.orthographic_height ? pixel_width(camera, 0) : 0.0);
    each_row(y0_, y1_, [&](int y) {
        for (int x = x0_; x < x1_; ++x) {
            const float z = *at(kDepth, x, y);
            const float left = *at(kDepth, std::max(x - 1, x0_), y);
            const float right = *at(kDepth, std::min(x + 1, x1_ - 1), y);
            const float above = *at(kDepth, x, std::max(y - 1, y0_));
            const float below = *at(kDepth, x, std::min(y + 1, y1_ - 1));
            const float along_x = lesser(z - left, right - z),
                        along_y = lesser(z - above, below - z);
            *at(kDepthX, x, y) = along_x;
            *at(kDepthY, x, y) = along_y;
            const float width =
                kDepthPixels * (angle * z + size) + 2 * (std::abs(along_x) + std::abs(along_y));
            *at(kDepthScale, x, y) = width > 0 ? 1 / (width * width) : 0.0f;
            float albedo = 0;
            for (std::size_t b = 0; b < kBands; ++b)
                albedo = std::max(albedo, *at(kAlbedo + b, x, y));
            const float differs = kLeastAlbedo + kAlbedoShare * albedo;
            *at(kAlbedoScale, x, y) = 1 / (differs * differs);
        }
    });
}

// With what stands at the edge, but not valid.
void GuidePlanes::fill_margin() {
    tbb::parallel_for(std::size_t{0}, kValid, [&](std::size_t plane) {
        for (int y = y0_ - kMargin; y < y1_ + kMargin; ++y)
            for (int x = x0_ - kMargin; x < x1_ + kMargin; ++x)
                *at(plane, x, y) =
                    *at(plane, std::clamp(x, x0_, x1_ - 1), std::clamp(y, y0_, y1_ - 1));
    });
}

} // namespace tsuya
