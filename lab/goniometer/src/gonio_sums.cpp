#include "gonio_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "tsuya/sdk/detail/hasher.h"

namespace tsuya::lab {
namespace {

constexpr std::string_view kKind = "goniometer 3"; // of checkpoints: name and version of the layout

// All that a checkpoint has of a light, in its order.
template <class Light, class Visit> void each_number(Light &light, Visit visit) {
    visit(light.batches);
    visit(light.sums.reflected);
    visit(light.sums.reflected_square);
    visit(light.sums.transmitted);
    visit(light.sums.transmitted_square);
}

} // namespace

Estimate estimate(double sum, double sum_of_squares, std::uint64_t photons) {
    if (photons < 2)
        return {0, 0};
    const auto n = static_cast<double>(photons);
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean) / (n - 1))};
}

double LightSums::relative_error() const {
    double errors = 0, values = 0;
    for (std::size_t i = 0; i < sums.value.size(); ++i) {
        const Estimate e = estimate(sums.value[i], sums.square[i], photons());
        errors += e.sigma;
        values += e.mean;
    }
    return values > 0 ? errors / values : std::numeric_limits<double>::infinity();
}

tsuya::detail::Fingerprint fingerprint(const FilamentRepeat &repeat, const Directions &directions,
                                       const GoniometerSettings &settings) {
    tsuya::detail::Hasher h;
    h.value(repeat.size);
    for (const Filament &f : repeat.filaments) {
        h.array(std::span(f.point));
        h.array(std::span(f.turn));
        h.value(f.radius);
        h.value(f.system);
    }
    for (const FilamentOptics &o : repeat.optics) {
        h.value(o.section);
        for (const double v : {o.corner_rounding, o.refractive_index, o.surface_roughness,
                               o.transmission, o.scattering_length, o.scattering_anisotropy})
            h.value(v);
    }
    for (const DirectionPair &p : directions.pairs)
        for (const double v : {p.theta_i, p.phi_i, p.theta_r, p.phi_r})
            h.value(v);
    tsuya::detail::Hasher s;
    s.value(settings.seed);
    s.value(settings.part);
    s.value(settings.max_bounces);
    s.value(settings.energy_bound);
    s.value(settings.turn_per_segment);
    s.value(settings.section_points);
    return {.input = h.result(), .settings = s.result()};
}

void save_sums(const std::vector<LightSums> &lights, const tsuya::detail::Fingerprint &fingerprint,
               const std::filesystem::path &file) {
    tsuya::detail::CheckpointWriter writer(file, kKind, fingerprint);
    for (const LightSums &light : lights) {
        each_number(light, [&](const auto &v) { writer.value(v); });
        writer.array(std::span(light.sums.value));
        writer.array(std::span(light.sums.square));
    }
    writer.commit();
}

void load_sums(std::vector<LightSums> &lights, const tsuya::detail::Fingerprint &fingerprint,
               const std::filesystem::path &file) {
    tsuya::detail::CheckpointReader reader(file, kKind, fingerprint);
    for (LightSums &light : lights) {
        each_number(light, [&](auto &v) { reader.value(v); });
        reader.array(std::span(light.sums.value));
        reader.array(std::span(light.sums.square));
    }
    reader.finish();
}

} // namespace tsuya::lab
