#include "filament_cell.h"

#include <algorithm>
#include <cmath>

#include "filament_gap.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kLongest = 16;    // cone, in its radii: long ones make loose bounding boxes
constexpr int kMostParts = 256;    // of one segment of a path
constexpr double kTubeTurn = 5;    // times that of cones: normals are interpolated between rings
constexpr double kMostTwist = 0.3; // of a section between rings, radians
constexpr double kMostSag = 0.02;  // of an arc over its chord, in radii
constexpr double kFlatness = 2;    // least width of the cell in thicknesses of the cloth

// One period of a filament, divided finely.
struct Path {
    struct Station {
        glm::dvec3 position, tangent;
        double turn, turn_rate;
    };
    std::vector<Station> station{};
    glm::dvec3 step{}; // to the next period
    double radius = 0;
};

double angle_between(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The path of a filament and its periodic continuation.
class PeriodicPoints {
  public:
    PeriodicPoints(const Filament &filament, const glm::dvec3 &step, double scale)
        : filament_(filament), step_(step), scale_(scale) {}

    glm::dvec3 point(std::ptrdiff_t i) const {
        const auto n = static_cast<std::ptrdiff_t>(filament_.point.size());
        const std::ptrdiff_t period = i >= 0 ? i / n : -((n - 1 - i) / n);
        const auto own = static_cast<std::size_t>(i - period * n);
        return glm::dvec3(filament_.point[own]) * scale_ + step_ * static_cast<double>(period);
    }
    // From a point to the next, the short way round
    double turn_step(std::size_t i) const {
        if (filament_.turn.empty())
            return 0;
        const double next = filament_.turn[(i + 1) % filament_.turn.size()];
        return std::remainder(next - filament_.turn[i], 2 * kPi);
    }
    double turn(std::size_t i) const { return filament_.turn.empty() ? 0 : filament_.turn[i]; }

  private:
    const Filament &filament_;
    glm::dvec3 step_;
    double scale_;
};

// The uniform Catmull-Rom spline through the points, in as many parts as its bend needs.
Path divide(const Filament &filament, const glm::dvec3 &step, double scale, double most_turn) {
    const PeriodicPoints points(filament, step, scale);
    Path path{.station = {}, .step = step, .radius = filament.radius * scale};
    for (std::size_t i = 0; i < filament.point.size(); ++i) {
        const auto at = static_cast<std::ptrdiff_t>(i);
        const glm::dvec3 a = points.point(at), b = points.point(at + 1);
        const glm::dvec3 ta = 0.5 * (b - points.point(at - 1));
        const glm::dvec3 tb = 0.5 * (points.point(at + 2) - a), chord = b - a;
        const double length = glm::length(chord);
        const double bend = angle_between(ta, chord) + angle_between(chord, tb);
        const double wanted = std::max({1.0, bend / most_turn, length / (kLongest * path.radius)});
        const int parts = static_cast<int>(std::min<double>(std::ceil(wanted), kMostParts));
        for (int part = 0; part < parts; ++part) {
            const double t = static_cast<double>(part) / parts;
            const glm::dvec3 c2 = 3.0 * chord - 2.0 * ta - tb, c3 = ta + tb - 2.0 * chord;
            const glm::dvec3 derivative = ta + t * (2.0 * c2 + 3.0 * t * c3);
            path.station.push_back({a + t * (ta + t * (c2 + t * c3)), glm::normalize(derivative),
                                    points.turn(i) + t * points.turn_step(i),
                                    points.turn_step(i) / glm::length(derivative)});
        }
    }
    return path;
}

// Drops stations that a tube does without: one ring costs as much as dozens of cones.
void thin(Path &path, double most_turn) {
    std::vector<Path::Station> kept{path.station[0]};
    for (std::size_t i = 1; i < path.station.size(); ++i) {
        const Path::Station &last = kept.back(), &s = path.station[i];
        const Path::Station &next = path.station[(i + 1) % path.station.size()];
        const double twist = std::abs(std::remainder(next.turn - last.turn, 2 * kPi));
        const double length = glm::distance(s.position, last.position);
        const double turn = angle_between(last.tangent, next.tangent);
        const double longest = std::min(0.5 * kLongest, 8 * kMostSag / std::max(turn, 1e-9));
        if (turn > most_turn || twist > kMostTwist || length > longest * path.radius)
            kept.push_back(s);
    }
    path.station = std::move(kept);
}

// The stations of all segments that reach into low to high along `axis`, with a shift across.
std::vector<Path::Station> stretch(const Path &path, int axis, double low, double high,
                                   const glm::dvec3 &shift) {
    const auto n = static_cast<std::ptrdiff_t>(path.station.size());
    const auto station = [&](std::ptrdiff_t i) {
        const std::ptrdiff_t period = i >= 0 ? i / n : -((n - 1 - i) / n);
        Path::Station s = path.station[static_cast<std::size_t>(i - period * n)];
        s.position += path.step * static_cast<double>(period) + shift;
        return s;
    };
    // Paths go forward on the whole: look one period farther than needed
    const double start = path.station[0].position[axis], period = path.step[axis];
    std::ptrdiff_t first =
        (static_cast<std::ptrdiff_t>(std::floor((low - start) / period)) - 1) * n;
    std::ptrdiff_t last = (static_cast<std::ptrdiff_t>(std::ceil((high - start) / period)) + 1) * n;
    while (first < last && station(first + 1).position[axis] < low)
        ++first;
    while (last > first && station(last - 1).position[axis] > high)
        --last;
    std::vector<Path::Station> all;
    for (std::ptrdiff_t i = first; i <= last; ++i)
        all.push_back(station(i));
    return all;
}

void add_cones(Cones &cones, const std::vector<Path::Station> &stations, const Strand &strand,
               std::uint32_t number) {
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (i + 1 < stations.size()) {
            cones.first.push_back(static_cast<std::uint32_t>(cones.vertex.size()));
            cones.system.push_back(static_cast<std::uint8_t>(strand.system));
            cones.strand.push_back(number);
        }
        cones.vertex.emplace_back(stations[i].position, strand.radius);
        cones.tangent.emplace_back(stations[i].tangent);
    }
}

