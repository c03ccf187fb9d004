#include "tsuya/garment/frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limit/renew_frames.h"
#include "mesh/stop.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// `v` without its part along the unit vector `n`, made unit; false where nothing is left.
bool into_plane(const glm::dvec3 &v, const glm::dvec3 &n, glm::vec3 &unit) {
    constexpr double kLeast = 1e-6 * 1e-6; // of the squared length
    const glm::dvec3 flat = v - glm::dot(v, n) * n;
    const double length2 = glm::dot(flat, flat);
    if (!(length2 > kLeast * glm::dot(v, v)) || !std::isfinite(length2) || !(length2 > 0.0))
        return false;
    unit = glm::vec3(flat / std::sqrt(length2));
    return true;
}

/// Cosine and sine of the grain of each panel. Throws for a name that no panel has.
std::vector<glm::dvec2> panel_grain(const LimitMesh &mesh, const FrameOptions &options,
                                    const std::string &where) {
    std::vector<double> grain(std::max<std::size_t>(mesh.panel_name.size(), 1),
                              options.default_grain);
    Problems problems;
    for (const auto &[name, angle] : options.grain) {
        bool found = false;
        for (std::size_t p = 0; p < mesh.panel_name.size(); ++p)
            if (mesh.panel_name[p] == name) {
                grain[p] = angle;
                found = true;
            }
        problems.need(found, "no panel is named '" + name + "'", where + ": grain",
                      accepted_names(name, mesh.panel_name));
        problems.need(std::isfinite(angle), "the grain of '" + name + "' is not finite",
                      where + ": grain", "expected radians");
    }
    problems.throw_if_any();
    std::vector<glm::dvec2> turn;
    for (const double angle : grain)
        turn.emplace_back(std::cos(angle), std::sin(angle));
    return turn;
}

/// Warp along the vertical in the tangent plane, of vertices that are not `valid`.
void invent_frames(const LimitMesh &mesh, double angle, const std::vector<bool> &valid, Surface &s,
                   const Progress &progress) {
    s.warp.resize(mesh.position.size());
    s.weft.resize(mesh.position.size());
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        look_at_stop(progress, v);
        if (valid[v])
            continue;
        const glm::dvec3 n(mesh.normal[v]);
        glm::vec3 up(0.0f);
        if (!into_plane({0, 1, 0}, n, up))
            into_plane({0, 0, -1}, n, up); // straight up or down: the back of the garment is "up"
        const glm::dvec3 left = glm::cross(n, glm::dvec3(up));
        const glm::dvec3 warp = std::cos(angle) * glm::dvec3(up) + std::sin(angle) * left;
        s.warp[v] = glm::vec3(warp);
        s.weft[v] = glm::vec3(glm::cross(warp, n));
    }
}

/// Frames from the derivatives; `valid` tells where that was possible.
void frames_from_uv(const LimitMesh &mesh, const std::vector<glm::dvec2> &grain, Surface &s,
                    std::vector<bool> &valid, std::vector<bool> &mirrored_at, FrameReport &report,
                    const Progress &progress) {
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        look_at_stop(progress, v);
        const double c = grain[mesh.panel[v]].x, d = grain[mesh.panel[v]].y;
        const glm::dvec3 n(mesh.normal[v]);
        const glm::dvec3 p_u(mesh.dp_du[v]), p_v(mesh.dp_dv[v]);
        // The yarns' own coordinates are the UV turned by the grain.
        const bool mirrored = glm::dot(glm::cross(p_u, p_v), n) < 0.0;
        glm::dvec3 weft = c * p_u + d * p_v;
        if (mirrored)
            weft = -weft;
        valid[v] = into_plane(c * p_v - d * p_u, n, s.warp[v]) && into_plane(weft, n, s.weft[v]);
        mirrored_at[v] = valid[v] && mirrored;
        report.mirrored += mirrored_at[v];
    }
}

/// Vertices that spread frames to each other: those of one triangle, and those of one place and
/// panel. Compressed rows.
struct Neighbours {
    std::vector<std::size_t> start;
    std::vector<std::uint32_t> vertex;
};

Neighbours make_neighbours(const LimitMesh &mesh) {
    Neighbours n;
    n.start.assign(mesh.position.size() + 1, 0);
    const auto for_each_pair = [&](auto &&visit) {
        for (const glm::uvec3 &t : mesh.triangle)
            for (int c = 0; c < 3; ++c) {
                visit(t[c], t[(c + 1) % 3]);
                visit(t[(c + 1) % 3], t[c]);
            }
        for (std::uint32_t v = 0; v < mesh.place.size(); ++v)
            if (mesh.place[v] != v && mesh.panel[v] == mesh.panel[mesh.place[v]]) {
                visit(v, mesh.place[v]);
                visit(mesh.place[v], v);
            }
    };
    for_each_pair([&](std::uint32_t a, std::uint32_t) { ++n.start[a + 1]; });
    for (std::size_t i = 1; i < n.start.size(); ++i)
        n.start[i] += n.start[i - 1];
    n.vertex.resize(n.start.back());
    std::vector<std::size_t> fill(n.start.begin(), n.start.end() - 1);
    for_each_pair([&](std::uint32_t a, std::uint32_t b) { n.vertex[fill[a]++] = b; });
    return n;
}

