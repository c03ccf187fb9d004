#include "photon_walk.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::lab {
namespace {

constexpr float kOffset = 2e-3f; // of a ray from the surface that it leaves, radii
// Of the energy per solid angle, times the views: what makes a view dim
constexpr double kDim = 0.001;
constexpr float kLeastCosine = 1e-5f; // of a photon with the surface

// A batch has one photon in each of 128 x 64 parts of the cell, in an order in which neighbours
// follow each other and meet the same part of the acceleration structure.
const glm::vec2 kStrata{128, 64};
static_assert(kPhotonsPerBatch == 128 * 64);

std::uint32_t every_second_bit(std::uint32_t x) {
    x &= 0x55555555u;
    x = (x | x >> 1) & 0x33333333u;
    x = (x | x >> 2) & 0x0f0f0f0fu;
    x = (x | x >> 4) & 0x00ff00ffu;
    return (x | x >> 8) & 0x0000ffffu;
}

class Walker {
  public:
    Walker(const FilamentScene &scene, const std::vector<RoughSurface> &surfaces,
           const LightViews &light, const WalkRules &rules, Random random)
        : scene_(scene), surfaces_(surfaces), light_(light), rules_(rules), random_(random) {}

    // \param place of the start, a share of the cell
    void photon(const glm::vec2 &place, Sums &sums);
    glm::vec2 jitter() { return {random_.unit(), random_.unit()}; }
    std::uint64_t rays() const { return rays_; }

  private:
    struct Seen {
        std::uint32_t view;
        double value;
    };

    Fate trace(const glm::vec3 &origin, const glm::vec3 &direction, Meeting &meeting) {
        ++rays_;
        return scene_.trace(origin, direction, meeting);
    }
    static glm::vec3 outside(const Meeting &m) { return m.point + kOffset * m.normal; }
    // Adds energy per solid angle that leaves a meeting towards a view, if the view is not hidden.
    void see(const Meeting &m, std::uint32_t view, double per_sr);
    // What the views see of a reflection; `from` in the surface's frame
    void connect(const Meeting &m, const Frame &frame, const glm::vec3 &from, bool first,
                 double energy);
    // What the views see of light that comes out
    void connect_exit(const Meeting &m, double energy);
    // The next leg of the path after a meeting; false where it ends
    bool scatter(Meeting &meeting, glm::vec3 &direction, bool first, double &energy);
    void store(Sums &sums);

