#pragma once
/// \file
/// Meshes of known properties, made for tests.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment::test {

/// A grid of quads; `at(i, j)` gives positions, UV is `uv_origin` + (i, j) * `uv_step`. `wrap_i`
/// and `wrap_j` close it, with UVs that stay apart along the closing edges.
template <typename At>
PolygonMesh grid(int n_i, int n_j, bool wrap_i, bool wrap_j, glm::dvec2 uv_step, At &&at,
                 glm::dvec2 uv_origin = glm::dvec2(0.0)) {
    PolygonMesh mesh;
    const int v_i = wrap_i ? n_i : n_i + 1, v_j = wrap_j ? n_j : n_j + 1;
    for (int j = 0; j < v_j; ++j)
        for (int i = 0; i < v_i; ++i)
            mesh.position.push_back(at(i, j));
    for (int j = 0; j <= n_j; ++j)
        for (int i = 0; i <= n_i; ++i)
            mesh.uv.push_back(uv_origin + uv_step * glm::dvec2(i, j));
    for (int j = 0; j < n_j; ++j)
        for (int i = 0; i < n_i; ++i) {
            std::vector<std::uint32_t> v;
            std::vector<std::int32_t> t;
            for (const auto &[a, b] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                v.push_back(static_cast<std::uint32_t>((b % v_j) * v_i + a % v_i));
                t.push_back(b * (n_i + 1) + a);
            }
            mesh.add_face(v, t, 0);
        }
    return mesh;
}

/// A flat panel in the plane z = 0 with UV in metres, its lower left corner at `corner`.
inline PolygonMesh panel(int n_x, int n_y, double step, glm::dvec3 corner = glm::dvec3(0.0)) {
    return grid(n_x, n_y, false, false, glm::dvec2(step),
                [&](int i, int j) { return corner + step * glm::dvec3(i, j, 0); });
}

/// Both meshes side by side; panels are renumbered and named `panel0`, `panel1`, ...
inline PolygonMesh both(const PolygonMesh &a, const PolygonMesh &b) {
    PolygonMesh mesh = a;
    std::uint32_t panels = 0;
    for (const std::uint32_t p : a.face_panel)
        panels = std::max(panels, p + 1);
    mesh.position.insert(mesh.position.end(), b.position.begin(), b.position.end());
    mesh.uv.insert(mesh.uv.end(), b.uv.begin(), b.uv.end());
    std::uint32_t last = panels;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        std::vector<std::uint32_t> v;
        std::vector<std::int32_t> t;
        for (std::uint32_t c = b.face_offset[f]; c < b.face_offset[f + 1]; ++c) {
            v.push_back(b.corner_position[c] + static_cast<std::uint32_t>(a.position.size()));
            t.push_back(
                b.corner_uv[c] < 0 ? -1 : b.corner_uv[c] + static_cast<std::int32_t>(a.uv.size()));
        }
        const auto p = panels + b.face_panel[f];
        last = std::max(last, p);
        mesh.add_face(v, t, p);
    }
    mesh.panel_name.clear();
    for (std::uint32_t p = 0; p <= last; ++p)
        mesh.panel_name.push_back("panel" + std::to_string(p));
    return mesh;
}

/// Every quad cut into two triangles.
inline PolygonMesh triangulated(const PolygonMesh &mesh) {
    PolygonMesh out;
    out.position = mesh.position;
    out.uv = mesh.uv;
    out.panel_name = mesh.panel_name;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t c = mesh.face_offset[f];
        for (std::uint32_t k = 1; k + 1 < mesh.face_size(f); ++k)
            out.add_face({mesh.corner_position[c], mesh.corner_position[c + k],
                          mesh.corner_position[c + k + 1]},
                         {mesh.corner_uv[c], mesh.corner_uv[c + k], mesh.corner_uv[c + k + 1]},
                         mesh.face_panel[f]);
    }
    return out;
}

