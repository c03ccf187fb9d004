#include "tsuya/garment/animation.h"

#include <utility>

#include "limit/renew_frames.h"
#include "load_steps.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

namespace {

std::string counts_of(const PolygonMesh &mesh) {
    return detail::counted(mesh.position.size(), "vertex", "vertices") + ", " +
           detail::counted(mesh.uv.size(), "UV") + " and " +
           detail::counted(mesh.face_count(), "face");
}

void check_same_faces(const PolygonMesh &first, const PolygonMesh &other,
                      const std::string &first_name, const std::string &name) {
    if (other.face_offset == first.face_offset && other.corner_position == first.corner_position &&
        other.corner_uv == first.corner_uv && other.position.size() == first.position.size())
        return;
    const std::string counts = counts_of(other), expected = counts_of(first);
    throw Error({counts == expected ? counts + ", as in the first frame, but joined in another way"
                                    : counts + ", where the first frame has " + expected,
                 name, "expected the faces of " + first_name});
}

} // namespace

GarmentFrames read_frames(const std::filesystem::path &first,
                          const std::vector<std::filesystem::path> &further,
                          bool with_morph_targets, const Progress &progress) {
    GarmentFrames frames{.first = read_mesh(first, progress)};
    if (with_morph_targets)
        frames.further = frames.first.morph_targets;
    for (const std::filesystem::path &file : further) {
        PolygonMesh mesh = read_mesh(file, progress).mesh;
        check_same_faces(frames.first.mesh, mesh, first.string(), file.string());
        frames.further.push_back(std::move(mesh.position));
    }
    return frames;
}

struct AnimatedGarment::State {
    Options options;
    std::string where;
    std::size_t vertices;
    LoadSteps steps;
    LimitMesh limit{}; ///< memory of the last frame
};

AnimatedGarment::AnimatedGarment(const MeshFile &file, const Options &options,
                                 const std::string &where, const Progress &progress) {
    state_ =
        std::make_unique<State>(State{options, where, file.mesh.position.size(),
                                      load_steps(file, options, where, Further::frames, progress)});
    state_->steps.subdivider->expect_frames(progress);
}

AnimatedGarment::~AnimatedGarment() = default;
AnimatedGarment::AnimatedGarment(AnimatedGarment &&) noexcept = default;
AnimatedGarment &AnimatedGarment::operator=(AnimatedGarment &&) noexcept = default;

const LoadedGarment &AnimatedGarment::first() const { return state_->steps.garment; }

Surface AnimatedGarment::frame(const std::vector<glm::dvec3> &positions) {
    const Surface &first = state_->steps.garment.surface;
    Surface surface;
    surface.triangle = first.triangle;
    surface.panel = first.panel;
    surface.panel_name = first.panel_name;
    frame(positions, surface);
    return surface;
}

void AnimatedGarment::frame(const std::vector<glm::dvec3> &positions, Surface &surface) {
    if (positions.size() != state_->vertices)
        throw Error({detail::counted(positions.size(), "position") + " for " +
                         detail::counted(state_->vertices, "vertex", "vertices"),
                     state_->where, "expected the topology of the first frame"});
    std::vector<glm::dvec3> metres = positions;
    for (glm::dvec3 &p : metres)
        p = in_metres(state_->options, p);
    state_->steps.subdivider->evaluate(state_->steps.recipe.apply(std::move(metres)),
                                       state_->limit);
    FrameReport report;
    renew_frames(state_->limit, state_->steps.frames, report, state_->where, surface);
}

} // namespace tsuya::garment
