#include "tsuya/garment/animation.h"

#include "load_steps.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

struct AnimatedGarment::State {
    double metres_per_unit;
    std::string where;
    std::size_t vertices;
    LoadSteps steps;
};

AnimatedGarment::AnimatedGarment(const MeshFile &file, const Options &options,
                                 const std::string &where) {
    Options with_hints = options;
    const std::vector<Finding> findings = use_hints(file.hints, with_hints.frames);
    state_ =
        std::make_unique<State>(State{options.metres_per_unit, where, file.mesh.position.size(),
                                      load_steps(file.mesh, with_hints, where, {})});
    LoadedGarment &garment = state_->steps.garment;
    garment.hints = file.hints;
    garment.report.findings.insert(garment.report.findings.end(), findings.begin(), findings.end());
    state_->steps.subdivider.expect_frames();
}

AnimatedGarment::~AnimatedGarment() = default;
AnimatedGarment::AnimatedGarment(AnimatedGarment &&) noexcept = default;
AnimatedGarment &AnimatedGarment::operator=(AnimatedGarment &&) noexcept = default;

const LoadedGarment &AnimatedGarment::first() const { return state_->steps.garment; }

Surface AnimatedGarment::frame(const std::vector<glm::dvec3> &positions) {
    if (positions.size() != state_->vertices)
        throw Error({std::to_string(positions.size()) + " positions for " +
                         std::to_string(state_->vertices) + " vertices",
                     state_->where, "expected the topology of the first frame"});
    std::vector<glm::dvec3> metres = positions;
    for (glm::dvec3 &p : metres)
        p *= state_->metres_per_unit;
    const LimitMesh limit =
        state_->steps.subdivider.evaluate(state_->steps.recipe.apply(std::move(metres)));
    FrameReport report;
    return add_frames(limit, state_->steps.frames, report, state_->where);
}

} // namespace tsuya::garment
