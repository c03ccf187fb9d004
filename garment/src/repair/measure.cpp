#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/distance.h"
#include "mesh/islands.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::garment {
namespace {

/// Area vector of a face, and the derivatives of position by UV, fitted over the face.
struct FaceMeasure {
    double area = 0.0;
    double uv_area = 0.0;          ///< signed
    glm::dvec3 p_u{0.0}, p_v{0.0}; ///< 0 where the UV has no area
};

FaceMeasure measure_face(const PolygonMesh &mesh, std::size_t f) {
    // Integrals over the boundary give the mean derivatives of a face of any size (Stokes):
    // integral of P_u = contour integral of P dv, of P_v = - contour integral of P du.
    FaceMeasure m;
    const std::uint32_t first = mesh.face_offset[f];
    const glm::dvec3 origin = mesh.position[mesh.corner_position[first]];
    const bool with_uv = has_uv(mesh, f);
    glm::dvec3 area(0.0), p_u(0.0), p_v(0.0);
    for (std::uint32_t c = first; c < mesh.face_offset[f + 1]; ++c) {
        const std::uint32_t n = mesh.next(f, c);
        const glm::dvec3 p = mesh.position[mesh.corner_position[c]] - origin;
        const glm::dvec3 q = mesh.position[mesh.corner_position[n]] - origin;
        area += 0.5 * glm::cross(p, q);
        if (!with_uv)
            continue;
        const glm::dvec2 s = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[c])];
        const glm::dvec2 t = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[n])];
        const glm::dvec2 o = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[first])];
        m.uv_area += 0.5 * ((s.x - o.x) * (t.y - o.y) - (s.y - o.y) * (t.x - o.x));
        p_u += 0.5 * (p + q) * (t.y - s.y);
        p_v -= 0.5 * (p + q) * (t.x - s.x);
    }
    m.area = glm::length(area);
    if (m.uv_area != 0.0) {
        m.p_u = p_u / m.uv_area;
        m.p_v = p_v / m.uv_area;
    }
    return m;
}

/// Percentiles of values weighted by area.
Percentiles percentiles(std::vector<std::pair<double, double>> value_and_area) {
    if (value_and_area.empty())
        return {};
    const auto sum = [](auto first, auto last) {
        return std::accumulate(first, last, 0.0,
                               [](double area, const auto &face) { return area + face.second; });
    };
    const double total = sum(value_and_area.begin(), value_and_area.end());
    // The half that has the share is halved again.
    const auto at = [&](double share) {
        auto first = value_and_area.begin(), last = value_and_area.end();
        for (double wanted = share * total; last - first > 1;) {
            const auto middle = first + (last - first) / 2;
            std::nth_element(first, middle, last);
            const double area = sum(first, middle);
            if (area >= wanted) {
                last = middle;
            } else {
                wanted -= area;
                first = middle;
            }
        }
        return first->first;
    };
    return {at(0.05), at(0.5), at(0.95)};
}

/// True where the UVs of the face enclose an area.
bool has_uv_area(const PolygonMesh &mesh, std::size_t f, const FaceMeasure &m) {
    // UV area over the square of the UV perimeter below which a face has no UV area.
    constexpr double kNoArea = 1e-9;
    const auto uv = [&](std::uint32_t c) {
        return mesh.uv[static_cast<std::size_t>(mesh.corner_uv[c])];
    };
    double perimeter = 0.0;
    for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
        perimeter += glm::distance(uv(c), uv(mesh.next(f, c)));
    return std::abs(m.uv_area) > kNoArea * perimeter * perimeter;
}

/// Adds up what is known of each panel.
class PanelSums {
  public:
    PanelSums(const std::vector<std::string> &names, const std::vector<PanelLabel> &labels)
        : panel_(names.size()) {
        for (std::size_t p = 0; p < panel_.size(); ++p) {
            panel_[p].name = names[p];
            if (p < labels.size())
                panel_[p].label = labels[p];
        }
    }
    void add_face(const PolygonMesh &mesh, std::size_t f, std::size_t p, double area) {
        if (p >= panel_.size())
            return;
        PanelReport &panel = panel_[p];
        if (panel.faces++ == 0)
            panel.lower = panel.upper = mesh.position[mesh.corner_position[mesh.face_offset[f]]];
        panel.area += area;
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
            const glm::dvec3 &v = mesh.position[mesh.corner_position[c]];
            panel.lower = glm::min(panel.lower, v);
            panel.upper = glm::max(panel.upper, v);
        }
    }
    void add_warp(std::size_t panel, const glm::dvec3 &p_v, double area) {
        const double length = glm::length(p_v);
        if (panel >= panel_.size() || !(length > 0.0))
            return;
        panel_[panel].warp += area / length * p_v;
        // Of a line with the vertical: up and down are one.
        const double to_up = angle_between(p_v, {0, 1, 0});
        angle_area_.resize(panel_.size());
        angle_area_[panel] += area;
        panel_[panel].warp_to_vertical += area * std::min(to_up, kPi - to_up);
    }
    std::vector<PanelReport> finish() {
        for (std::size_t p = 0; p < angle_area_.size(); ++p) {
            if (angle_area_[p] > 0.0)
                panel_[p].warp_to_vertical /= angle_area_[p];
            const double length = glm::length(panel_[p].warp);
            panel_[p].warp = length > 0.0 ? panel_[p].warp / length : glm::dvec3(0.0);
        }
        return std::move(panel_);
    }

  private:
    std::vector<PanelReport> panel_;
    std::vector<double> angle_area_;
};

} // namespace

