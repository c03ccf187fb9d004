#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "files/declared_count.h"
#include "files/ply_rows.h"
#include "mesh/stop.h"
#include "tsuya/garment/ply.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/text.h"

namespace tsuya::garment {
namespace {

/// A file in two: the header as text, and what follows it.
struct PlyParts {
    std::string header;
    std::string decoded;   ///< the whole file, where it is text
    std::string_view body; ///< of `decoded`, or of the bytes of the file
};

/// Bytes from `ply` to the word end_header; 0 where there is no whole header.
std::size_t header_bytes(std::string_view bytes) {
    constexpr std::string_view kEnd = "end_header";
    if (!bytes.starts_with("ply"))
        return 0;
    for (std::size_t at = bytes.find(kEnd); at != bytes.npos; at = bytes.find(kEnd, at + 1))
        if (bytes[at - 1] == '\n' || bytes[at - 1] == '\r')
            return at + kEnd.size();
    return 0;
}

/// Bytes from the word end_header to the first row: a line ends as the first one does.
std::size_t line_end_bytes(std::string_view bytes, std::size_t header) {
    const std::size_t first = bytes.find_first_of("\r\n");
    const std::size_t size = bytes.substr(first).starts_with("\r\n") ? 2 : 1;
    return std::min(size, bytes.size() - header);
}

bool says_binary(std::string_view header) { return header.find("format binary") != header.npos; }

PlyParts split_ply(std::string_view bytes, const std::string &name) {
    PlyParts parts;
    std::size_t header = header_bytes(bytes);
    parts.body = bytes;
    if (!says_binary(bytes.substr(0, header))) {
        parts.decoded = decode_text(bytes, name);
        parts.body = parts.decoded;
        header = header_bytes(parts.body);
    }
    if (header == 0)
        throw Error({"the header of the PLY file is not whole", name,
                     "expected ply at the start and end_header at its end"});
    parts.header = decode_text(parts.body.substr(0, header), name);
    parts.body.remove_prefix(header + line_end_bytes(parts.body, header));
    return parts;
}

class PlyReader {
  public:
    PlyReader(const PlyHeader &header, std::string_view body, const std::string &name,
              const Progress &progress)
        : header_(header), name_(name), rows_(body, header, name), progress_(progress) {
        for (const PlyElement &element : header.elements)
            if (element.name == "vertex")
                vertices_ = element.rows;
    }

    PolygonMesh read() {
        for (const PlyElement &element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else
                for (std::size_t row = 0; row < element.rows; ++row)
                    next_row(element, row);
        }
        if (mesh_.face_count() == 0)
            throw Error({"the file has no face", name_, "expected polygons"});
        give_vertex_uvs();
        number_panels();
        check_indices(mesh_, name_);
        share_equal_uvs(mesh_);
        return std::move(mesh_);
    }

  private:
    void next_row(const PlyElement &element, std::size_t row) {
        look_at_stop(progress_, row);
        rows_.read(element, row);
    }

    /// The number of a property that is there once and is no list.
    std::optional<std::size_t> find_number(const PlyElement &element, std::string_view name) const {
        const auto p = element.find(name);
        if (p && element.properties[*p].length)
            throw Error({"the property '" + std::string(name) + "' is a list", element.where,
                         "expected a number"});
        return p;
    }

    void read_vertices(const PlyElement &element) {
        std::array<std::size_t, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found = find_number(element, std::string_view("xyz").substr(i, 1));
            if (!found)
                throw Error({"vertices have no x, y and z", element.where,
                             "expected property float x, y and z"});
            at[i] = *found;
        }
        const std::optional<UvProperties> uv = find_uv(element);
        if (uv)
            first_vertex_uv_ = mesh_.uv.size();
        for (std::size_t row = 0; row < element.rows; ++row) {
            next_row(element, row);
            const glm::dvec3 p(rows_.number(at[0]), rows_.number(at[1]), rows_.number(at[2]));
            if (!std::isfinite(p.x + p.y + p.z))
                throw Error({"a coordinate of a vertex is not finite", rows_.where(),
                             "expected finite numbers"});
            mesh_.position.push_back(p);
            if (uv)
                mesh_.uv.emplace_back(rows_.number(uv->u), rows_.number(uv->v));
        }
    }

    struct UvProperties {
        std::size_t u, v;
    };

