#include "accelerator.h"

#include <embree3/rtcore.h>

#include <limits>

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

} // namespace

struct Accelerator::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    // Per object; Embree reads them in place and wants 4 spare bytes behind the last vertex
    std::vector<std::vector<glm::vec3>> positions;
    std::vector<const std::vector<glm::uvec3> *> triangles;

    ~State() {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
};

Accelerator::Accelerator(const Scene &scene, const glm::dvec3 &centre, const Progress &progress)
    : state_(std::make_unique<State>()) {
    state_->device = rtcNewDevice(nullptr);
    if (!state_->device)
        throw Error({"Embree cannot be started on this machine", "", ""});
    state_->scene = rtcNewScene(state_->device);
    // Watertight at shared edges
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Surface &surface = scene.surfaces[scene.objects[i].surface.value];
        std::vector<glm::vec3> &positions = state_->positions.emplace_back();
        positions.reserve(surface.position.size() + 1);
        for (const glm::dvec3 &p : surface.position)
            positions.emplace_back(p - centre);
        positions.emplace_back(0.0f);
        state_->triangles.push_back(&surface.triangle);
        const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   positions.data(), 0, sizeof(glm::vec3), positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   surface.triangle.data(), 0, sizeof(glm::uvec3),
                                   surface.triangle.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(state_->scene, geometry, i);
        rtcReleaseGeometry(geometry);
    }
    detail::BvhMonitor monitor(progress);
    rtcSetSceneProgressMonitorFunction(state_->scene, detail::BvhMonitor::ask, &monitor);
    rtcCommitScene(state_->scene);
    rtcSetSceneProgressMonitorFunction(state_->scene, nullptr, nullptr);
    monitor.check(rtcGetDeviceError(state_->device));
}

Accelerator::~Accelerator() = default;

const std::vector<glm::vec3> &Accelerator::positions(std::uint32_t object) const {
    return state_->positions[object];
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
