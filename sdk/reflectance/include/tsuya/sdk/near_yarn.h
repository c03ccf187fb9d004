#pragma once
/// \file
/// The reflectance of a cloth place by place: what the eye sees where it tells the yarns apart.
///
///     const NearYarn near(lobes, face_of(weave), {});
///     const NearPlace place = near.at({0.1, 0.2}, footprint);
///     const glm::vec2 share = near.surface(place, to_light, to_viewer); // of weft and warp
///
/// YarnBrdf is linear in the surface of filaments at each slope, and all else in it depends on the
/// two directions alone. So what each slope has is divided among the places of a repeat: those
/// where the yarn rises most get the filaments that rise most. Each place reflects as the far field
/// does, times a factor for either system that is the same for light and viewer exchanged, not
/// below 0, and has a mean over the cloth of 1 for every pair of directions: near and far are one
/// cloth. sdk/docs/models/near_yarn.md has the proof.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/uneven_threads.h"
#include "tsuya/sdk/irregularity.h"
#include "tsuya/sdk/weave_map.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// A footprint of as many repeats of a weave, or more, sees the far field alone.
inline constexpr double kFarFromRepeats = 2;

/// A place of the cloth, made ready for pairs of directions.
struct NearPlace {
    /// Slopes, with room for whole vectors
    static constexpr int kSlopes = 56;

    float near = 0; ///< share of the near field in what is seen, 0 to 1: 0 is the far field
    float even = 0; ///< factor of what forgets its direction
    std::uint8_t system = WeavePlace::kGap;
    std::uint8_t along = 0; ///< part of the float
    /// Of the filaments at each slope, over their mean over the cloth: times their share
    std::array<float, kSlopes> weight{};
    float all = 0; ///< their sum
};

/// The near field of yarns.
class NearYarn {
  public:
    /// \param lobes of the far field
    /// \param body_roughness standard deviation of the slopes of light that left the filaments
    /// Throws Error as check_weave_map and check_irregularity, naming "weave".
    NearYarn(const YarnLobes &lobes, double body_roughness, const WeaveMap &map,
             const Irregularity &irregularity);

    /// \param cloth metres along the weft and the warp
    /// \param footprint what is seen as one, metres: all near below half a crossing of yarns, all
    /// far above two repeats of the weave
    NearPlace at(const glm::dvec2 &cloth, float footprint) const;
    /// From this footprint on all is far, metres.
    float far_from() const { return far_from_; }

    /// What the surface of weft (x) and warp (y) reflects there, over the far field. Directions are
    /// unit with z > 0.
    glm::vec2 surface(const NearPlace &place, const glm::vec3 &to_light,
                      const glm::vec3 &to_viewer) const;
    /// The same of coloured light that follows the yarns.
    glm::vec2 body(const NearPlace &place, const glm::vec3 &to_light,
                   const glm::vec3 &to_viewer) const;
    /// The same of what is diffuse.
    float diffuse(const NearPlace &place) const { return 1 + place.near * (place.even - 1); }

    /// Surface of a system's filaments over the part of the face that the system has, weft 0, warp
    /// 1: pi/2 is a full cover. 0 where it is never on the face.
    double crowding(std::size_t axis) const;

  private:
    static constexpr int kSlopes = NearPlace::kSlopes;
    static constexpr int kParts = 32; ///< of a float

    /// A place of the map.
    struct Packed {
        std::uint32_t rank = 0; ///< of its slope among the places of its system
        std::uint8_t sky = 0;   ///< share of the sky that it sees, of 255
        std::uint8_t along = 0; ///< part of the float
        std::uint8_t system = WeavePlace::kGap;
    };
    /// How widely filaments of one slope spread.
    struct Spread {
        float over_variance = 0; ///< log2(e) / 2 over the variance of the sine
        float least = 0;         ///< of filaments at all slopes, over the peak of a lobe
        float reach = 0;         ///< sine at which a lobe ends
    };
    using Slopes = std::array<float, kSlopes>;

    void rank_places(const WeaveMap &map, const Irregularity &irregularity);
    void divide(std::size_t axis);
    Slopes window(std::size_t axis, std::uint32_t rank) const;
    struct Range {
        std::size_t first, end; ///< whole vectors of slopes
    };
    static Range slopes_at(float along, float up, const Spread &spread);
    float plain(std::size_t axis, const NearPlace &place, const Spread &spread,
                const glm::vec3 &half) const;
    float shadowed(std::size_t axis, const NearPlace &place, const glm::vec3 &half, float from,
                   float to) const;
    glm::vec2 of_systems(const NearPlace &place, float factor) const;

    YarnLobes lobes_{};
    UnevenThreads threads_{};
    glm::ivec2 size_{0}, per_thread_{0}; ///< of the map; places for a thread
    std::vector<Packed> place_{};
    float near_to_ = 0, far_from_ = 0;
    Spread surface_{}, body_{};
    double mean_sky_ = 1; ///< of all places, gaps being 0
    Slopes sine_{}, cosine_{};
    /// Of weft and warp.
    struct System {
        std::size_t count = 0;                       ///< places on the face
        std::array<double, kYarnSlopes + 1> up_to{}; ///< the steepest rank of each slope
        Slopes share{};                              ///< of all surface
        Slopes over_sky{};                           ///< 1 / mean sky of what has this slope
        /// Of what has a slope, by sky: how much lies before a part of the float
        std::array<Slopes, kParts + 2> before{};
    };
    std::array<System, 2> system_{};
};

} // namespace tsuya
