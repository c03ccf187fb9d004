#pragma once
// What the denoiser compares pixels by: planes of the part of a picture that is rendered, with a
// margin all around so that no window needs to look at edges.

#include <cmath>
#include <cstdint>
#include <vector>

#include "film.h"

namespace tsuya {

// Half the width of the window whose pixels are averaged, and of the patches that are compared.
inline constexpr int kWindow = 8, kPatch = 3;

struct GuidePlanes {
    static constexpr int kMargin = kWindow + kPatch;
    static constexpr std::size_t kBands = 3; // of wavelength, over all light groups
    // Indices of planes; the features have the order of Film::features
    static constexpr std::size_t kEven = 0, kOdd = kEven + kBands, kVariance = kOdd + kBands,
                                 kNormal = kVariance + kBands, kWarp = kNormal + 3,
                                 kAlbedo = kWarp + 3, kDepth = kAlbedo + 3, kObject = kDepth + 1,
                                 kDepthX = kObject + 1, kDepthY = kDepthX + 1,
                                 kDepthScale = kDepthY + 1, kAlbedoScale = kDepthScale + 1,
                                 kValid = kAlbedoScale + 1, kPlanes = kValid + 1;

    GuidePlanes(const Film &film, const Camera &camera);

    // A row of a plane from the pixel on; coordinates of the picture.
    const float *at(std::size_t plane, int x, int y) const {
        return data_.data() + index(plane, x, y);
    }
    // Of the samples of a half (0: even, 1: odd) at a pixel: 1, or below where it has a speck.
    float scale(int half, int x, int y) const {
        const float speck = specks_[index(0, x, y)];
        return (half == 0 ? speck > 0 : speck < 0) ? std::abs(speck) : 1.0f;
    }
    bool is_valid(int x, int y) const { return *at(kValid, x, y) > 0; }

  private:
    float *at(std::size_t plane, int x, int y) { return data_.data() + index(plane, x, y); }
    std::size_t index(std::size_t plane, int x, int y) const {
        return (plane * rows_ + static_cast<std::size_t>(y - y0_ + kMargin)) * columns_ +
               static_cast<std::size_t>(x - x0_ + kMargin);
    }
    void take(const Film &film, const Tile &tile, std::int32_t samples);
    void find_specks();
    float speck_at(int x, int y) const;
    void set_variance();
    void set_scales(const Camera &camera);
    void fill_margin();

    int x0_, y0_, x1_, y1_;
    std::size_t columns_, rows_;
    std::vector<float> data_{};
    std::vector<float> specks_{}; // 0: none; above: scale of the even half, below: of the odd
};

} // namespace tsuya