/// Spreads frames from valid vertices ring by ring; what is reached from none gets any frame.
void spread_frames(const LimitMesh &mesh, Surface &s, std::vector<bool> &valid) {
    const Neighbours near = make_neighbours(mesh);
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < valid.size(); ++v)
        if (!valid[v])
            open.push_back(v);
    while (!open.empty()) {
        std::vector<std::uint32_t> reached, left;
        for (const std::uint32_t v : open) {
            glm::dvec3 sum(0.0);
            for (std::size_t i = near.start[v]; i < near.start[v + 1]; ++i)
                if (valid[near.vertex[i]])
                    sum += glm::dvec3(s.warp[near.vertex[i]]);
            const glm::dvec3 n(mesh.normal[v]);
            if (into_plane(sum, n, s.warp[v])) {
                s.weft[v] = glm::vec3(glm::cross(glm::dvec3(s.warp[v]), n));
                reached.push_back(v);
            } else {
                left.push_back(v);
            }
        }
        if (reached.empty()) {
            for (const std::uint32_t v : left) {
                const glm::dvec3 n(mesh.normal[v]);
                if (!into_plane({0, 1, 0}, n, s.warp[v]))
                    into_plane({0, 0, -1}, n, s.warp[v]);
                s.weft[v] = glm::vec3(glm::cross(glm::dvec3(s.warp[v]), n));
            }
            return;
        }
        for (const std::uint32_t v : reached)
            valid[v] = true;
        open = std::move(left);
    }
}

// By panel, at least one.
std::vector<bool> plain_panels(const LimitMesh &mesh, const FrameOptions &options) {
    std::vector<bool> plain(std::max<std::size_t>(mesh.panel_name.size(), 1));
    for (std::size_t p = 0; p < mesh.panel_name.size(); ++p)
        plain[p] = options.plain.contains(mesh.panel_name[p]);
    return plain;
}

// Of the area of panels that are not plain.
double degenerate_share(const LimitMesh &mesh, const std::vector<bool> &valid,
                        const std::vector<bool> &plain) {
    double total = 0.0, degenerate = 0.0;
    for (const glm::uvec3 &t : mesh.triangle) {
        if (plain[mesh.panel[t.x]])
            continue;
        const glm::dvec3 a = mesh.position[t.x];
        const double area = glm::length(glm::cross(mesh.position[t.y] - a, mesh.position[t.z] - a));
        total += area;
        if (!valid[t.x] || !valid[t.y] || !valid[t.z])
            degenerate += area;
    }
    return total > 0.0 ? degenerate / total : 0.0;
}

void frames_of_cloth(const LimitMesh &mesh, const FrameOptions &options, Surface &s,
                     FrameReport &report, const std::string &where, const Progress &progress) {
    const std::vector<glm::dvec2> grain = panel_grain(mesh, options, where);
    s.warp.resize(mesh.position.size());
    s.weft.resize(mesh.position.size());
    std::vector<bool> valid(mesh.position.size());
    std::vector<bool> mirrored(mesh.position.size());
    frames_from_uv(mesh, grain, s, valid, mirrored, report, progress);
    look_at_stop(progress);
    const std::vector<bool> plain = plain_panels(mesh, options);
    for (std::size_t v = 0; v < valid.size(); ++v)
        report.repaired += !valid[v] && !plain[mesh.panel[v]];
    if (report.repaired > 0)
        report.repaired_area_share = degenerate_share(mesh, valid, plain);
    if (std::find(valid.begin(), valid.end(), false) != valid.end()) {
        if (report.repaired_area_share > options.max_degenerate_area) {
            if (!options.invented_grain)
                throw Error({std::to_string(100.0 * report.repaired_area_share) +
                                 " % of the area has no usable UV",
                             where,
                             "expected at most " +
                                 std::to_string(100.0 * options.max_degenerate_area) +
                                 " % (--max-degenerate-area, max_degenerate_area), or a stated "
                                 "direction of the warp there (--grain, invented_grain_deg)"});
        }
        if (options.invented_grain)
            invent_frames(mesh, *options.invented_grain, valid, s, progress);
        else
            spread_frames(mesh, s, valid);
    }
    s.uv.resize(mesh.uv.size());
    for (std::size_t v = 0; v < s.uv.size(); ++v) {
        const double c = grain[mesh.panel[v]].x, d = grain[mesh.panel[v]].y;
        const glm::dvec2 t = options.metres_per_uv * glm::dvec2(mesh.uv[v]);
        const double u = c * t.x + d * t.y;
        s.uv[v] = glm::vec2(mirrored[v] ? -u : u, c * t.y - d * t.x);
    }
}

} // namespace

void renew_frames(LimitMesh &mesh, const FrameOptions &options, FrameReport &report,
                  const std::string &where, Surface &surface, const Progress &progress) {
    if (!mesh.uv.empty())
        frames_of_cloth(mesh, options, surface, report, where, progress);
    else if (options.invented_grain)
        invent_frames(mesh, *options.invented_grain, std::vector<bool>(mesh.position.size()),
                      surface, progress);
    surface.position.swap(mesh.position);
    surface.normal.swap(mesh.normal);
}

Surface add_frames(LimitMesh mesh, const FrameOptions &options, FrameReport &report,
                   const std::string &where, const Progress &progress) {
    begin_stage(progress, "garment: frames");
    Surface s;
    renew_frames(mesh, options, report, where, s, progress);
    s.triangle = std::move(mesh.triangle);
    s.panel = std::move(mesh.triangle_panel);
    s.panel_name = std::move(mesh.panel_name);
    return s;
}

} // namespace tsuya::garment
