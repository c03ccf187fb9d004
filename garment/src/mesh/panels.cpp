#include "tsuya/garment/panels.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "mesh/islands.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

// The panel and the island of a face.
using Piece = std::pair<std::uint32_t, std::uint32_t>;

// By the panels that the mesh has, if they are named.
PanelLabel label_of(const PolygonMesh &mesh, std::uint32_t panel, const std::string &island) {
    PanelLabel label;
    if (panel < mesh.panel_label.size())
        label = mesh.panel_label[panel];
    label.island = island;
    return label;
}

// Bytes of the letter that begins here, in UTF-8.
std::size_t letter_size(std::string_view text) {
    std::size_t size = 1;
    while (size < text.size() && (static_cast<unsigned char>(text[size]) & 0xc0u) == 0x80u)
        ++size;
    return size;
}

// `*` stands for any letters, `?` for one. Only the last `*` is ever tried again: what an earlier
// one could take instead, the later one can take too.
bool is_like(std::string_view name, std::string_view pattern) {
    std::size_t n = 0;
    std::size_t p = 0;
    std::size_t star = std::string_view::npos; // in the pattern
    std::size_t taken = 0;                     // where the name goes on after the last `*`
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            taken = n;
        } else if (p < pattern.size() && pattern[p] == '?') {
            n += letter_size(name.substr(n));
            ++p;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++n;
            ++p;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            taken += letter_size(name.substr(taken));
            n = taken;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

// All that a panel can be named by; some may be empty.
std::array<std::string, 5> names_of(const PolygonMesh &mesh, std::uint32_t panel) {
    const PanelLabel label =
        panel < mesh.panel_label.size() ? mesh.panel_label[panel] : PanelLabel{};
    return {mesh.panel_name[panel], label.object, label.group, label.material, label.island};
}

bool matches(const std::string &name, std::string_view pattern) {
    return !name.empty() && (name == pattern || is_like(name, pattern));
}

} // namespace

Panels panels_of_islands(const PolygonMesh &mesh, const SetNumbers &islands) {
    Panels panels{.of_face = std::vector<std::uint32_t>(mesh.face_count())};
    std::map<Piece, std::uint32_t> number;
    std::vector<Piece> pieces;
    std::map<std::uint32_t, std::size_t> islands_of_panel;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const Piece piece{mesh.face_panel[f], islands.of[f]};
        const auto [at, added] =
            number.try_emplace(piece, static_cast<std::uint32_t>(pieces.size()));
        if (added) {
            pieces.push_back(piece);
            ++islands_of_panel[piece.first];
        }
        panels.of_face[f] = at->second;
    }
    for (const auto &[panel, island] : pieces) {
        const std::string name = "island" + std::to_string(island);
        panels.label.push_back(label_of(mesh, panel, name));
        panels.name.push_back(mesh.panel_name.empty()        ? name
                              : islands_of_panel[panel] == 1 ? mesh.panel_name[panel]
                                                             : mesh.panel_name[panel] + "/" + name);
    }
    return panels;
}

void name_islands(PolygonMesh &mesh, const SetNumbers &islands) {
    Panels panels = panels_of_islands(mesh, islands);
    mesh.face_panel = std::move(panels.of_face);
    mesh.panel_name = std::move(panels.name);
    mesh.panel_label = std::move(panels.label);
}

void split_panels_by_island(PolygonMesh &mesh) {
    name_islands(mesh, find_islands(mesh, EdgeTable(mesh)));
}

void split_panels_by_island(MeshFile &file) {
    split_panels_by_island(file.mesh);
    const auto for_islands = [&](const std::string &of, auto &&visit) {
        for (const std::string &panel : file.mesh.panel_name)
            if (panel == of || panel.starts_with(of + "/island"))
                visit(panel);
    };
    std::vector<FabricHint> hints;
    for (const FabricHint &hint : file.hints)
        for_islands(hint.panel, [&](const std::string &panel) {
            hints.push_back(hint);
            hints.back().panel = panel;
        });
    file.hints = std::move(hints);
    for (FileOpacity &opacity : file.opacities) {
        std::vector<std::string> panels;
        for (const std::string &panel : opacity.panels)
            for_islands(panel, [&](const std::string &island) { panels.push_back(island); });
        opacity.panels = std::move(panels);
    }
}

std::vector<std::uint32_t> find_panels(const PolygonMesh &mesh, std::string_view pattern) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t p = 0; p < mesh.panel_name.size(); ++p)
        if (std::ranges::any_of(names_of(mesh, p),
                                [&](const std::string &name) { return matches(name, pattern); }))
            found.push_back(p);
    return found;
}

std::vector<std::uint32_t> panels_named(const PolygonMesh &mesh, std::string_view pattern,
                                        const std::string &where) {
    std::vector<std::uint32_t> found = find_panels(mesh, pattern);
    if (!found.empty())
        return found;
    std::set<std::string> known;
    for (std::uint32_t p = 0; p < mesh.panel_name.size(); ++p)
        for (const std::string &name : names_of(mesh, p))
            if (!name.empty())
                known.insert(name);
    if (known.empty())
        throw Error({"the mesh names no panel", where,
                     "expected a mesh with groups, objects, materials or UVs"});
    const std::vector<std::string> names(known.begin(), known.end());
    throw Error({"no panel is named '" + std::string(pattern) + "'", where,
                 accepted_names(pattern, names)});
}

double uv_area(const PolygonMesh &mesh, std::size_t f) {
    if (!has_uv(mesh, f))
        return 0;
    const auto uv = [&](std::uint32_t c) {
        return mesh.uv[static_cast<std::size_t>(mesh.corner_uv[c])];
    };
    const glm::dvec2 origin = uv(mesh.face_offset[f]);
    double twice = 0;
    for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
        const glm::dvec2 a = uv(c) - origin, b = uv(mesh.next(f, c)) - origin;
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

} // namespace tsuya::garment
