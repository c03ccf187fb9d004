#include <array>
#include <limits>
#include <unordered_map>

#include "files/text_blocks.h"
#include "files/text_cursor.h"
#include "mesh/stop.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// What can name a panel, the preferred first.
enum PanelKind { kGroup, kObject, kMaterial, kPanelKinds };

/// Names of one kind and the current one.
struct PanelNames {
    std::vector<std::string> name{"unnamed"};
    std::unordered_map<std::string, std::uint16_t> index{{"unnamed", 0}};
    std::uint16_t current = 0;
    bool stated = false; ///< the file has such a line
};

/// An index that names something further down the file, to be checked at its end.
struct ForwardIndex {
    std::uint32_t line, column;
    long long index;
    bool is_uv;
};

class ObjParser {
  public:
    explicit ObjParser(const std::string &name) : text_({}, name), name_(name) {}

    /// Reads whole logical lines, those after the ones of the last call.
    void parse_lines(std::string_view text) {
        for (text_.continue_in(text); !text_.at_text_end(); text_.next_line())
            if (text_.skip_blanks())
                parse_line();
    }

    /// The mesh, after the last lines.
    PolygonMesh finish() {
        check_forward_indices();
        if (problems_.empty() && mesh_.face_count() == 0)
            problems_.add({"the file has no face", name_, "expected lines such as f 1 2 3"});
        problems_.throw_if_any();
        choose_panels();
        share_equal_uvs(mesh_);
        return std::move(mesh_);
    }

  private:
    void parse_line() {
        const std::string_view keyword = text_.word();
        if (keyword == "v")
            parse_position();
        else if (keyword == "vt")
            parse_uv();
        else if (keyword == "f")
            parse_face();
        else if (keyword == "g")
            parse_name(names_[kGroup]);
        else if (keyword == "o")
            parse_name(names_[kObject]);
        else if (keyword == "usemtl")
            parse_name(names_[kMaterial]);
    }

    void add_problem(std::string what, std::string where, std::string accepted) {
        problems_.add({std::move(what), std::move(where), std::move(accepted)});
        if (problems_.full())
            problems_.throw_if_any();
    }

    bool parse_number(double &value, const char *what) {
        if (text_.skip_blanks() && text_.number(value))
            return true;
        const std::string where = text_.where();
        const std::string word(text_.word());
        if (word.empty())
            add_problem(std::string("a number of the ") + what + " is missing", where,
                        "expected a finite number");
        else
            add_problem("'" + word + "' in a " + what + " is not a finite number", where,
                        "expected a number such as -0.25 or 1e-3");
        return false;
    }

    void parse_position() {
        glm::dvec3 p{0.0};
        for (int i = 0; i < 3; ++i)
            if (!parse_number(p[i], "vertex"))
                break;
        mesh_.position.push_back(p);
    }

    void parse_uv() {
        // The second number may be absent (a one-dimensional texture).
        glm::dvec2 t{0.0};
        if (parse_number(t.x, "texture coordinate") && text_.skip_blanks())
            parse_number(t.y, "texture coordinate");
        mesh_.uv.push_back(t);
    }

    void parse_name(PanelNames &names) {
        text_.skip_blanks();
        std::string name(text_.rest());
        if (name.empty())
            name = "unnamed";
        names.stated = true;
        const auto [it, added] =
            names.index.try_emplace(name, static_cast<std::uint16_t>(names.name.size()));
        if (added) {
            if (names.name.size() > std::numeric_limits<std::uint16_t>::max())
                throw Error({"more than 65535 names of panels", text_.where(), "expected fewer"});
            names.name.push_back(name);
        }
        names.current = it->second;
    }

