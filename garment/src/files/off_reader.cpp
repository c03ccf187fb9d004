#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "files/declared_count.h"
#include "files/words.h"
#include "mesh/stop.h"
#include "tsuya/garment/ply.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/text.h"

namespace tsuya::garment {
namespace {

/// What the first word says about the rows of vertices: `[ST][C][N][4]OFF`.
struct OffKind {
    bool has_uv = false, has_colour = false, has_normal = false, homogeneous = false;
};

OffKind parse_kind(std::string_view word, const std::string &where) {
    OffKind kind;
    std::string_view rest = word;
    const auto take = [&](std::string_view prefix) {
        const bool there = rest.starts_with(prefix);
        rest.remove_prefix(there ? prefix.size() : 0);
        return there;
    };
    kind.has_uv = take("ST");
    kind.has_colour = take("C");
    kind.has_normal = take("N");
    kind.homogeneous = take("4");
    if (rest != "OFF")
        throw Error({word.empty() ? "the file is empty" : in_quotes(word) + " is no kind of OFF",
                     where, "expected OFF, COFF, NOFF, CNOFF or one of these with ST before it"});
    return kind;
}

/// Vertices and faces as they are read, checked at once.
class OffMesh {
  public:
    void add_vertex(const glm::dvec3 &p, double w, const std::string &where) {
        if (!(std::isfinite(p.x + p.y + p.z + w) && w != 0.0))
            throw Error({"a vertex is not finite", where, "expected finite numbers"});
        mesh_.position.push_back(p / w);
    }
    void add_uv(const glm::dvec2 &uv, const std::string &where) {
        if (!std::isfinite(uv.x + uv.y))
            throw Error({"a UV is not finite", where, "expected finite numbers"});
        mesh_.uv.push_back(uv);
    }
    void begin_face(std::uint64_t corners, const std::string &where) const {
        if (corners < 3)
            throw Error(
                {"a face has " + detail::counted(corners, "corner"), where, "expected 3 or more"});
    }
    void add_corner(std::uint64_t vertex, const std::string &where) {
        if (vertex >= mesh_.position.size())
            throw Error({"a face names vertex " + std::to_string(vertex), where,
                         "expected an index below " + std::to_string(mesh_.position.size())});
        mesh_.corner_position.push_back(static_cast<std::uint32_t>(vertex));
        mesh_.corner_uv.push_back(mesh_.uv.empty() ? -1 : static_cast<std::int32_t>(vertex));
    }
    void end_face() {
        mesh_.face_offset.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
        mesh_.face_panel.push_back(0);
    }
    PolygonMesh take(const std::string &name) {
        if (mesh_.face_count() == 0)
            throw Error({"the file has no face", name, "expected polygons"});
        check_indices(mesh_, name);
        share_equal_uvs(mesh_);
        return std::move(mesh_);
    }

