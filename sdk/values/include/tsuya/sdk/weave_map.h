#pragma once
/// \file
/// What of a woven cloth lies on its face, place by place over one repeat of the weave. The virtual
/// weave of lab/weave makes it; NearYarn gives each place its reflectance.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// The yarn that is seen from above at one place.
struct WeavePlace {
    static constexpr std::uint8_t kWeft = 0, kWarp = 1;
    static constexpr std::uint8_t kGap = 2; ///< no yarn: a hole between four of them

    std::uint8_t system = kGap;
    std::uint16_t thread = 0; ///< end or pick of the repeat
    /// Of the yarn's path, radians; rising along +x (weft) or +y (warp) is positive
    float slope = 0;
    float along = 0;  ///< place along the float, 0 at its start to 1 at its end
    float across = 0; ///< place across the yarn, -1 to 1
    float height = 0; ///< of the yarn's surface above the middle of the cloth, metres

    bool operator==(const WeavePlace &) const = default;
};

/// One repeat, seen from the face of the cloth: x along the weft, y along the warp. Pick p of a
/// draft lies between p and p + 1 picks' spacings above y = 0, end e alike.
struct WeaveMap {
    glm::dvec2 repeat{0, 0};         ///< metres along x and y
    std::array<int, 2> size{};       ///< places along x and y
    glm::ivec2 threads{0, 0};        ///< ends along x, picks along y
    glm::ivec2 filaments{1, 1};      ///< side by side on the face of a weft and of a warp yarn
    std::vector<WeavePlace> place{}; ///< row by row, each of them along x

    /// Metres between the axes of neighbouring ends (x) and picks (y).
    glm::dvec2 spacing() const { return repeat / glm::dvec2(threads); }
    /// Share of all places that a system has, WeavePlace::kWeft and the others.
    double share(std::uint8_t system) const;
    bool operator==(const WeaveMap &) const = default;
};

/// Throws Error naming `where`: a repeat without area; no places, or not as many as `size` says;
/// a system or a thread that is none; a number that is not finite or out of the range above.
void check_weave_map(const WeaveMap &map, const std::string &where);

} // namespace tsuya
