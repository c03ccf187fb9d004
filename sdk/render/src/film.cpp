#include "film.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

#include "denoise_guide.h"
#include "dye_channels.h"
#include "film_aovs.h"

namespace tsuya {
namespace {

constexpr int kTileSize = 32;

std::uint64_t pixels_of(const Tile &t) {
    return static_cast<std::uint64_t>(t.x1 - t.x0) * static_cast<std::uint64_t>(t.y1 - t.y0);
}

// Half the difference of the means of two halves. \param mean of all samples
// \param less sum of those of even index less the sum of the others
double error_of_halves(std::int32_t samples, double mean, double less) {
    const std::int32_t count_odd = samples / 2;
    const double n = samples, odd = count_odd, even = n - odd;
    return 0.25 * std::abs((n * mean + less) / even - (n * mean - less) / odd);
}

} // namespace

std::uint64_t Film::bytes_needed(const Scene &scene, const RenderSettings &settings) {
    std::uint64_t aovs = 0;
    for (const Aov aov : aovs_of(settings))
        aovs += channels_of(aov, scene, settings.channels).size();
    aovs += settings.alpha ? 1 : 0;
    const std::uint64_t transport =
        scene.light_groups.size() * static_cast<std::uint64_t>(settings.channels);
    // In the film, which has the difference too, and in the picture that is made of it
    std::uint64_t floats = 2 * (transport + aovs) + 1;
    if (!planned_dyes(scene).empty())
        floats += kJudgedDepths;
    if (settings.denoise)
        floats += transport + kFeatures + GuidePlanes::kPlanes;
    return floats * sizeof(float) * static_cast<std::uint64_t>(scene.camera.width) *
           static_cast<std::uint64_t>(scene.camera.height);
}

Film::Film(const Scene &scene, const RenderSettings &settings)
    : width(scene.camera.width), height(scene.camera.height), channels(settings.channels),
      groups(scene.light_groups.size()),
      all_split(settings.stop.relative_error || settings.denoise), aovs(aovs_of(settings)) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    sum.resize(pixels * groups * static_cast<std::size_t>(channels));
    difference.resize(pixels);
    if (!planned_dyes(scene).empty())
        depth_difference.resize(kJudgedDepths * pixels);
    if (settings.denoise) {
        odd_sum.resize(sum.size());
        features.resize(pixels * kFeatures);
    }
    for (const Aov aov : aovs)
        aov_sums.push_back(Image::make(width, height, channels_of(aov, scene, channels)));
    if (settings.alpha)
        covered.resize(pixels);
    const auto [x0, y0, x1, y1] = settings.crop.value_or(std::array<int, 4>{0, 0, width, height});
    for (int y = y0; y < y1; y += kTileSize)
        for (int x = x0; x < x1; x += kTileSize)
            tiles.push_back({x, y, std::min(x + kTileSize, x1), std::min(y + kTileSize, y1)});
    done.resize(tiles.size());
    if (settings.widen_after_diffuse) {
        change.resize(tiles.size());
        told.resize(tiles.size());
    }
}

Film::TileError Film::tile_error(std::size_t t, std::size_t judged) const {
    TileError result;
    for (int y = tiles[t].y0; y < tiles[t].y1; ++y)
        for (int x = tiles[t].x0; x < tiles[t].x1; ++x) {
            if (!is_split(x, y))
                continue;
            const double mean = judged_mean(x, y, done[t], judged);
            const double less = depth_difference.empty()
                                    ? difference[at(x, y)]
                                    : depth_difference[kJudgedDepths * at(x, y) + judged];
            result.errors += error_of_halves(done[t], mean, less);
            result.values += mean;
            ++result.pixels;
        }
    return result;
}

double Film::judged_mean(int x, int y, std::int32_t samples, std::size_t judged) const {
    if (depth_difference.empty())
        return pixel_mean(x, y, samples);
    double total = 0;
    for (std::size_t g = 0; g < groups; ++g)
        total += pixel(x, y)[g * static_cast<std::size_t>(channels) + judged_channel[judged]];
    return total / static_cast<double>(groups) / samples;
}

double Film::pixel_mean(int x, int y, std::int32_t samples) const {
    const std::size_t count = groups * static_cast<std::size_t>(channels);
    const float *const p = pixel(x, y);
    return std::accumulate(p, p + count, 0.0) / static_cast<double>(count) / samples;
}

double Film::pixel_error(int x, int y, std::int32_t samples, double mean) const {
    return error_of_halves(samples, mean, difference[at(x, y)]);
}

double Film::relative_error(std::size_t t) const {
    if (done[t] < 2)
        return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t judged = 0; judged < judged_count(); ++judged) {
        const TileError e = tile_error(t, judged);
        const double values = std::max(e.values, dark[judged] * e.pixels);
        largest = std::max(largest, values > 0 ? e.errors / values : 0);
    }
    return largest;
}