  private:
    PolygonMesh mesh_;
};

/// OFF as text: one row a line; `#` begins a comment.
class OffText {
  public:
    OffText(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

    PolygonMesh read(const Progress &progress) {
        std::vector<std::string_view> words = next_words();
        const OffKind kind = parse_kind(words.empty() ? std::string_view() : words[0], where());
        words.erase(words.begin(), words.begin() + (words.empty() ? 0 : 1));
        if (words.empty())
            words = next_words();
        if (words.size() < 2)
            throw Error({"the numbers of vertices and faces are missing", where(),
                         "expected VERTICES FACES EDGES after OFF"});
        const std::uint64_t vertices = parse_count(words[0], where());
        const std::uint64_t faces = parse_count(words[1], where());
        constexpr std::uint64_t kVertexBytes = 6, kFaceBytes = 8; // the shortest lines
        check_count(vertices, kVertexBytes, rest_.size() + 1, where());
        check_count(faces, kFaceBytes, rest_.size() + 1, where());
        for (std::uint64_t v = 0; v < vertices; ++v) {
            look_at_stop(progress, v);
            read_vertex(kind);
        }
        for (std::uint64_t f = 0; f < faces; ++f) {
            look_at_stop(progress, f);
            read_face();
        }
        return mesh_.take(name_);
    }

  private:
    std::string where() const { return name_ + ":" + std::to_string(line_); }

    /// Words of the next line that has any; none at the end of the file.
    std::vector<std::string_view> next_words() {
        std::vector<std::string_view> words;
        while (words.empty() && !rest_.empty()) {
            const std::string_view line = take_line(rest_);
            ++line_;
            words = words_of(line.substr(0, line.find('#')));
        }
        return words;
    }

    std::vector<std::string_view> next_row(std::size_t least, const char *what) {
        std::vector<std::string_view> words = next_words();
        if (words.empty())
            throw Error({std::string("the file ends before its last ") + what, where(),
                         "expected as many as the header declares"});
        if (words.size() < least)
            throw Error({std::string("numbers of a ") + what + " are missing", where(),
                         "expected at least " + std::to_string(least)});
        return words;
    }

    double number(std::string_view word) const {
        if (const std::optional<double> value = parse_number(word))
            return *value;
        throw Error({in_quotes(word) + " is no number", where(), "expected a number"});
    }

    void read_vertex(const OffKind &kind) {
        const std::size_t first = kind.homogeneous ? 4 : 3;
        const auto words =
            next_row(first + (kind.has_normal ? 3 : 0) + (kind.has_uv ? 2 : 0), "vertex");
        mesh_.add_vertex({number(words[0]), number(words[1]), number(words[2])},
                         kind.homogeneous ? number(words[3]) : 1.0, where());
        // A colour has three numbers or four, so the UV is counted from the end.
        if (kind.has_uv)
            mesh_.add_uv({number(words[words.size() - 2]), number(words.back())}, where());
    }

    /// What follows the corners is a colour.
    void read_face() {
        const auto words = next_row(1, "face");
        const std::uint64_t corners = parse_count(words[0], where());
        mesh_.begin_face(corners, where());
        if (corners > words.size() - 1)
            throw Error({"corners of a face are missing", where(),
                         "expected " + std::to_string(corners) + " vertices"});
        for (std::size_t c = 1; c <= corners; ++c)
            mesh_.add_corner(parse_count(words[c], where()), where());
        mesh_.end_face();
    }

    std::string_view rest_;
    std::string name_;
    std::size_t line_ = 0;
    OffMesh mesh_;
};

/// OFF BINARY: counts, then rows, of big-endian 32-bit integers and floats. [GeomviewOff]
class OffBytes {
  public:
    OffBytes(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

    PolygonMesh read(const OffKind &kind, const Progress &progress) {
        const std::uint64_t vertices = count(), faces = count();
        count(); // edges
        const std::uint64_t vertex_numbers = 3u + (kind.homogeneous ? 1u : 0u) +
                                             (kind.has_normal ? 3u : 0u) +
                                             (kind.has_colour ? 4u : 0u) + (kind.has_uv ? 2u : 0u);
        constexpr std::uint64_t kFaceBytes = 20; // three corners, two lengths
        check_count(vertices, 4 * vertex_numbers, rest_.size(), name_);
        check_count(faces, kFaceBytes, rest_.size(), name_);
        for (std::uint64_t v = 0; v < vertices; ++v) {
            look_at_stop(progress, v);
            read_vertex(kind, name_ + ": vertex " + std::to_string(v));
        }
        for (std::uint64_t f = 0; f < faces; ++f) {
            look_at_stop(progress, f);
            read_face(name_ + ": face " + std::to_string(f));
        }
        return mesh_.take(name_);
    }

  private:
    std::uint32_t word() {
        std::uint32_t value = 0;
        if (rest_.size() < sizeof value)
            throw Error({"the file is cut short", name_,
                         "expected as many entries as it declares, in big-endian binary"});
        for (int i = 0; i < 4; ++i)
            value = value << 8 | static_cast<unsigned char>(rest_[static_cast<std::size_t>(i)]);
        rest_.remove_prefix(sizeof value);
        return value;
    }
    std::uint64_t count() { return word(); }
    double number() { return static_cast<double>(std::bit_cast<float>(word())); }

    void read_vertex(const OffKind &kind, const std::string &where) {
        const double x = number(), y = number(), z = number();
        mesh_.add_vertex({x, y, z}, kind.homogeneous ? number() : 1.0, where);
        for (int skipped = (kind.has_normal ? 3 : 0) + (kind.has_colour ? 4 : 0); skipped > 0;
             --skipped)
            number();
        if (kind.has_uv) {
            const double u = number(), v = number();
            mesh_.add_uv({u, v}, where);
        }
    }

    void read_face(const std::string &where) {
        const std::uint64_t corners = count();
        mesh_.begin_face(corners, where);
        check_count(corners, 4, rest_.size(), where);
        for (std::uint64_t c = 0; c < corners; ++c)
            mesh_.add_corner(count(), where);
        mesh_.end_face();
        const std::uint64_t colour = count();
        check_count(colour, 4, rest_.size(), where);
        rest_.remove_prefix(4 * static_cast<std::size_t>(colour));
    }

    std::string_view rest_;
    std::string name_;
    OffMesh mesh_;
};

/// The bytes after a first line that says BINARY; nullopt in a file of text.
std::optional<std::string_view> binary_body(std::string_view bytes, OffKind &kind,
                                            const std::string &name) {
    std::string_view rest = bytes;
    const auto words = words_of(take_line(rest));
    if (words.size() != 2 || words[1] != "BINARY")
        return std::nullopt;
    kind = parse_kind(words[0], name);
    return rest;
}

} // namespace

PolygonMesh parse_off(std::string_view bytes, const std::string &name, const Progress &progress) {
    OffKind kind;
    if (const auto body = binary_body(bytes, kind, name))
        return OffBytes(*body, name).read(kind, progress);
    const std::string text = decode_text(bytes, name);
    return OffText(text, name).read(progress);
}

PolygonMesh read_off(const std::filesystem::path &path, const Progress &progress) {
    return parse_off(read_file(path), path.string(), progress);
}

} // namespace tsuya::garment
