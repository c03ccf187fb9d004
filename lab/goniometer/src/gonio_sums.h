#pragma once
// The sums of a measurement in the making, and the file that keeps them.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "photon_walk.h"
#include "tsuya/sdk/detail/checkpoint.h"

namespace tsuya::lab {

// A light of the measurement.
struct LightSums {
    std::uint64_t batches = 0;
    Sums sums{};

    std::uint64_t photons() const { return batches * kPhotonsPerBatch; }
    // Sum of the standard errors over the sum of the values; infinite where there are none.
    double relative_error() const;
};

// Mean and standard error of one number per photon.
struct Estimate {
    double mean, sigma;
};
Estimate estimate(double sum, double sum_of_squares, std::uint64_t photons);

// What must be the same for a measurement to go on: hashes of repeat and directions, and of
// settings.
tsuya::detail::Fingerprint fingerprint(const FilamentRepeat &repeat, const Directions &directions,
                                       const GoniometerSettings &settings);

void save_sums(const std::vector<LightSums> &lights, const tsuya::detail::Fingerprint &fingerprint,
               const std::filesystem::path &file);
// Throws Error naming the file: not a checkpoint, damaged, or of another measurement.
void load_sums(std::vector<LightSums> &lights, const tsuya::detail::Fingerprint &fingerprint,
               const std::filesystem::path &file);

} // namespace tsuya::lab
