#include "tsuya/garment/position_recipe.h"

#include <utility>

namespace tsuya::garment {

void PositionRecipe::mean(std::vector<glm::dvec3> &positions, std::uint32_t vertex,
                          std::vector<std::uint32_t> members) {
    add(positions, {Kind::mean, vertex, std::move(members)});
}

void PositionRecipe::append_middle(std::vector<glm::dvec3> &positions, std::uint32_t a,
                                   std::uint32_t b) {
    add(positions, {Kind::middle, a, {b}});
}

void PositionRecipe::keep(std::vector<glm::dvec3> &positions, std::vector<std::uint32_t> kept) {
    add(positions, {Kind::keep, 0, std::move(kept)});
}

std::vector<glm::dvec3> PositionRecipe::apply(std::vector<glm::dvec3> positions) const {
    for (const Step &step : steps_)
        run(positions, step);
    return positions;
}

void PositionRecipe::add(std::vector<glm::dvec3> &positions, Step step) {
    run(positions, step);
    steps_.push_back(std::move(step));
}

void PositionRecipe::run(std::vector<glm::dvec3> &positions, const Step &step) {
    const auto at = [&](std::uint32_t v) { return positions[v]; };
    if (step.kind == Kind::mean) {
        glm::dvec3 sum(0.0); // of what is small, so that nothing is lost far from the origin
        for (const std::uint32_t m : step.from)
            sum += at(m) - at(step.vertex);
        positions[step.vertex] += sum / static_cast<double>(step.from.size());
    } else if (step.kind == Kind::middle) {
        positions.push_back(at(step.vertex) + 0.5 * (at(step.from[0]) - at(step.vertex)));
    } else {
        std::vector<glm::dvec3> kept;
        kept.reserve(step.from.size());
        for (const std::uint32_t v : step.from)
            kept.push_back(at(v));
        positions = std::move(kept);
    }
}

} // namespace tsuya::garment
