#pragma once
/// \file
/// How the positions of a repaired mesh follow from those of its file, for further frames of the
/// same topology.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// Steps that were done to a list of positions, to be done to others. What is recorded is done to
/// the list at once, so that a first frame and its repetition are bit-identical.
class PositionRecipe {
  public:
    /// Puts `vertex` at the mean of `members`.
    void mean(std::vector<glm::dvec3> &positions, std::uint32_t vertex,
              std::vector<std::uint32_t> members);
    /// Appends the middle of two vertices; of a vertex and itself: a copy.
    void append_middle(std::vector<glm::dvec3> &positions, std::uint32_t a, std::uint32_t b);
    /// Keeps only these vertices, in this order.
    void keep(std::vector<glm::dvec3> &positions, std::vector<std::uint32_t> kept);

    /// Does all steps. \param positions as many as the first list had
    std::vector<glm::dvec3> apply(std::vector<glm::dvec3> positions) const;

  private:
    enum class Kind : std::uint8_t { mean, middle, keep };
    struct Step {
        Kind kind;
        std::uint32_t vertex;
        std::vector<std::uint32_t> from;
    };
    void add(std::vector<glm::dvec3> &positions, Step step);
    static void run(std::vector<glm::dvec3> &positions, const Step &step);

    std::vector<Step> steps_;
};

} // namespace tsuya::garment