void add_ring(Tubes &tubes, const Path::Station &s, double radius,
              const std::vector<OutlinePoint> &section) {
    glm::dvec3 up = glm::dvec3(0, 0, 1) - s.tangent * s.tangent.z;
    up = glm::dot(up, up) > 1e-12 ? glm::normalize(up) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::cross(up, s.tangent);
    const glm::dvec3 x = side * std::cos(s.turn) + up * std::sin(s.turn);
    const glm::dvec3 y = up * std::cos(s.turn) - side * std::sin(s.turn);
    tubes.tangent.emplace_back(s.tangent);
    for (const OutlinePoint &o : section) {
        tubes.position.emplace_back(s.position + radius * (x * o.position.x + y * o.position.y));
        // The surface of a twisted section is inclined to the axis as well
        const double along = o.position.x * o.normal.y - o.position.y * o.normal.x;
        tubes.normal.emplace_back(glm::normalize(x * o.normal.x + y * o.normal.y -
                                                 s.tangent * (s.turn_rate * radius * along)));
    }
}

void add_tube(Tubes &tubes, const std::vector<Path::Station> &stations, const Strand &strand,
              std::uint32_t number, const std::vector<OutlinePoint> &section) {
    const auto m = static_cast<std::uint32_t>(section.size());
    tubes.ring_size = m;
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const auto a = static_cast<std::uint32_t>(tubes.position.size());
        add_ring(tubes, stations[i], strand.radius, section);
        if (i + 1 == stations.size())
            break;
        tubes.ring.push_back(a);
        tubes.system.push_back(static_cast<std::uint8_t>(strand.system));
        tubes.strand.push_back(number);
        for (std::uint32_t k = 0; k < m; ++k) {
            const std::uint32_t p = a + k, q = a + (k + 1) % m;
            tubes.quad.emplace_back(p, q, q + m, p + m);
        }
    }
}

// A filament of the repeat in the cell: one of its copies side by side.
struct Placed {
    std::size_t path;
    std::vector<Path::Station> stations;
};

// All copies of a path that reach into the cell.
void place(const Path &path, std::size_t number, int along, const glm::dvec2 &period,
           const glm::dvec2 &whole, std::vector<Placed> &placed) {
    const int across = 1 - along;
    double least = 1e30, most = -1e30;
    for (const Path::Station &s : path.station) {
        least = std::min(least, s.position[across] - path.radius);
        most = std::max(most, s.position[across] + path.radius);
    }
    const int first = static_cast<int>(std::ceil(-most / period[across]));
    const int last = static_cast<int>(std::floor((whole[across] - least) / period[across]));
    for (int k = first; k <= last; ++k) {
        glm::dvec3 shift{0};
        shift[across] = k * period[across];
        placed.push_back(
            {number, stretch(path, along, -path.radius, whole[along] + path.radius, shift)});
    }
}

void stop_if_asked(const Progress &progress) {
    if (progress.stopped())
        throw Interrupted("stopped while the filaments were laid out");
}

double gap_of(const std::vector<Path> &paths, const std::vector<Placed> &placed) {
    std::vector<Capsule> capsules;
    for (std::uint32_t i = 0; i < placed.size(); ++i)
        for (std::size_t k = 0; k + 1 < placed[i].stations.size(); ++k)
            capsules.push_back({glm::vec3(placed[i].stations[k].position),
                                glm::vec3(placed[i].stations[k + 1].position),
                                static_cast<float>(paths[placed[i].path].radius), i});
    return least_gap(capsules);
}

} // namespace

Neighbour neighbour(const Strand &strand, std::uint32_t segment, bool next, float size) {
    const std::uint32_t end = strand.first_segment + strand.count;
    if (next && segment + 1 == end)
        return {segment + 1 - strand.per_cell, -size};
    if (!next && segment == strand.first_segment)
        return {segment - 1 + strand.per_cell, size};
    return {next ? segment + 1 : segment - 1, 0};
}

