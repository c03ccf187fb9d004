#include "accelerator.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <span>

#include "tsuya/sdk/detail/bvh_monitor.h"
#include "tsuya/sdk/detail/embree_ray.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

namespace {

static_assert(RayPacket::kMost == 8, "RTCRay8");

struct alignas(32) Lanes {
    int valid[RayPacket::kMost] = {};
};

// The rays of a packet in their lanes; those behind the last stay idle.
Lanes fill(const RayPacket &rays, RTCRay8 &to) {
    Lanes lanes;
    for (std::size_t i = 0; i < rays.count; ++i) {
        lanes.valid[i] = -1;
        to.org_x[i] = rays.origin[i].x;
        to.org_y[i] = rays.origin[i].y;
        to.org_z[i] = rays.origin[i].z;
        to.tnear[i] = 0;
        to.dir_x[i] = rays.direction[i].x;
        to.dir_y[i] = rays.direction[i].y;
        to.dir_z[i] = rays.direction[i].z;
        to.tfar[i] = rays.farthest[i];
        to.mask[i] = ~0u;
    }
    return lanes;
}

RTCIntersectContext coherent_context() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

// An object as the BVH holds it.
struct Part {
    std::uint64_t key = 0; // a hash of the object's shape about the centre
    // Embree reads these in place and wants 4 spare bytes behind the last vertex
    std::vector<glm::vec3> positions{};
    std::vector<glm::uvec3> triangles{}; // empty: those of the scene
};

// Word by word, each step one to one in the word: a tenth of the time of detail::Hasher.
template <class T> void hash_words(std::span<const T> values, std::uint64_t &state) {
    const auto *byte = reinterpret_cast<const unsigned char *>(values.data());
    for (std::size_t left = values.size_bytes(); left > 0;) {
        std::uint64_t word = 0;
        const std::size_t size = std::min(left, sizeof word);
        std::memcpy(&word, byte, size);
        state = std::rotl((state ^ word) * 0x9e3779b97f4a7c15ull, 29);
        byte += size;
        left -= size;
    }
}

std::uint64_t key_of(const Surface &surface, const glm::dvec3 &centre) {
    std::uint64_t state = surface.position.size();
    hash_words(std::span(&centre, 1), state);
    hash_words(std::span(surface.position), state);
    hash_words(std::span(surface.triangle), state);
    return state;
}

Part make_part(const Surface &surface, const glm::dvec3 &centre) {
    Part part;
    part.positions.reserve(surface.position.size() + 1);
    for (const glm::dvec3 &p : surface.position)
        part.positions.emplace_back(p - centre);
    part.positions.emplace_back(0.0f);
    return part;
}

} // namespace

struct Accelerator::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Part> parts{}; // per object
    bool is_kept = false;      // the last update ended, and its parts are whole
    std::size_t built = 0, taken = 0;

    State() = default;
    State(const State &) = delete;
    State &operator=(const State &) = delete;
    ~State() {
        release();
        if (device)
            rtcReleaseDevice(device);
    }
    void release() {
        if (scene)
            rtcReleaseScene(scene);
        scene = nullptr;
        parts.clear();
    }
    void begin();
    void attach(std::uint32_t object, const std::vector<glm::uvec3> &triangles);
    void commit(const Progress &progress);
};

Accelerator::Accelerator() : state_(std::make_unique<State>()) {}
Accelerator::~Accelerator() = default;

std::size_t Accelerator::objects_built() const { return state_->built; }
std::size_t Accelerator::objects_kept() const { return state_->taken; }

void Accelerator::State::begin() {
    if (!device)
        device = rtcNewDevice(nullptr);
    if (!device)
        throw Error({"Embree cannot be started on this machine", "", ""});
    if (!is_kept)
        release();
    is_kept = false;
    if (scene)
        return;
    scene = rtcNewScene(device);
    // Watertight at shared edges, and a BVH for each object
    rtcSetSceneFlags(scene,
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
}

void Accelerator::State::attach(std::uint32_t object, const std::vector<glm::uvec3> &triangles) {
    const Part &part = parts[object];
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               part.positions.data(), 0, sizeof(glm::vec3),
                               part.positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof(glm::uvec3), triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, object);
    rtcReleaseGeometry(geometry);
}

