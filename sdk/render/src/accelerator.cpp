#include "accelerator.h"

#include <embree3/rtcore.h>

#include "tsuya/sdk/detail/bvh_monitor.h"
#include "tsuya/sdk/detail/embree_ray.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

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

} // namespace tsuya