std::vector<OutlinePoint> outline(FilamentSection section, double corner_rounding, int points) {
    std::vector<OutlinePoint> result;
    const int count = std::max(points, 12) / 3 * 3; // of all sections alike
    if (section == FilamentSection::triangular) {
        // Three corners of a circle each, joined by straight edges
        const double corner = std::clamp(corner_rounding, kSharpestCorner, 1.0);
        const int each = count / 3;
        for (int i = 0; i < 3 * each; ++i) {
            const int corner_of = i / each;
            const double middle = 2 * kPi / 3 * corner_of;
            const double a = middle + kPi / 3 * (2.0 * (i % each) / (each - 1) - 1);
            const glm::dvec2 n{std::cos(a), std::sin(a)};
            const glm::dvec2 centre{std::cos(middle), std::sin(middle)};
            result.push_back({(1 - corner) * centre + corner * n, n});
        }
        return result;
    }
    // A circle whose radius has three waves
    const double depth =
        section == FilamentSection::trilobal ? kDeepestHollow * (1 - corner_rounding) : 0;
    for (int i = 0; i < count; ++i) {
        const double a = 2 * kPi * i / count;
        const double r = 1 - 0.5 * depth * (1 - std::cos(3 * a)),
                     dr = -1.5 * depth * std::sin(3 * a);
        const glm::dvec2 radial{std::cos(a), std::sin(a)}, ahead{-std::sin(a), std::cos(a)};
        result.push_back({r * radial, glm::normalize(r * radial - dr * ahead)});
    }
    return result;
}

FilamentCell::FilamentCell(const FilamentRepeat &repeat, double turn_per_segment,
                           int section_points, const Progress &progress) {
    double radius = 0;
    for (const FilamentOptics &optics : repeat.optics)
        clear.push_back(optics.transmission > 0);
    for (const Filament &f : repeat.filaments)
        radius += f.radius;
    unit = radius / static_cast<double>(repeat.filaments.size());
    const double scale = static_cast<double>(repeat.filaments.size()) / radius;
    const glm::dvec2 period = repeat.size * scale;
    std::vector<Path> paths;
    bottom = 1e30f;
    top = -1e30f;
    for (const Filament &f : repeat.filaments) {
        stop_if_asked(progress);
        const glm::dvec3 step =
            f.system == 0 ? glm::dvec3(0, period.y, 0) : glm::dvec3(period.x, 0, 0);
        paths.push_back(divide(f, step, scale, turn_per_segment));
        if (repeat.optics[f.system].section != FilamentSection::round)
            thin(paths.back(), kTubeTurn * turn_per_segment);
        for (const Path::Station &s : paths.back().station) {
            bottom = std::min(bottom, static_cast<float>(s.position.z - paths.back().radius));
            top = std::max(top, static_cast<float>(s.position.z + paths.back().radius));
        }
    }
    const glm::dvec2 cells =
        glm::max(glm::dvec2(1), glm::ceil(kFlatness * (top - bottom) / period));
    const glm::dvec2 whole = period * cells;
    size = whole;
    std::vector<Placed> placed;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        stop_if_asked(progress);
        place(paths[i], i, repeat.filaments[i].system == 0 ? 1 : 0, period, whole, placed);
    }
    if (std::find(clear.begin(), clear.end(), true) != clear.end())
        separate(gap_of(paths, placed), repeat.name);
    for (const Placed &p : placed) {
        stop_if_asked(progress);
        const std::uint32_t system = repeat.filaments[p.path].system;
        const FilamentOptics &optics = repeat.optics[system];
        const bool round = optics.section == FilamentSection::round;
        const int along = system == 0 ? 1 : 0;
        const auto number = static_cast<std::uint32_t>(strands.size());
        strands.push_back({.system = system,
                           .filament = static_cast<std::uint32_t>(p.path),
                           .radius = static_cast<float>(paths[p.path].radius * thinning),
                           .axis = along,
                           .first_segment = static_cast<std::uint32_t>(round ? cones.first.size()
                                                                             : tubes.ring.size()),
                           .count = static_cast<std::uint32_t>(p.stations.size()) - 1,
                           .per_cell = static_cast<std::uint32_t>(std::lround(
                               static_cast<double>(paths[p.path].station.size()) * cells[along]))});
        if (round)
            add_cones(cones, p.stations, strands.back(), number);
        else
            add_tube(tubes, p.stations, strands.back(), number,
                     outline(optics.section, optics.corner_rounding, section_points));
    }
}

void FilamentCell::separate(double found, const std::string &name) {
    thinning = std::min(1.0, (1 + found) / (1 + kLeastGap));
    gap = std::max(found, kLeastGap);
    if (thinning < 1 - kMostThinning)
        throw Error({"filaments that light goes through overlap by " +
                         std::to_string(-found * 100) + " % of the sum of their radii",
                     name.empty() ? "repeat" : name,
                     "expected an overlap of at most 20 %: thinner filaments or paths clear of "
                     "each other"});
}

} // namespace tsuya::lab
