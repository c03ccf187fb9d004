#include "photon_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::lab {
namespace {

// Of the energy per solid angle, times the views: what makes a view dim
constexpr double kDim = 0.001;
constexpr float kLeastCosine = 1e-5f; // of a photon with the surface
constexpr float kForever = std::numeric_limits<float>::infinity();
// Of the light that comes out through one facet, in slopes: less about the normal, more beside it
constexpr float kExitWidth = 1;

// A batch has one photon in each of 128 x 64 parts of the cell, in an order in which neighbours
// follow each other and meet the same part of the acceleration structure.
const glm::vec2 kStrata{128, 64};
static_assert(kPhotonsPerBatch == std::uint64_t{128} * 64);

std::uint32_t every_second_bit(std::uint32_t x) {
    x &= 0x55555555u;
    x = (x | x >> 1) & 0x33333333u;
    x = (x | x >> 2) & 0x0f0f0f0fu;
    x = (x | x >> 4) & 0x00ff00ffu;
    return (x | x >> 8) & 0x0000ffffu;
}

// On its way.
struct Photon {
    glm::vec3 origin, direction;
    double energy = 1;
    bool first = true;    // has hit nothing
    bool inside = false;  // a filament
    bool entered = false; // has been in one
    Inside place{};       // where, if so
};

class Walker {
  public:
    Walker(const FilamentScene &scene, const std::vector<FilamentMatter> &matter,
           const LightViews &light, const WalkRules &rules, Random random)
        : scene_(scene), matter_(matter), light_(light), rules_(rules), random_(random) {}

    // \param place of the start, a share of the cell
    void photon(const glm::vec2 &place, Sums &sums);
    glm::vec2 jitter() { return {random_.unit(), random_.unit()}; }
    std::uint64_t rays() const { return rays_; }

  private:
    struct Seen {
        std::uint32_t view;
        double value;
    };

    Fate trace(const glm::vec3 &origin, const glm::vec3 &direction, Hit &hit) {
        ++rays_;
        return scene_.trace(origin, direction, hit);
    }
    static glm::vec3 outside(const Hit &m) { return m.point + kRayOffset * m.normal; }
    // Adds energy per solid angle that leaves a hit towards a view, if the view is not hidden.
    void see(const Hit &m, std::uint32_t view, double per_sr);
    // The same for a view that was drawn with a probability; of dim ones only some are worth a ray.
    void see_some(const Hit &m, std::uint32_t view, double energy, double value);
    // One of the views, all alike.
    std::uint32_t any_view() {
        return static_cast<std::uint32_t>(random_.unit() *
                                          static_cast<float>(light_.to_viewer.size()));
    }
    // What the views see of a reflection; `from` in the surface's frame
    void connect(const Hit &m, const Frame &frame, const glm::vec3 &from, bool first,
                 double energy);
    // What the views see of light that comes out
    void connect_exit(const Hit &m, const Frame &frame, const glm::vec3 &from, double energy);
    // To the next hit
    Fate advance(Photon &photon, Hit &hit);
    Fate within(Photon &photon, Hit &hit);
    // Whether light that has or has not been in a filament is of the part that is measured
    bool counts(bool entered) const {
        return rules_.part == LightPart::all || (rules_.part == LightPart::body) == entered;
    }
    // The next leg of the path after a hit; false where it ends
    bool reflect(const Hit &hit, Photon &photon);
    bool pass(const Hit &hit, Photon &photon);
    bool survives(double &energy);
    void store(Sums &sums);

