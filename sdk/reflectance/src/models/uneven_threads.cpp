#include "tsuya/sdk/detail/uneven_threads.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/integer_hash.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr int kRow = 1024;          // threads at least, before their widths begin again
constexpr double kLeastWidth = 0.3; // of a thread, in mean widths
constexpr std::int64_t kShare = 8;  // picks that give room to each other's slubs

// 0 to 1.
double random(std::uint32_t seed, std::uint32_t a, std::uint32_t b) {
    return detail::hash(a + detail::hash(b + detail::hash(seed))) * 0x1p-32;
}

std::int64_t floor_of(double x) { return static_cast<std::int64_t>(std::floor(x)); }

} // namespace

void check_irregularity(const Irregularity &irregularity, const std::string &where) {
    Problems problems;
    const auto need = [&](const char *key, double value, double low, double high) {
        problems.need(value >= low && value <= high,
                      std::string(key) + " is " + std::to_string(value), where + "." + key,
                      "expected " + std::to_string(low) + " to " + std::to_string(high));
    };
    const auto &[thickness, filament, slubs_per_m, slub_length, slub_gain, seed] = irregularity;
    need("thickness", thickness, 0, 0.3);
    need("filament", filament, 0, 0.3);
    need("slubs_per_m", slubs_per_m, 0, 100);
    need("slub_length", slub_length, 0.001, slubs_per_m > 0 ? std::min(1.0, 1 / slubs_per_m) : 1);
    need("slub_gain", slub_gain, 0, 5);
    need("seed", static_cast<double>(seed), 0, 1e9);
    problems.throw_if_any();
}

UnevenThreads::UnevenThreads(const WeaveMap &map, const Irregularity &irregularity)
    : seed_(static_cast<std::uint32_t>(irregularity.seed)) {
    const glm::dvec2 spacing = map.spacing();
    ends_ = make_row(map.threads.x, spacing.x, irregularity.thickness, 2 * seed_);
    picks_ = make_row(map.threads.y, spacing.y, irregularity.thickness, 2 * seed_ + 1);
    if (irregularity.slubs_per_m > 0 && irregularity.slub_gain > 0) {
        slub_cell_ = 1 / irregularity.slubs_per_m;
        slub_length_ = std::min(irregularity.slub_length, slub_cell_);
        slub_gain_ = irregularity.slub_gain;
    }
}

UnevenThreads::Row UnevenThreads::make_row(int repeat, double spacing, double thickness,
                                           std::uint32_t seed) {
    Row row{.repeat = repeat, .spacing = spacing};
    if (!(thickness > 0))
        return row;
    const int count = (kRow + repeat - 1) / repeat * repeat;
    row.edge.push_back(0);
    for (int i = 0; i < count; ++i) {
        // Of even distribution over a range whose standard deviation is 1
        const double u =
            std::sqrt(12.0) * (random(seed, static_cast<std::uint32_t>(i), 0x1d) - 0.5);
        row.edge.push_back(row.edge.back() + std::max(1 + thickness * u, kLeastWidth));
    }
    const double scale = count / row.edge.back();
    for (double &edge : row.edge)
        edge *= scale;
    row.edge.back() = count;
    return row;
}

// \param place in mean widths of a thread
UnevenThreads::Thread UnevenThreads::find(const Row &row, double place) {
    if (row.edge.empty()) {
        const double number = std::floor(place);
        return {static_cast<std::int64_t>(number), place - number, 1};
    }
    const double count = row.edge.back();
    const std::int64_t turn = floor_of(place / count);
    const double in_row = std::clamp(place - static_cast<double>(turn) * count, 0.0, count);
    // Edges are not far from where they are in an even row
    std::size_t i = std::min(static_cast<std::size_t>(in_row), row.edge.size() - 2);
    while (i > 0 && row.edge[i] > in_row)
        --i;
    while (i + 2 < row.edge.size() && row.edge[i + 1] <= in_row)
        ++i;
    const double low = row.edge[i], width = row.edge[i + 1] - low;
    return {turn * static_cast<std::int64_t>(row.edge.size() - 1) + static_cast<std::int64_t>(i),
            std::clamp((in_row - low) / width, 0.0, 1.0), width};
}

// How much wider a slub makes a pick, as a share of its width. There is one slub in each cell of
// its length.
double UnevenThreads::swelling(std::int64_t pick, double x) const {
    const std::int64_t cell = floor_of(x / slub_cell_);
    const double middle =
        static_cast<double>(cell) * slub_cell_ + 0.5 * slub_length_ +
        (slub_cell_ - slub_length_) *
            random(seed_, static_cast<std::uint32_t>(pick), static_cast<std::uint32_t>(cell));
    const double off = 2 * std::abs(x - middle) / slub_length_;
    if (off >= 1)
        return 0;
    const double cosine = std::cos(0.5 * kPi * off);
    return slub_gain_ * cosine * cosine;
}

// The picks of a group share its width by how thick they are there.
UnevenThreads::Thread UnevenThreads::among_slubs(const Thread &pick, double x) const {
    const std::int64_t first = floor_of(static_cast<double>(pick.number) / kShare) * kShare;
    std::array<double, kShare> width{}, even{};
    double place = 0, all = 0, swollen = 0;
    for (std::int64_t i = 0; i < kShare; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const std::int64_t number = first + i;
        const auto count =
            static_cast<std::int64_t>(picks_.edge.empty() ? 1 : picks_.edge.size() - 1);
        const auto of_row = static_cast<std::size_t>(((number % count) + count) % count);
        even[k] = picks_.edge.empty() ? 1 : picks_.edge[of_row + 1] - picks_.edge[of_row];
        if (number < pick.number)
            place += even[k];
        else if (number == pick.number)
            place += pick.within * even[k];
        width[k] = even[k] * (1 + swelling(number, x));
        all += even[k];
        swollen += width[k];
    }
    const double scale = all / swollen;
    for (std::int64_t i = 0; i < kShare; ++i) {
        const double w = width[static_cast<std::size_t>(i)] * scale;
        if (place < w || i == kShare - 1)
            return {first + i, std::clamp(place / w, 0.0, 1.0), w};
        place -= w;
    }
    return pick;
}

UnevenThreads::Spot UnevenThreads::at(const glm::dvec2 &cloth) const {
    const Thread end = find(ends_, cloth.x / ends_.spacing);
    Thread pick = find(picks_, cloth.y / picks_.spacing);
    if (slub_cell_ > 0)
        pick = among_slubs(pick, cloth.x);
    const auto place = [](const Thread &thread, int repeat) {
        const auto in_repeat = static_cast<int>(((thread.number % repeat) + repeat) % repeat);
        // A float keeps it below the next thread
        return static_cast<float>(in_repeat + std::min(thread.within, 0.9999));
    };
    return {{place(end, ends_.repeat), place(pick, picks_.repeat)},
            static_cast<float>(1 / (end.width * pick.width))};
}

glm::dvec2 UnevenThreads::period() const {
    const auto of = [](const Row &row) {
        return row.spacing *
               (row.edge.empty() ? row.repeat : static_cast<double>(row.edge.size() - 1));
    };
    return {of(ends_), of(picks_)};
}

} // namespace tsuya