void MeshRepair::measure_file() {
    const PolygonMesh &mesh = mesh_;
    Report &report = report_;
    report.vertices = mesh.position.size();
    report.uvs = mesh.uv.size();
    report.faces = mesh.face_count();
    report.panels = mesh.panel_name.size();
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        ++(mesh.face_size(f) == 3   ? report.triangles
           : mesh.face_size(f) == 4 ? report.quads
                                    : report.ngons);
    report.lower = glm::dvec3(std::numeric_limits<double>::max());
    report.upper = glm::dvec3(std::numeric_limits<double>::lowest());
    for (const std::uint32_t v : mesh.corner_position) {
        report.lower = glm::min(report.lower, mesh.position[v]);
        report.upper = glm::max(report.upper, mesh.position[v]);
    }
}

void MeshRepair::measure_joined() {
    report_.parts = find_parts(mesh_).count;
    report_.openings = measure_loops(mesh_, half_edges());
}

void MeshRepair::measure_uv() {
    const PolygonMesh &mesh = mesh_;
    Report &report = report_;
    const SetNumbers islands = find_islands(mesh, edges());
    std::vector<double> signed_area(islands.count, 0.0), total_area(islands.count, 0.0);
    std::vector<std::pair<double, double>> weft, warp, angle;
    PanelSums panels(mesh.panel_name, mesh.panel_label);
    std::vector<double> face_sign(mesh.face_count(), 0.0);
    const auto is_plain = [&](std::size_t f) {
        return mesh.face_panel[f] < mesh.panel_name.size() &&
               plain_.contains(mesh.panel_name[mesh.face_panel[f]]);
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        look_at_stop(progress_, f);
        const FaceMeasure m = measure_face(mesh, f);
        report.area += m.area;
        panels.add_face(mesh, f, mesh.face_panel[f], m.area);
        if (is_plain(f))
            continue;
        if (!has_uv(mesh, f)) {
            ++report.faces_without_uv;
            report.area_without_uv += m.area;
            keep_place(report.first_place, "faces_without_uv", first_point(f));
            continue;
        }
        if (!has_uv_area(mesh, f, m)) {
            ++report.faces_without_uv_area;
            report.area_without_uv += m.area;
            keep_place(report.first_place, "faces_without_uv_area", first_point(f));
            continue;
        }
        face_sign[f] = m.uv_area > 0.0 ? 1.0 : -1.0;
        signed_area[islands.of[f]] += face_sign[f] * m.area;
        total_area[islands.of[f]] += m.area;
        weft.emplace_back(glm::length(m.p_u), m.area);
        warp.emplace_back(glm::length(m.p_v), m.area);
        angle.emplace_back(angle_between(m.p_u, m.p_v), m.area);
        panels.add_warp(mesh.face_panel[f], m.p_v, m.area);
    }
    for (std::uint32_t i = 0; i < islands.count; ++i) {
        report.uv_islands += total_area[i] > 0.0;
        report.mirrored_islands += signed_area[i] < 0.0;
    }
    for (std::size_t f = 0; f < face_sign.size(); ++f)
        if (face_sign[f] < 0.0) {
            ++report.mirrored_faces;
            keep_place(report.first_place, "mirrored_faces", first_point(f));
        }
    report.metres_per_uv_weft = percentiles(std::move(weft));
    report.metres_per_uv_warp = percentiles(std::move(warp));
    report.warp_weft_angle = percentiles(std::move(angle));
    report.panel = panels.finish();
    for (PanelReport &panel : report.panel)
        if (const auto island = island_of_panel_.find(panel.name); island != island_of_panel_.end())
            panel.label.island = island->second;
}

void MeshRepair::measure_islands() {
    const PolygonMesh &mesh = mesh_;
    if (!lists_islands_ || mesh.panel_name.empty() || mesh.uv.empty())
        return;
    const Panels pieces = panels_of_islands(mesh, find_islands(mesh, edges()));
    PanelSums sums(pieces.name, pieces.label);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        look_at_stop(progress_, f);
        const FaceMeasure m = measure_face(mesh, f);
        sums.add_face(mesh, f, pieces.of_face[f], m.area);
        if (m.uv_area != 0.0)
            sums.add_warp(pieces.of_face[f], m.p_v, m.area);
    }
    const std::set<std::string> whole(mesh.panel_name.begin(), mesh.panel_name.end());
    for (PanelReport &island : sums.finish())
        if (whole.contains(island.name)) // the only one of its panel
            island_of_panel_[island.name] = island.label.island;
        else
            report_.island.push_back(std::move(island));
}

} // namespace tsuya::garment
