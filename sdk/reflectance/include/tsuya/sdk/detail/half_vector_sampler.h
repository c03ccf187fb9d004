#pragma once
/// \file
/// Samples one direction for another by the half vector between them, of those that the two can
/// see.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// For models that are a distribution of half vectors times what changes slowly: masking, Fresnel
/// term, what the horizon hides. The square of half vectors is divided into blocks. Which block is
/// taken follows the whole model, from tables for a grid of fixed directions; where in the block,
/// the distribution of half vectors alone. Between the fixed directions of the grid one of the four
/// about is taken by chance, and the density is their mean: exact everywhere. A share of the
/// samples follows the cosine of the sampled direction, as much as the model reflects diffusely.
class HalfVectorSampler {
  public:
    /// Distribution of half vectors at a unit one, up to a factor
    using Facets = std::function<float(const glm::vec3 &half)>;
    /// The model without its diffuse part: f times the cosine of the sampled direction, for two
    /// directions with z > 0
    using Model = std::function<float(const glm::vec3 &fixed, const glm::vec3 &drawn)>;

    HalfVectorSampler() = default;
    /// \param mirrored the model is the same for directions mirrored across the weft or the warp
    /// \param facets, model >= 0, finite; called from several threads
    /// \param even albedo of the diffuse part
    HalfVectorSampler(bool mirrored, const Facets &facets, const Model &model, float even);

    /// \param fixed unit, z > 0
    /// \return unit, also below the horizon; zero where the half vector looks away
    glm::vec3 sample(const glm::vec3 &fixed, const glm::vec3 &u) const;
    /// Density of the sampled direction, 1/sr.
    /// \param half unit half vector of the two directions
    /// \param facing cosine of either direction with it
    /// \param drawn_cosine of the sampled direction with the normal
    float pdf(const glm::vec3 &fixed, const glm::vec3 &half, float facing,
              float drawn_cosine) const;
    std::size_t bytes() const;

  private:
    template <class F, detail::MaybeConst<HalfVectorSampler> T> friend void each_part(F &&f, T &t) {
        auto &[mirrored, columns, blocks, nodes] = t;
        f(mirrored, columns, blocks, nodes);
    }

    static constexpr int kParts = 4; ///< cells along a block

    /// The distribution of half vectors within a block.
    struct Block {
        std::array<float, kParts> row_cdf{};                        ///< up to the end of each row
        std::array<std::array<float, kParts>, kParts> column_cdf{}; ///< [row], the same
        std::array<std::array<float, kParts>, kParts> density{};    ///< of the unit square
        glm::vec2 point(const glm::vec2 &u) const;
    };
    /// What is sampled for one fixed direction of the grid.
    struct Node {
        Distribution2D blocks;
        float even_draws = 1;

        template <class F, detail::MaybeConst<Node> T> friend void each_part(F &&f, T &t) {
            auto &[of_blocks, even] = t;
            f(of_blocks, even);
        }
    };
    struct Corner {
        int index;
        float weight;
    };

    std::array<Corner, 4> corners(const glm::vec3 &fixed) const;
    glm::vec2 sign_of(const glm::vec3 &fixed) const;
    glm::vec3 fixed_direction(int index) const;
    void tabulate_blocks(const Facets &facets);
    Node tabulate(const Model &model, float even, const glm::vec3 &fixed, int probes) const;
    glm::vec3 draw(const Node &node, const glm::vec3 &fixed, const glm::vec3 &u) const;

    bool mirrored_ = true;
    int columns_ = 0;
    std::vector<Block> blocks_{}; ///< [row][column] of the square of half vectors
    std::vector<Node> nodes_{};   ///< [row of fixed directions][azimuth]
};

} // namespace tsuya
