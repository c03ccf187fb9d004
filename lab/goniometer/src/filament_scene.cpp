#include "filament_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <embree3/rtcore.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/bvh_monitor.h"
#include "tsuya/sdk/detail/embree_ray.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr unsigned kCones = 0, kTubes = 1;
// Walls: of more, spatial splits take many seconds, at first some in which Embree does not ask
// whether to stop, and rays through the millions of the silk charmeuse are no faster.
constexpr std::size_t kMostSplit = 500'000;
constexpr int kMostSteps = 20000;  // cells and inner walls that one ray passes
constexpr float kPastWall = 1e-3f; // radii: how far beyond an inner wall a ray goes on

// A vertex buffer in place, with the spare bytes that Embree reads behind its end.
template <class T>
void share(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::vector<T> &items) {
    const std::size_t count = items.size();
    items.reserve(count + 16 / sizeof(T) + 1);
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, items.data(), 0, sizeof(T), count);
}

// Distance along one axis to the side of the cell.
float to_side(float position, float direction, float size) {
    if (direction == 0)
        return std::numeric_limits<float>::infinity();
    return std::max(0.0f, ((direction > 0 ? size : 0) - position) / direction);
}

} // namespace

struct FilamentScene::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~State() {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
    void attach(RTCGeometry geometry, unsigned id) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }
};

FilamentScene::FilamentScene(FilamentCell cell, const Progress &progress, Normals normals)
    : cell_(std::move(cell)), normals_(normals), state_(std::make_unique<State>()) {
    state_->device = rtcNewDevice(nullptr);
    if (!state_->device)
        throw Error({"Embree cannot be started on this machine", "", ""});
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneBuildQuality(state_->scene, cell_.tubes.quad.size() > kMostSplit
                                               ? RTC_BUILD_QUALITY_MEDIUM
                                               : RTC_BUILD_QUALITY_HIGH);
    if (Cones &c = cell_.cones; !c.first.empty()) {
        const RTCGeometry geometry =
            rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
        share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, c.vertex);
        share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, c.first);
        state_->attach(geometry, kCones);
    }
    if (Tubes &t = cell_.tubes; !t.quad.empty()) {
        const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_QUAD);
        share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, t.position);
        share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, t.quad);
        state_->attach(geometry, kTubes);
    }
    tsuya::detail::BvhMonitor monitor(progress);
    rtcSetSceneProgressMonitorFunction(state_->scene, tsuya::detail::BvhMonitor::ask, &monitor);
    rtcCommitScene(state_->scene);
    rtcSetSceneProgressMonitorFunction(state_->scene, nullptr, nullptr);
    monitor.check(rtcGetDeviceError(state_->device));
}

FilamentScene::~FilamentScene() = default;

namespace {

// The normal of the tube about the smooth axis, not of the cone: it does not jump at the joints.
glm::vec3 smooth_normal(const Cones &cones, std::uint32_t segment, const glm::vec3 &point) {
    const std::uint32_t first = cones.first[segment];
    const glm::vec3 a(cones.vertex[first]), axis = glm::vec3(cones.vertex[first + 1]) - a;
    const float along = std::clamp(glm::dot(point - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
    const glm::vec3 tangent =
        glm::normalize(glm::mix(cones.tangent[first], cones.tangent[first + 1], along));
    const glm::vec3 radial = point - a - along * axis;
    return glm::normalize(radial - tangent * glm::dot(radial, tangent));
}

// The mean of the normals at the corners of the triangle that was hit.
glm::vec3 smooth_normal(const Tubes &tubes, const RTCHit &hit) {
    const glm::uvec4 &q = tubes.quad[hit.primID];
    const bool first = hit.u + hit.v <= 1;
    const float u = first ? hit.u : 1 - hit.u, v = first ? hit.v : 1 - hit.v;
    return glm::normalize((1 - u - v) * tubes.normal[first ? q.x : q.z] +
                          u * tubes.normal[first ? q.y : q.w] +
                          v * tubes.normal[first ? q.w : q.y]);
}

} // namespace

// The part of a ray within the cell.
struct FilamentScene::Leg {
    float side;  // distance to the nearer side
    float end;   // distance to the top or bottom
    int crossed; // axis of that side

    float length() const { return std::min(side, end) * 1.0001f; }
    bool leaves() const { return end <= side; }
    // To where the ray comes in again
    void wrap(glm::vec3 &origin, const glm::vec3 &direction, const glm::vec2 &size) const {
        origin += side * direction;
        origin[crossed] = direction[crossed] > 0 ? 0 : size[crossed];
    }
};

FilamentScene::Leg FilamentScene::leg(glm::vec3 &origin, const glm::vec3 &direction) const {
    // A point outside of the cell is the same as one inside
    for (int c = 0; c < 2; ++c)
        if (origin[c] < 0 || origin[c] > cell_.size[c])
            origin[c] -= cell_.size[c] * std::floor(origin[c] / cell_.size[c]);
    const float x = to_side(origin.x, direction.x, cell_.size.x);
    const float y = to_side(origin.y, direction.y, cell_.size.y);
    const float height = (direction.z > 0 ? cell_.top : cell_.bottom) - origin.z;
    const float end = direction.z == 0 ? std::numeric_limits<float>::infinity()
                                       : std::max(0.0f, height / direction.z);
    return {std::min(x, y), end, x <= y ? 0 : 1};
}

Fate FilamentScene::trace(glm::vec3 origin, const glm::vec3 &direction, Hit &hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int step = 0; step < kMostSteps; ++step) {
        const Leg part = leg(origin, direction);
        RTCRayHit query;
        query.ray = tsuya::detail::make_ray<RTCRay>(origin, direction, part.length());
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(state_->scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            if (part.leaves())
                return direction.z > 0 ? Fate::above : Fate::below;
            part.wrap(origin, direction, cell_.size);
            continue;
        }
        hit.point = origin + query.ray.tfar * direction;
        hit.on_cone = query.hit.geomID == kCones;
        hit.segment = hit.on_cone ? query.hit.primID : query.hit.primID / cell_.tubes.ring_size;
        hit.system =
            hit.on_cone ? cell_.cones.system[hit.segment] : cell_.tubes.system[hit.segment];
        if (is_smooth(hit.system)) {
            hit.normal = hit.on_cone ? smooth_normal(cell_.cones, hit.segment, hit.point)
                                     : smooth_normal(cell_.tubes, query.hit);
            if (glm::dot(hit.normal, direction) < 0)
                return Fate::hit;
        }
        const glm::vec3 face{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
        if (glm::dot(face, direction) < 0) { // smooth normals turn away at the silhouette
            hit.normal = glm::normalize(face);
            return Fate::hit;
        }
        // From inside: filaments in contact may share a little space
        origin = hit.point + kPastWall * direction;
    }
    return Fate::lost;
}

bool FilamentScene::escapes(glm::vec3 origin, const glm::vec3 &direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int step = 0; step < kMostSteps; ++step) {
        const Leg part = leg(origin, direction);
        RTCRay ray = tsuya::detail::make_ray<RTCRay>(origin, direction, part.length());
        rtcOccluded1(state_->scene, &context, &ray);
        if (ray.tfar < 0)
            return false;
        if (part.leaves())
            return direction.z > 0;
        part.wrap(origin, direction, cell_.size);
    }
    return false;
}

} // namespace tsuya::lab