    const FilamentScene &scene_;
    const std::vector<FilamentMatter> &matter_;
    const LightViews &light_;
    const WalkRules &rules_;
    Random random_;
    std::uint64_t rays_ = 0;
    std::vector<Seen> seen_;
};

void Walker::see(const Hit &m, std::uint32_t view, double per_sr) {
    const glm::vec3 &to = light_.to_viewer[view];
    if (!(per_sr > 0))
        return;
    ++rays_;
    if (scene_.escapes(outside(m), to))
        seen_.push_back({view, per_sr / to.z});
}

void Walker::see_some(const Hit &m, std::uint32_t view, double energy, double value) {
    const double dim = kDim * static_cast<float>(light_.to_viewer.size());
    if (value < dim) {
        if (random_.unit() * dim >= value)
            return;
        value = dim;
    }
    see(m, view, energy * value);
}

void Walker::connect(const Hit &m, const Frame &frame, const glm::vec3 &from, bool first,
                     double energy) {
    const RoughSurface &surface = matter_[m.system].surface;
    const std::optional<FilamentBody> &body = matter_[m.system].body;
    const auto views = static_cast<float>(light_.to_viewer.size());
    double share = surface.multiple_share(from.z);
    if (body)
        share += body->boundary.even_share(from.z, Side::outside);
    const auto multiple = static_cast<float>(std::min(0.5, share));
    if (random_.unit() < multiple) {
        const std::uint32_t view = any_view();
        const float mu = glm::dot(light_.to_viewer[view], m.normal);
        double value = surface.multiple_per_sr(from.z, mu);
        if (body && mu > 0)
            value += body->boundary.even_per_sr(from.z, Side::outside, mu, Side::outside);
        see(m, view, energy * value * views / multiple);
        return;
    }
    const ViewTree::Choice choice =
        first ? light_.by_half[m.system].sample(m.normal, random_)
              : light_.by_mirror[m.system].sample(frame.to_world({-from.x, -from.y, from.z}),
                                                  random_);
    const glm::vec3 to = frame.to_local(light_.to_viewer[choice.index]);
    see_some(m, choice.index, energy,
             surface.single_per_sr(from, to) / (choice.probability * (1 - multiple)));
}

void Walker::connect_exit(const Hit &m, const Frame &frame, const glm::vec3 &from, double energy) {
    const RoughDielectric &boundary = matter_[m.system].body->boundary;
    const auto even = static_cast<float>(std::min(0.5, boundary.even_share(from.z, Side::inside)));
    if (random_.unit() < even) {
        const std::uint32_t view = any_view();
        const float mu = glm::dot(light_.to_viewer[view], m.normal);
        if (mu > 0)
            see(m, view,
                energy * boundary.even_per_sr(from.z, Side::inside, mu, Side::outside) *
                    static_cast<float>(light_.to_viewer.size()) / even);
        return;
    }
    if (!boundary.passes(from, Side::inside))
        return;
    const ViewTree::Choice choice = light_.by_exit[m.system].sample(
        frame.to_world(boundary.refracted(from, Side::inside)), random_);
    const glm::vec3 to = frame.to_local(light_.to_viewer[choice.index]);
    see_some(m, choice.index, energy,
             boundary.through_per_sr(from, to, Side::inside) / (choice.probability * (1 - even)));
}

bool Walker::survives(double &energy) {
    if (energy >= rules_.energy_bound)
        return true;
    const bool goes_on = random_.unit() * rules_.energy_bound < energy;
    energy = rules_.energy_bound;
    return goes_on;
}

bool Walker::reflect(const Hit &hit, Photon &photon) {
    const Frame frame = make_frame(hit.normal);
    glm::vec3 from = frame.to_local(-photon.direction);
    from.z = std::max(from.z, kLeastCosine);
    if (counts(photon.entered))
        connect(hit, frame, from, photon.first, photon.energy);
    const RoughSurface::Reflection reflection = matter_[hit.system].surface.sample(from, random_);
    photon.direction = frame.to_world(reflection.direction);
    photon.origin = outside(hit);
    photon.energy *= reflection.weight;
    return survives(photon.energy);
}

bool Walker::pass(const Hit &hit, Photon &photon) {
    const RoughDielectric &boundary = matter_[hit.system].body->boundary;
    const Side side = photon.inside ? Side::inside : Side::outside;
    const Frame frame = make_frame(photon.inside ? -hit.normal : hit.normal);
    glm::vec3 from = frame.to_local(-photon.direction);
    from.z = std::max(from.z, kLeastCosine);
    if (photon.inside && counts(true))
        connect_exit(hit, frame, from, photon.energy);
    else if (!photon.inside && counts(photon.entered))
        connect(hit, frame, from, photon.first, photon.energy);
    const RoughDielectric::Passage passage = boundary.sample(from, side, random_);
    photon.direction = frame.to_world(passage.direction);
    photon.inside = photon.inside != passage.through;
    photon.entered = photon.entered || photon.inside;
    if (photon.entered && rules_.part == LightPart::surface)
        return false;
    if (photon.inside)
        photon.place = {hit.on_cone ? hit.point : hit.point - kRayOffset * hit.normal, hit.segment,
                        hit.on_cone};
    else
        photon.origin = outside(hit);
    return survives(photon.energy);
}

Fate Walker::advance(Photon &photon, Hit &hit) {
    return photon.inside ? within(photon, hit) : trace(photon.origin, photon.direction, hit);
}

Fate Walker::within(Photon &photon, Hit &hit) {
    const FilamentCell &cell = scene_.cell();
    const Strand &strand = cell.strands[scene_.strand(photon.place.segment, photon.place.on_cone)];
    const FilamentBody &body = *matter_[strand.system].body;
    const double depth = body.depth / (2 * strand.radius), turns = body.scattering * cell.unit;
    for (;;) {
        const double reach = turns > 0 ? -std::log(random_.open_unit()) / turns
                                       : std::numeric_limits<double>::infinity();
        float travelled;
        ++rays_;
        const Fate fate = scene_.within(photon.place, photon.direction, static_cast<float>(reach),
                                        hit, travelled);
        photon.energy *= std::exp(-depth * travelled);
        if (fate != Fate::lost || turns <= 0)
            return fate;
        photon.direction = scattered(photon.direction, body.anisotropy, random_);
        if (!survives(photon.energy)) {
            photon.energy = 0;
            return Fate::lost;
        }
    }
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
    Photon photon{glm::vec3(place * cell.size, cell.top + kRayOffset), -light_.to_light};
    for (int bounce = 0;; ++bounce) {
        Hit hit;
        const Fate fate = advance(photon, hit);
        const double energy = counts(photon.entered) ? photon.energy : 0;
        if (fate == Fate::above) {
            sums.reflected += energy;
            sums.reflected_square += energy * energy;
        } else if (fate == Fate::below) {
            sums.transmitted += energy;
            sums.transmitted_square += energy * energy;
        }
        if (fate != Fate::hit || (rules_.max_bounces > 0 && bounce > rules_.max_bounces))
            break;
        if (!(matter_[hit.system].body ? pass(hit, photon) : reflect(hit, photon)))
            break;
        photon.first = false;
    }
    store(sums);
}

} // namespace