/// A closed cube of unit size about the origin, without UV.
inline PolygonMesh cube() {
    PolygonMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.position.emplace_back((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    for (const auto &f : {std::vector<std::uint32_t>{0, 2, 3, 1},
                          {4, 5, 7, 6},
                          {0, 1, 5, 4},
                          {2, 6, 7, 3},
                          {0, 4, 6, 2},
                          {1, 3, 7, 5}})
        mesh.add_face(f, {-1, -1, -1, -1}, 0);
    return mesh;
}

/// A cube with one corner cut off: a triangle, pentagons and quads.
inline PolygonMesh cut_cube() {
    PolygonMesh m = cube();
    const auto corner = static_cast<std::uint32_t>(7);
    PolygonMesh out;
    out.position = m.position;
    out.position[corner] = {0.1, 0.5, 0.5};
    const std::uint32_t y = 8, z = 9;
    out.position.emplace_back(0.5, 0.1, 0.5);
    out.position.emplace_back(0.5, 0.5, 0.1);
    out.add_face({0, 2, 3, 1}, {-1, -1, -1, -1}, 0);
    out.add_face({4, 5, y, 7, 6}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({0, 1, 5, 4}, {-1, -1, -1, -1}, 0);
    out.add_face({2, 6, 7, z, 3}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({0, 4, 6, 2}, {-1, -1, -1, -1}, 0);
    out.add_face({1, 3, z, y, 5}, std::vector<std::int32_t>(5, -1), 0);
    out.add_face({7, y, z}, {-1, -1, -1}, 0);
    return out;
}

/// A torus about z whose tube runs around v: u along the big circle, v along the tube.
struct Torus {
    double big = 1.0, tube = 0.4;
    glm::dvec3 at(double u, double v) const {
        const double ring = big + tube * std::cos(v);
        return {ring * std::cos(u), ring * std::sin(u), tube * std::sin(v)};
    }
    glm::dvec3 d_u(double u, double v) const {
        const double ring = big + tube * std::cos(v);
        return {-ring * std::sin(u), ring * std::cos(u), 0.0};
    }
    glm::dvec3 d_v(double u, double v) const {
        return {-tube * std::sin(v) * std::cos(u), -tube * std::sin(v) * std::sin(u),
                tube * std::cos(v)};
    }
    PolygonMesh mesh(int n) const {
        const double step = 2.0 * std::numbers::pi / n;
        return grid(n, n, true, true, glm::dvec2(step),
                    [&](int i, int j) { return at(step * i, step * j); });
    }
};

/// Every vertex moved by up to `amount` along each axis, the same every time.
inline PolygonMesh shaken(PolygonMesh mesh, double amount) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-amount, amount);
    for (glm::dvec3 &p : mesh.position)
        p += glm::dvec3(shift(random), shift(random), shift(random));
    return mesh;
}

/// Three rings of faces about vertex 0, which joins `n` of them, not flat. `open`: three quarters
/// of a turn, with the vertex on the hem. UV is a smooth function of the place.
inline PolygonMesh fan(int n, bool open, bool triangles) {
    const int across = triangles ? 1 : 2; // steps from spoke to spoke
    const int columns = n * across + (open ? 1 : 0);
    const double turn = (open ? 1.5 : 2.0) * std::numbers::pi / (n * across);
    PolygonMesh mesh;
    mesh.position.emplace_back(0.0);
    for (int ring = 1; ring <= 3; ++ring)
        for (int i = 0; i < columns; ++i) {
            const double r = ring * (i % across == 1 ? 1.2 : 1.0), a = turn * i;
            mesh.position.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
        }
    for (const glm::dvec3 &p : mesh.position)
        mesh.uv.emplace_back(0.9 * p.x + 0.2 * p.y + 0.03 * p.x * p.y, p.y - 0.3 * p.x);
    const auto at = [&](int ring, int i) {
        return ring == 0 ? 0u : static_cast<std::uint32_t>(1 + (ring - 1) * columns + i % columns);
    };
    const auto face = [&](const std::vector<std::uint32_t> &v) {
        mesh.add_face(v, {v.begin(), v.end()}, 0);
    };
    for (int i = 0; i < n * across; i += across) {
        if (triangles)
            face({0, at(1, i), at(1, i + 1)});
        else
            face({0, at(1, i), at(1, i + 1), at(1, i + 2)});
    }
    for (int ring = 1; ring < 3; ++ring)
        for (int i = 0; i < n * across; ++i) {
            const std::uint32_t a = at(ring, i), b = at(ring + 1, i), c = at(ring + 1, i + 1),
                                d = at(ring, i + 1);
            if (triangles) {
                face({a, b, c});
                face({a, c, d});
            } else {
                face({a, b, c, d});
            }
        }
    return shaken(mesh, 0.1);
}

/// From a point to the nearest of a triangle.
inline double distance_to_triangle(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b,
                                   const glm::dvec3 &c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    double nearest = 1e300;
    bool inside = true;
    for (const auto &[from, to] : {std::pair(a, b), {b, c}, {c, a}}) {
        inside &= glm::dot(glm::cross(to - from, p - from), n) >= 0.0;
        const glm::dvec3 edge = to - from;
        const double t = std::clamp(glm::dot(p - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, from + t * edge));
    }
    return inside ? std::abs(glm::dot(p - a, n)) / glm::length(n) : nearest;
}

/// The folder of data from elsewhere, where the environment names it.
inline std::optional<std::filesystem::path> outside_data() {
    const char *folder = std::getenv("TSUYA_TEST_DATA");
    if (!folder || !*folder)
        return std::nullopt;
    return std::filesystem::path(folder);
}

/// Keys of all findings.
inline std::set<std::string> keys(const Report &report) {
    std::set<std::string> result;
    for (const Finding &f : report.findings)
        result.insert(f.key);
    return result;
}

} // namespace tsuya::garment::test
