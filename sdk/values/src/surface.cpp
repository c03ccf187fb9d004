#include "tsuya/sdk/surface.h"

#include <cmath>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

bool finite(const glm::dvec3 &v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_unit(const std::vector<glm::vec3> &directions, const Surface &surface, const char *name,
                const std::string &where) {
    if (!directions.empty() && directions.size() != surface.position.size())
        throw Error({std::string(name) + " has " +
                         detail::counted(directions.size(), "entry", "entries") + " for " +
                         detail::counted(surface.position.size(), "vertex", "vertices"),
                     where, "expected one a vertex"});
    for (std::size_t i = 0; i < directions.size(); ++i)
        if (!(std::abs(glm::length(directions[i]) - 1.0f) < 1e-3f))
            throw Error(
                {std::string(name) + " of vertex " + std::to_string(i) + " is not a unit vector",
                 where, "expected length 1"});
}

} // namespace

std::size_t panel_count(const Surface &surface) {
    std::size_t count = std::max<std::size_t>(surface.panel_name.size(), 1);
    for (const std::uint32_t panel : surface.panel)
        count = std::max<std::size_t>(count, panel + std::size_t{1});
    return count;
}

void check_surface(const Surface &s, const std::string &where) {
    if (s.triangle.empty())
        throw Error({"the surface has no triangle", where, "expected at least one"});
    if (s.normal.empty())
        throw Error({"the surface has no normals", where, "expected one a vertex"});
    for (std::size_t i = 0; i < s.position.size(); ++i)
        if (!finite(s.position[i]))
            throw Error({"vertex " + std::to_string(i) + " is not finite", where,
                         "expected coordinates in metres"});
    for (std::size_t i = 0; i < s.triangle.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (s.triangle[i][c] >= s.position.size())
                throw Error({"triangle " + std::to_string(i) + " names vertex " +
                                 std::to_string(s.triangle[i][c]),
                             where,
                             "expected an index below " + std::to_string(s.position.size())});
    check_unit(s.normal, s, "normal", where);
    check_unit(s.warp, s, "warp", where);
    check_unit(s.weft, s, "weft", where);
    if (!s.uv.empty() && s.uv.size() != s.position.size())
        throw Error({"uv has " + detail::counted(s.uv.size(), "entry", "entries"), where,
                     "expected one a vertex"});
    if (!s.panel.empty() && s.panel.size() != s.triangle.size())
        throw Error({"panel has " + detail::counted(s.panel.size(), "entry", "entries"), where,
                     "expected one a triangle"});
}

} // namespace tsuya