    const FilamentScene &scene_;
    const std::vector<RoughSurface> &surfaces_;
    const LightViews &light_;
    const WalkRules &rules_;
    Random random_;
    std::uint64_t rays_ = 0;
    std::vector<Seen> seen_;
};

void Walker::see(const Meeting &m, std::uint32_t view, double per_sr) {
    const glm::vec3 &to = light_.to_viewer[view];
    if (!(per_sr > 0))
        return;
    ++rays_;
    if (scene_.escapes(outside(m), to))
        seen_.push_back({view, per_sr / to.z});
}

void Walker::connect(const Meeting &m, const Frame &frame, const glm::vec3 &from, bool first,
                     double energy) {
    const RoughSurface &surface = surfaces_[m.system];
    const auto views = static_cast<float>(light_.to_viewer.size());
    const auto multiple = static_cast<float>(std::min(0.5, surface.multiple_share(from.z)));
    if (random_.unit() < multiple) {
        const auto view = static_cast<std::uint32_t>(random_.unit() * views);
        const float mu = glm::dot(light_.to_viewer[view], m.normal);
        see(m, view, energy * surface.multiple_per_sr(from.z, mu) * views / multiple);
        return;
    }
    const ViewTree::Choice choice =
        first ? light_.by_half[m.system].sample(m.normal, random_)
              : light_.by_mirror[m.system].sample(frame.to_world({-from.x, -from.y, from.z}),
                                                  random_);
    const glm::vec3 to = frame.to_local(light_.to_viewer[choice.index]);
    double value = surface.single_per_sr(from, to) / (choice.chance * (1 - multiple));
    // Of views that see next to nothing, only some are worth a ray
    const double dim = kDim * views;
    if (value < dim) {
        if (random_.unit() * dim >= value)
            return;
        value = dim;
    }
    see(m, choice.index, energy * value);
}

void Walker::connect_exit(const Meeting &m, double energy) {
    const auto views = static_cast<float>(light_.to_viewer.size());
    const auto view = static_cast<std::uint32_t>(random_.unit() * views);
    const float mu = glm::dot(light_.to_viewer[view], m.normal);
    if (mu > 0)
        see(m, view, energy * surfaces_[m.system].exit().per_sr(mu) * views);
}

bool Walker::scatter(Meeting &meeting, glm::vec3 &direction, bool first, double &energy) {
    const RoughSurface &surface = surfaces_[meeting.system];
    const Frame frame = make_frame(meeting.normal);
    glm::vec3 from = frame.to_local(-direction);
    from.z = std::max(from.z, kLeastCosine);
    connect(meeting, frame, from, first, energy);
    const RoughSurface::Reflection reflection = surface.sample(from, random_);
    const double enters = (1 - reflection.weight) * surface.transmission();
    const double all = reflection.weight + enters;
    direction = frame.to_world(reflection.direction);
    if (enters > 0) {
        const Meeting exit = scene_.around(meeting, random_.unit());
        connect_exit(exit, energy * enters);
        if (random_.unit() * all >= reflection.weight) {
            const double mu = surface.exit().sample(random_);
            const double r = std::sqrt(std::max(0.0, 1 - mu * mu));
            const double phi = 2 * kPi * random_.unit();
            meeting = exit;
            direction = make_frame(exit.normal)
                            .to_world(glm::vec3(r * std::cos(phi), r * std::sin(phi), mu));
        }
    }
    energy *= all;
    if (energy >= rules_.energy_bound)
        return true;
    const bool survives = random_.unit() * rules_.energy_bound < energy;
    energy = rules_.energy_bound;
    return survives;
}

void Walker::store(Sums &sums) {
    // A photon that reaches a view twice is one sample of it
    for (std::size_t i = 0; i < seen_.size(); ++i)
        for (std::size_t j = i + 1; j < seen_.size();)
            if (seen_[j].view == seen_[i].view) {
                seen_[i].value += seen_[j].value;
                seen_[j] = seen_.back();
                seen_.pop_back();
            } else {
                ++j;
            }
    for (const Seen &s : seen_) {
        sums.value[s.view] += s.value;
        sums.square[s.view] += s.value * s.value;
    }
}

void Walker::photon(const glm::vec2 &place, Sums &sums) {
    const FilamentCell &cell = scene_.cell();
    seen_.clear();
    glm::vec3 origin(place * cell.size, cell.top + kOffset);
    glm::vec3 direction = -light_.to_light;
    double energy = 1;
    for (int bounce = 0;; ++bounce) {
        Meeting meeting;
        const Fate fate = trace(origin, direction, meeting);
        if (fate == Fate::above) {
            sums.reflected += energy;
            sums.reflected_square += energy * energy;
        } else if (fate == Fate::below) {
            sums.transmitted += energy;
            sums.transmitted_square += energy * energy;
        }
        if (fate != Fate::met || (rules_.max_bounces > 0 && bounce > rules_.max_bounces))
            break;
        if (!scatter(meeting, direction, bounce == 0, energy))
            break;
        origin = outside(meeting);
    }
    store(sums);
}

} // namespace

LightViews::LightViews(const glm::vec3 &light, std::vector<glm::vec3> viewers,
                       const std::vector<RoughSurface> &surfaces)
    : to_light(light), to_viewer(std::move(viewers)) {
    std::vector<glm::vec3> half;
    std::vector<float> weight(to_viewer.size(), 1.0f);
    for (const glm::vec3 &v : to_viewer)
        half.push_back(glm::normalize(v + light));
    for (const RoughSurface &surface : surfaces) {
        const auto slope = static_cast<float>(surface.slope());
        by_half.emplace_back(half, weight, slope);
        by_mirror.emplace_back(to_viewer, weight, 2 * slope);
    }
}

void Sums::add(const Sums &other) {
    for (std::size_t i = 0; i < value.size(); ++i) {
        value[i] += other.value[i];
        square[i] += other.square[i];
    }
    reflected += other.reflected;
    reflected_square += other.reflected_square;
    transmitted += other.transmitted;
    transmitted_square += other.transmitted_square;
}

std::uint64_t walk(const FilamentScene &scene, const std::vector<RoughSurface> &surfaces,
                   const LightViews &light, const WalkRules &rules, Random random, Sums &sums) {
    Walker walker(scene, surfaces, light, rules, random);
    for (std::uint32_t i = 0; i < kPhotonsPerBatch; ++i) {
        const glm::vec2 corner(every_second_bit(i), every_second_bit(i >> 1));
        walker.photon((corner + walker.jitter()) / kStrata, sums);
    }
    return walker.rays();
}

} // namespace tsuya::lab
