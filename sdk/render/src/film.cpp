#include "film.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

namespace tsuya {
namespace {

constexpr int kTileSize = 32;

// FNV-1a over the bytes of values
struct Hasher {
    std::uint64_t state = 1469598103934665603ull;

    void bytes(const void *data, std::size_t size) {
        const auto *byte = static_cast<const unsigned char *>(data);
        for (std::size_t i = 0; i < size; ++i)
            state = (state ^ byte[i]) * 1099511628211ull;
    }
    template <class T> void value(const T &v) { bytes(&v, sizeof v); }
    template <class T> void array(const std::vector<T> &v) {
        value(v.size());
        bytes(v.data(), v.size() * sizeof(T));
    }
    void spectrum(const Spectrum &s) {
        array(s.wavelength_nm);
        array(s.value);
    }
};

} // namespace

std::vector<std::string> channels_of(const std::string &aov) {
    if (aov == "normal" || aov == "warp")
        return {"X", "Y", "Z"};
    return {aov == "depth" ? "Z" : "A"};
}

std::uint64_t Film::bytes_needed(const Scene &scene, const RenderSettings &settings) {
    std::uint64_t aovs = 0;
    for (const std::string &aov : settings.aovs)
        aovs += channels_of(aov).size();
    const std::uint64_t transport =
        scene.light_groups.size() * static_cast<std::uint64_t>(settings.channels);
    // In the film, which has the sum of squares too, and in the picture that is made of it
    const std::uint64_t floats = 2 * (transport + aovs) + 1;
    return floats * sizeof(float) * static_cast<std::uint64_t>(scene.camera.width) *
           static_cast<std::uint64_t>(scene.camera.height);
}

Film::Film(const Scene &scene, const RenderSettings &settings)
    : width(scene.camera.width), height(scene.camera.height), channels(settings.channels),
      groups(scene.light_groups.size()) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    sum.resize(pixels * groups * static_cast<std::size_t>(channels));
    sum_of_squares.resize(pixels);
    for (const std::string &aov : settings.aovs)
        aov_sums.push_back(Image::make(width, height, channels_of(aov)));
    const auto [x0, y0, x1, y1] = settings.crop.value_or(std::array<int, 4>{0, 0, width, height});
    for (int y = y0; y < y1; y += kTileSize)
        for (int x = x0; x < x1; x += kTileSize)
            tiles.push_back({x, y, std::min(x + kTileSize, x1), std::min(y + kTileSize, y1)});
    done.resize(tiles.size());
}

Film::TileError Film::tile_error(std::size_t t) const {
    TileError result;
    const double n = done[t];
    const std::size_t count = groups * static_cast<std::size_t>(channels);
    for (int y = tiles[t].y0; y < tiles[t].y1; ++y)
        for (int x = tiles[t].x0; x < tiles[t].x1; ++x) {
            const float *const p = sum.data() + at(x, y) * count;
            const double mean = std::accumulate(p, p + count, 0.0) / static_cast<double>(count) / n;
            const double variance = sum_of_squares[at(x, y)] / n - mean * mean;
            result.errors += std::sqrt(std::max(0.0, variance) / (n - 1));
            result.values += mean;
        }
    return result;
}

double Film::relative_error(std::size_t t) const {
    if (done[t] < 2)
        return std::numeric_limits<double>::infinity();
    const TileError e = tile_error(t);
    const double pixels = (tiles[t].x1 - tiles[t].x0) * (tiles[t].y1 - tiles[t].y0);
    return e.errors / std::max(e.values, kDark * pixels);
}

double Film::relative_error() const {
    TileError total;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        if (done[t] > 1) {
            const TileError e = tile_error(t);
            total.errors += e.errors;
            total.values += e.values;
        }
    return total.values > 0 ? total.errors / total.values : 0;
}

std::uint64_t Film::samples() const {
    std::uint64_t n = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        n += static_cast<std::uint64_t>(done[t]) *
             static_cast<std::uint64_t>((tiles[t].x1 - tiles[t].x0) * (tiles[t].y1 - tiles[t].y0));
    return n;
}

SpectralImage Film::develop(const Scene &scene, const RenderSettings &settings) const {
    SpectralImage image =
        SpectralImage::make(width, height, {.count = channels}, scene.light_groups);
    image.aovs = aov_sums;
    image.aov_names = settings.aovs;
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
                for (Image &aov : image.aovs)
                    for (std::size_t c = 0; c < aov.channels.size(); ++c)
                        aov.pixel(x, y)[c] *= scale;
            }
    }
    return image;
}

std::uint64_t fingerprint(const Scene &scene, const RenderSettings &settings) {
    Hasher h;
    h.value(settings.channels);
    h.value(settings.max_bounces);
    h.value(settings.seed);
    h.value(settings.skip);
    h.value(settings.crop.value_or(std::array<int, 4>{}));
    for (const std::string &aov : settings.aovs)
        h.bytes(aov.data(), aov.size());
    for (const Surface &s : scene.surfaces) {
        h.array(s.position);
        h.array(s.normal);
        h.array(s.warp);
        h.array(s.triangle);
    }
    for (const Fabric &f : scene.fabrics) {
        h.spectrum(f.dye);
        h.spectrum(f.transmittance);
        h.spectrum(f.specular_tint);
        for (const auto *const tint : {&f.weft_tint, &f.warp_tint}) {
            h.value(tint->has_value());
            h.spectrum(tint->value_or(f.specular_tint));
        }
        h.value(f.f0.value_or(0));
        h.bytes(f.model.data(), f.model.size());
        if (f.yarn)
            h.value(*f.yarn);
        if (f.ggx)
            for (const double v : {f.ggx->alpha_weft, f.ggx->alpha_warp, f.ggx->f0,
                                   f.ggx->refractive_index.value_or(0)})
                h.value(v);
        if (f.table)
            for (const ReflectanceRow &row : f.table->rows)
                h.value(row);
        if (f.bard)
            for (const BardView &v : f.bard->views())
                h.value(v);
    }
    for (const Object &o : scene.objects) {
        h.value(o.surface);
        h.value(o.fabric);
    }
    h.value(scene.light_groups.size());
    for (const RectangleLight &l : scene.rectangles) {
        for (const glm::dvec3 &v : {l.corner, l.edge_u, l.edge_v})
            h.value(v);
        h.value(l.radiance);
        h.value(l.group);
    }
    if (scene.environment) {
        h.value(scene.environment->radiance);
        h.value(scene.environment->group);
        h.value(scene.environment->visible);
        if (scene.environment->picture)
            h.array(scene.environment->picture->data);
    }
    for (const glm::dvec3 &v : {scene.camera.eye, scene.camera.target, scene.camera.up})
        h.value(v);
    h.value(scene.camera.vertical_angle);
    h.value(scene.camera.width);
    h.value(scene.camera.height);
    return h.state;
}

} // namespace tsuya