double Film::relative_error() const {
    double largest = 0;
    for (std::size_t judged = 0; judged < judged_count(); ++judged) {
        TileError total;
        for (std::size_t t = 0; t < tiles.size(); ++t)
            if (done[t] > 1) {
                const TileError e = tile_error(t, judged);
                total.errors += e.errors;
                total.values += e.values;
                total.pixels += e.pixels;
            }
        if (total.pixels == 0)
            return std::numeric_limits<double>::infinity();
        largest = std::max(largest, total.values > 0 ? total.errors / total.values : 0);
    }
    return largest;
}

double Film::bright_value(std::size_t judged) const {
    std::vector<double> values;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        if (const TileError e = tile_error(t, judged); e.pixels > 0)
            values.push_back(e.values / e.pixels);
    if (values.empty())
        return 0;
    const auto bright = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
    std::nth_element(values.begin(), bright, values.end());
    return *bright;
}

void Film::find_dark() {
    if (dark == std::array<double, kJudgedDepths>{})
        for (std::size_t judged = 0; judged < judged_count(); ++judged)
            dark[judged] = kDark * bright_value(judged);
}

void Film::set_depths(const DyeDepths &depths) {
    const auto depth = [](const std::array<double, kMostDyes> &node) {
        return std::accumulate(node.begin(), node.end(), 0.0);
    };
    const auto [darkest, lightest] =
        std::minmax_element(depths.node.begin(), depths.node.end(),
                            [&](const auto &a, const auto &b) { return depth(a) < depth(b); });
    judged_channel = {static_cast<std::uint32_t>(darkest - depths.node.begin()),
                      static_cast<std::uint32_t>(lightest - depths.node.begin())};
}

double Film::share_within(double error) const {
    std::uint64_t within = 0, all = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        all += pixels_of(tiles[t]);
        within += relative_error(t) <= error ? pixels_of(tiles[t]) : 0;
    }
    return static_cast<double>(within) / static_cast<double>(all);
}

double Film::samples_per_pixel() const {
    std::uint64_t pixels = 0;
    for (const Tile &tile : tiles)
        pixels += pixels_of(tile);
    return static_cast<double>(samples()) / static_cast<double>(pixels);
}

std::uint64_t Film::samples() const {
    std::uint64_t n = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        n += static_cast<std::uint64_t>(done[t]) * pixels_of(tiles[t]);
    return n;
}

std::optional<double> Film::widening_change() const {
    const std::size_t values = groups * static_cast<std::size_t>(channels);
    double of_change = 0, of_values = 0;
    for (std::size_t t = 0; t < change.size(); ++t) {
        if (told[t] == 0)
            continue;
        of_change +=
            change[t] / static_cast<double>(told[t]) * static_cast<double>(pixels_of(tiles[t]));
        for (int y = tiles[t].y0; y < tiles[t].y1; ++y)
            for (int x = tiles[t].x0; x < tiles[t].x1; ++x)
                of_values += std::accumulate(pixel(x, y), pixel(x, y) + values, 0.0) /
                             (static_cast<double>(channels) * done[t]);
    }
    if (!(of_values > 0))
        return std::nullopt;
    return of_change / (of_values - of_change);
}

std::int32_t Film::samples_at(int x, int y) const {
    const auto across =
        static_cast<std::size_t>((tiles.back().x1 - tiles.front().x0 + kTileSize - 1) / kTileSize);
    const auto column = static_cast<std::size_t>((x - tiles.front().x0) / kTileSize);
    const auto row = static_cast<std::size_t>((y - tiles.front().y0) / kTileSize);
    return done[row * across + column];
}

SpectralImage Film::develop(const Scene &scene, const RenderSettings &settings) const {
    SpectralImage image = SpectralImage::make(
        width, height, basis_of(planned_dyes(scene), channels), scene.light_groups);
    image.data_window = settings.crop;
    if (settings.alpha)
        image.alpha = Image::make(width, height, {"A"});
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const float scale = done[t] > 0 ? 1.0f / static_cast<float>(done[t]) : 0.0f;
        for (int y = tiles[t].y0; y < tiles[t].y1; ++y)
            for (int x = tiles[t].x0; x < tiles[t].x1; ++x) {
                const float *from = pixel(x, y);
                for (std::size_t g = 0; g < groups; ++g) {
                    float *const to = image.pixel(g, x, y);
                    for (int k = 0; k < channels; ++k)
                        to[k] = *from++ * scale;
                }
                if (image.alpha)
                    *image.alpha->pixel(x, y) = covered[at(x, y)] * scale;
            }
    }
    develop_aovs(*this, scene, settings, image);
    return image;
}

} // namespace tsuya