LightViews::LightViews(const glm::vec3 &light, std::vector<glm::vec3> viewers,
                       const std::vector<FilamentMatter> &matter)
    : to_light(light), to_viewer(std::move(viewers)) {
    std::vector<glm::vec3> half;
    std::vector<float> weight(to_viewer.size(), 1.0f);
    for (const glm::vec3 &v : to_viewer)
        half.push_back(glm::normalize(v + light));
    for (const FilamentMatter &m : matter) {
        const auto slope = static_cast<float>(m.surface.slope());
        by_half.emplace_back(half, weight, slope);
        by_mirror.emplace_back(to_viewer, weight, 2 * slope);
        by_exit.emplace_back();
        if (m.body)
            by_exit.back() = ViewTree(to_viewer, weight, kExitWidth * slope);
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

std::uint64_t walk(const FilamentScene &scene, const std::vector<FilamentMatter> &matter,
                   const LightViews &light, const WalkRules &rules, Random random, Sums &sums) {
    Walker walker(scene, matter, light, rules, random);
    for (std::uint32_t i = 0; i < kPhotonsPerBatch; ++i) {
        const glm::vec2 corner(every_second_bit(i), every_second_bit(i >> 1));
        walker.photon((corner + walker.jitter()) / kStrata, sums);
    }
    return walker.rays();
}

} // namespace tsuya::lab