    /// Reads one index of the kind whose count so far is given; 0-based, -1 after a problem.
    std::int64_t parse_index(std::size_t count, bool is_uv) {
        const char *place = text_.position();
        const std::uint32_t column = text_.column(place), line = text_.line();
        const char *kind = is_uv ? "texture coordinate" : "vertex";
        long long index = 0;
        if (!text_.index(index)) {
            add_problem("'" + std::string(text_.word()) + "' in a face is not an index",
                        text_.where(line, column), "expected v, v/vt, v//vn or v/vt/vn");
            return -1;
        }
        const auto known = static_cast<long long>(count);
        if (index < 0 && -index <= known)
            return known + index;
        if (index <= 0 || index > std::numeric_limits<std::int32_t>::max()) {
            add_problem(
                "index " + std::to_string(index) + " names no " + kind, text_.where(line, column),
                "expected 1 to " + std::to_string(known) + " or -1 to -" + std::to_string(known));
            return -1;
        }
        if (index > known)
            forward_.push_back({line, column, index, is_uv});
        return index - 1;
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`; false after a problem.
    bool parse_corner() {
        const std::int64_t v = parse_index(mesh_.position.size(), false);
        if (v < 0)
            return false;
        std::int64_t t = -1;
        if (text_.take('/') && !text_.at_blank()) {
            if (!text_.take('/')) {
                t = parse_index(mesh_.uv.size(), true);
                if (t < 0)
                    return false;
                if (text_.take('/'))
                    text_.word(); // the normal is not used
            } else {
                text_.word();
            }
        }
        if (!text_.at_blank()) {
            const std::string where = text_.where();
            add_problem("'" + std::string(text_.word()) + "' follows an index", where,
                        "expected v, v/vt, v//vn or v/vt/vn");
            return false;
        }
        mesh_.corner_position.push_back(static_cast<std::uint32_t>(v));
        mesh_.corner_uv.push_back(static_cast<std::int32_t>(t));
        return true;
    }

    void parse_face() {
        const std::size_t first = mesh_.corner_position.size();
        const std::uint32_t line = text_.line();
        const std::uint32_t column = text_.column(text_.position() - 1);
        bool good = true;
        while (good && text_.skip_blanks())
            good = parse_corner();
        const std::size_t corners = mesh_.corner_position.size() - first;
        if (good && corners < 3)
            add_problem("a face has " + detail::counted(corners, "corner"),
                        text_.where(line, column), "expected 3 or more");
        if (!good || corners < 3) {
            mesh_.corner_position.resize(first);
            mesh_.corner_uv.resize(first);
            return;
        }
        mesh_.face_offset.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
        for (int k = 0; k < kPanelKinds; ++k)
            face_name_[k].push_back(names_[k].current);
    }

    void check_forward_indices() {
        for (const ForwardIndex &f : forward_) {
            const std::size_t count = f.is_uv ? mesh_.uv.size() : mesh_.position.size();
            if (static_cast<std::size_t>(f.index) > count)
                add_problem("index " + std::to_string(f.index) + " names no " +
                                (f.is_uv ? "texture coordinate" : "vertex"),
                            text_.where(f.line, f.column),
                            "expected 1 to " + std::to_string(count));
        }
    }

    /// The first kind that tells faces apart, else the first that the file states.
    void choose_panels() {
        int chosen = -1;
        for (int k = kPanelKinds - 1; k >= 0; --k)
            if (names_[k].stated)
                chosen = k;
        for (int k = kPanelKinds - 1; k >= 0; --k)
            for (const std::uint16_t n : face_name_[k])
                if (n != face_name_[k].front()) {
                    chosen = k;
                    break;
                }
        if (chosen < 0) {
            mesh_.face_panel.assign(mesh_.face_count(), 0);
            return;
        }
        // Only names that faces have, in the order of their first faces.
        constexpr std::uint16_t kUnused = std::numeric_limits<std::uint16_t>::max();
        std::vector<std::uint16_t> number(names_[chosen].name.size(), kUnused);
        for (const std::uint16_t n : face_name_[chosen]) {
            if (number[n] == kUnused) {
                number[n] = static_cast<std::uint16_t>(mesh_.panel_name.size());
                mesh_.panel_name.push_back(names_[chosen].name[n]);
            }
            mesh_.face_panel.push_back(number[n]);
        }
    }

    TextCursor text_;
    std::string name_;
    PolygonMesh mesh_;
    std::array<PanelNames, kPanelKinds> names_;
    std::array<std::vector<std::uint16_t>, kPanelKinds> face_name_;
    std::vector<ForwardIndex> forward_;
    Problems problems_;
};

} // namespace

PolygonMesh parse_obj(std::string_view text, const std::string &name) {
    ObjParser parser(name);
    parser.parse_lines(text);
    return parser.finish();
}

PolygonMesh read_obj(const std::filesystem::path &path, const Progress &progress) {
    TextBlocks blocks(path);
    ObjParser parser(path.string());
    for (std::string_view text = blocks.next(); !text.empty(); text = blocks.next()) {
        look_at_stop(progress);
        parser.parse_lines(text);
    }
    return parser.finish();
}

} // namespace tsuya::garment