    std::optional<UvProperties> find_uv(const PlyElement &element) const {
        constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kNames{
            {{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}};
        for (const auto &[u_name, v_name] : kNames)
            if (const auto u = find_number(element, u_name), v = find_number(element, v_name);
                u && v)
                return UvProperties{*u, *v};
        return std::nullopt;
    }

    void read_faces(const PlyElement &element) {
        auto corners = element.find("vertex_indices");
        if (!corners)
            corners = element.find("vertex_index");
        if (!corners || !element.properties[*corners].length)
            throw Error({"faces have no list of their vertices", element.where,
                         "expected property list uchar int vertex_indices"});
        auto uvs = element.find("texcoord");
        if (uvs && !element.properties[*uvs].length)
            throw Error({"the property 'texcoord' is no list", element.where,
                         "expected property list uchar float texcoord"});
        const auto panel = find_number(element, "panel");
        has_panels_ = panel.has_value();
        for (std::size_t row = 0; row < element.rows; ++row) {
            next_row(element, row);
            add_corners(rows_.list(*corners));
            add_corner_uvs(rows_.list(*corners).size(), uvs ? &rows_.list(*uvs) : nullptr);
            mesh_.face_offset.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
            mesh_.face_panel.push_back(panel ? whole_number(rows_.number(*panel), "panel") : 0);
        }
    }

    /// A number that is a count, as an index.
    std::uint32_t whole_number(double number, const char *kind,
                               double below = std::numeric_limits<std::uint32_t>::max()) const {
        if (number >= 0.0 && number < below && number == std::floor(number))
            return static_cast<std::uint32_t>(number);
        throw Error({std::string("a face names ") + kind + " " + number_text(number), rows_.where(),
                     "expected a whole number from 0 and below " +
                         std::to_string(static_cast<std::uint64_t>(below))});
    }

    void add_corners(const std::vector<double> &vertices) {
        if (vertices.size() < 3)
            throw Error({"a face has " + detail::counted(vertices.size(), "corner"), rows_.where(),
                         "expected 3 or more"});
        for (const double v : vertices)
            mesh_.corner_position.push_back(
                whole_number(v, "vertex", static_cast<double>(vertices_)));
    }

    void add_corner_uvs(std::size_t corners, const std::vector<double> *uvs) {
        if (!uvs || uvs->empty()) {
            mesh_.corner_uv.insert(mesh_.corner_uv.end(), corners, -1);
            return;
        }
        if (uvs->size() != 2 * corners)
            throw Error({"a face of " + detail::counted(corners, "corner") + " has " +
                             detail::counted(uvs->size(), "number") + " in texcoord",
                         rows_.where(), "expected two a corner, or none"});
        for (std::size_t c = 0; c < corners; ++c) {
            const glm::dvec2 uv((*uvs)[2 * c], (*uvs)[2 * c + 1]);
            if (!std::isfinite(uv.x + uv.y))
                throw Error(
                    {"a UV of a face is not finite", rows_.where(), "expected finite numbers"});
            mesh_.corner_uv.push_back(static_cast<std::int32_t>(mesh_.uv.size()));
            mesh_.uv.push_back(uv);
        }
    }

    /// UVs of the vertices, where the face has none of its own. Those that no face uses may be
    /// anything.
    void give_vertex_uvs() {
        if (!first_vertex_uv_)
            return;
        for (std::size_t c = 0; c < mesh_.corner_uv.size(); ++c) {
            const std::uint32_t v = mesh_.corner_position[c];
            const std::size_t uv = *first_vertex_uv_ + v;
            if (mesh_.corner_uv[c] >= 0)
                continue;
            if (!std::isfinite(mesh_.uv[uv].x + mesh_.uv[uv].y))
                throw Error({"the UV of a vertex is not finite",
                             name_ + ": vertex " + std::to_string(v), "expected finite numbers"});
            mesh_.corner_uv[c] = static_cast<std::int32_t>(uv);
        }
        for (glm::dvec2 &uv : mesh_.uv)
            if (!std::isfinite(uv.x + uv.y))
                uv = glm::dvec2(0.0);
    }

    /// Panels that have faces, in the order of their numbers, by the names of the comments.
    void number_panels() {
        std::map<std::uint32_t, std::uint32_t> index;
        for (const std::uint32_t number : mesh_.face_panel)
            index.try_emplace(number, 0);
        if (!has_panels_ || (index.size() == 1 && header_.panel_name.empty())) {
            std::fill(mesh_.face_panel.begin(), mesh_.face_panel.end(), 0u);
            return;
        }
        std::map<std::string, int> uses;
        for (auto &[number, at] : index) {
            at = static_cast<std::uint32_t>(mesh_.panel_name.size());
            const auto stated = header_.panel_name.find(number);
            std::string name = stated != header_.panel_name.end()
                                   ? stated->second
                                   : "panel" + std::to_string(number);
            mesh_.panel_label.push_back({.group = name});
            if (const int use = ++uses[name]; use > 1)
                name += "#" + std::to_string(use);
            mesh_.panel_name.push_back(std::move(name));
        }
        for (std::uint32_t &panel : mesh_.face_panel)
            panel = index.at(panel);
    }

    const PlyHeader &header_;
    std::string name_;
    PlyRows rows_;
    const Progress &progress_;
    std::uint64_t vertices_ = 0;
    std::optional<std::size_t> first_vertex_uv_; ///< in `uv`: one a vertex from there
    bool has_panels_ = false;
    PolygonMesh mesh_;
};

} // namespace

PolygonMesh parse_ply(std::string_view text, const std::string &name, const Progress &progress) {
    const PlyParts parts = split_ply(text, name);
    const PlyHeader header = parse_ply_header(parts.header, name);
    check_ply_counts(header, parts.body.size());
    return PlyReader(header, parts.body, name, progress).read();
}

PolygonMesh read_ply(const std::filesystem::path &path, const Progress &progress) {
    return parse_ply(read_file(path), path.string(), progress);
}

} // namespace tsuya::garment