void Accelerator::State::commit(const Progress &progress) {
    detail::BvhMonitor monitor(progress);
    rtcSetSceneProgressMonitorFunction(scene, detail::BvhMonitor::ask, &monitor);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    monitor.check(rtcGetDeviceError(device));
}

void Accelerator::update(const Scene &scene, const glm::dvec3 &centre, bool keep,
                         const Progress &progress) {
    State &s = *state_;
    s.begin();
    const std::size_t before = s.parts.size(), now = scene.objects.size();
    for (std::size_t i = now; i < before; ++i)
        rtcDetachGeometry(s.scene, static_cast<std::uint32_t>(i));
    s.parts.resize(now);
    for (std::uint32_t i = 0; i < now; ++i) {
        const Surface &surface = scene.surfaces[scene.objects[i].surface.value];
        const std::uint64_t key = keep ? key_of(surface, centre) : 0;
        if (i < before && s.parts[i].key == key) {
            ++s.taken;
            continue;
        }
        if (i < before)
            rtcDetachGeometry(s.scene, i);
        s.parts[i] = make_part(surface, centre);
        s.parts[i].key = key;
        if (keep)
            s.parts[i].triangles = surface.triangle;
        s.attach(i, keep ? s.parts[i].triangles : surface.triangle);
        ++s.built;
    }
    s.commit(progress);
    s.is_kept = keep;
}

const std::vector<glm::vec3> &Accelerator::positions(std::uint32_t object) const {
    return state_->parts[object].positions;
}

bool Accelerator::intersect(const glm::vec3 &origin, const glm::vec3 &direction, float farthest,
                            Hit &hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{.ray = detail::make_ray<RTCRay>(origin, direction, farthest), .hit = {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    hit.distance = query.ray.tfar;
    hit.barycentric = {1 - query.hit.u - query.hit.v, query.hit.u, query.hit.v};
    hit.face_normal = {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
    hit.object = query.hit.geomID;
    hit.triangle = query.hit.primID;
    return true;
}

bool Accelerator::occluded(const glm::vec3 &origin, const glm::vec3 &direction,
                           float farthest) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = detail::make_ray<RTCRay>(origin, direction, farthest);
    rtcOccluded1(state_->scene, &context, &ray);
    return ray.tfar < 0;
}

void Accelerator::intersect(const RayPacket &rays, std::array<Hit, RayPacket::kMost> &hits) const {
    RTCIntersectContext context = coherent_context();
    RTCRayHit8 query{};
    const Lanes lanes = fill(rays, query.ray);
    for (unsigned &id : query.hit.geomID)
        id = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect8(lanes.valid, state_->scene, &context, &query);
    for (std::size_t i = 0; i < rays.count; ++i) {
        const bool is_hit = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        const float u = query.hit.u[i], v = query.hit.v[i];
        hits[i] = {.distance = is_hit ? query.ray.tfar[i] : std::numeric_limits<float>::infinity(),
                   .barycentric = {1 - u - v, u, v},
                   .face_normal = {query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]},
                   .object = query.hit.geomID[i],
                   .triangle = query.hit.primID[i]};
    }
}

void Accelerator::occluded(const RayPacket &rays,
                           std::array<bool, RayPacket::kMost> &occluded) const {
    RTCIntersectContext context = coherent_context();
    RTCRay8 query{};
    const Lanes lanes = fill(rays, query);
    rtcOccluded8(lanes.valid, state_->scene, &context, &query);
    for (std::size_t i = 0; i < rays.count; ++i)
        occluded[i] = query.tfar[i] < 0;
}

} // namespace tsuya
