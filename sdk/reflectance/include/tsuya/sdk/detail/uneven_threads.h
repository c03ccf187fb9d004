#pragma once
/// \file
/// From metres of cloth to the place in the repeat of its weave, where threads are not all alike.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/irregularity.h"
#include "tsuya/sdk/weave_map.h"

namespace tsuya {

/// Each thread of the cloth has a width of its own, and what lies in its space is stretched over
/// that width. Ends are as wide along all their length; picks have slubs, which take room from the
/// picks beside them. In a long row of threads the widths repeat; no repeat of the weave is like
/// the next in it. What is stretched becomes darker by as much: so the mean over the cloth is that
/// over an even repeat, by the change of variables (x, y) -> (X(x), Y(x, y)).
class UnevenThreads {
  public:
    UnevenThreads() = default;
    /// \param map its size in threads and metres
    UnevenThreads(const WeaveMap &map, const Irregularity &irregularity);

    struct Spot {
        glm::vec2 place; ///< in threads of the repeat, from 0: x of ends, y of picks
        float density;   ///< d place / d cloth, over that of even threads
    };
    /// \param cloth metres along the weft and the warp
    Spot at(const glm::dvec2 &cloth) const;
    /// Size of the part of the cloth after which ends (x) and picks (y) begin again, metres; of
    /// picks without slubs.
    glm::dvec2 period() const;

  private:
    /// The edges of the threads of a row, in mean widths.
    struct Row {
        int repeat = 1; ///< threads in the repeat of the weave
        double spacing = 1;
        std::vector<double> edge{}; ///< that of thread 0 first; empty: all are alike
    };
    struct Thread {
        std::int64_t number; ///< over all of the cloth
        double within;       ///< 0 to 1
        double width;        ///< in mean widths
    };
    static Row make_row(int repeat, double spacing, double thickness, std::uint32_t seed);
    static Thread find(const Row &row, double place);
    Thread among_slubs(const Thread &pick, double x) const;
    double swelling(std::int64_t pick, double x) const;

    Row ends_{}, picks_{};
    double slub_cell_ = 0, slub_length_ = 0, slub_gain_ = 0; ///< metres; 0: no slubs
    std::uint32_t seed_ = 0;
};

} // namespace tsuya
