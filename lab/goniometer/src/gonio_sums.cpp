#include "gonio_sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

constexpr std::string_view kMagic = "tsuya-goniometer 1\n";

// FNV-1a over the bytes of values
struct Hasher {
    std::uint64_t state = 1469598103934665603ull;

    template <class T> void value(const T &v) {
        unsigned char byte[sizeof v];
        std::memcpy(byte, &v, sizeof v);
        for (const unsigned char b : byte)
            state = (state ^ b) * 1099511628211ull;
    }
};

template <class T> void append(std::string &bytes, const T &value) {
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

class Reader {
  public:
    Reader(std::string_view bytes, const std::filesystem::path &file)
        : bytes_(bytes), file_(file) {}
    template <class T> void read(T &value) {
        if (bytes_.size() < sizeof value)
            throw Error({"the checkpoint is cut off", file_.string(), "start again without it"});
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
    }

  private:
    std::string_view bytes_;
    const std::filesystem::path &file_;
};

// All numbers of a light in the order of the file.
template <class Light, class Visit> void each_number(Light &light, Visit visit) {
    visit(light.batches);
    for (auto &v : light.sums.value)
        visit(v);
    for (auto &v : light.sums.square)
        visit(v);
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

std::uint64_t fingerprint(const FilamentRepeat &repeat, const Directions &directions,
                          const GoniometerSettings &settings) {
    Hasher h;
    h.value(repeat.size.x);
    h.value(repeat.size.y);
    for (const Filament &f : repeat.filaments) {
        for (const glm::vec3 &p : f.point)
            for (int c = 0; c < 3; ++c)
                h.value(p[c]);
        for (const float turn : f.turn)
            h.value(turn);
        h.value(f.point.size());
        h.value(f.radius);
        h.value(f.system);
    }
    for (const FilamentOptics &o : repeat.optics) {
        h.value(o.section);
        for (const double v :
             {o.corner_rounding, o.refractive_index, o.surface_roughness, o.transmission})
            h.value(v);
    }
    for (const DirectionPair &p : directions.pairs)
        for (const double v : {p.theta_i, p.phi_i, p.theta_r, p.phi_r})
            h.value(v);
    h.value(settings.seed);
    h.value(settings.max_bounces);
    h.value(settings.energy_bound);
    h.value(settings.turn_per_segment);
    h.value(settings.section_points);
    return h.state;
}

void save_sums(const std::vector<LightSums> &lights, std::uint64_t fingerprint,
               const std::filesystem::path &file) {
    std::string bytes(kMagic);
    append(bytes, fingerprint);
    for (const LightSums &light : lights)
        each_number(light, [&](const auto &v) { append(bytes, v); });
    write_file(file, bytes);
}

void load_sums(std::vector<LightSums> &lights, std::uint64_t fingerprint,
               const std::filesystem::path &file) {
    const std::string bytes = read_file(file);
    if (!bytes.starts_with(kMagic))
        throw Error({"this is no checkpoint of a measurement", file.string(), "name another file"});
    Reader reader(std::string_view(bytes).substr(kMagic.size()), file);
    std::uint64_t own = 0;
    reader.read(own);
    if (own != fingerprint)
        throw Error({"the checkpoint is of another weave, other directions or other settings",
                     file.string(), "measure the same again, or remove the file"});
    for (LightSums &light : lights)
        each_number(light, [&](auto &v) { reader.read(v); });
}

} // namespace tsuya::lab
