#include <array>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "files/declared_count.h"
#include "files/text_blocks.h"
#include "files/text_cursor.h"
#include "files/words.h"
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
    std::unordered_map<std::string, std::uint32_t> index{{"unnamed", 0}};
    std::uint32_t current = 0;
    bool stated = false; ///< the file has such a line
};

/// A name of each kind.
using PanelKey = std::array<std::uint32_t, kPanelKinds>;

/// An index that names something further down the file, to be checked at its end.
struct ForwardIndex {
    std::uint32_t line, column;
    long long index;
    bool is_uv;
};

/// A UV that is not finite, which no face may use.
struct BadUv {
    std::int32_t uv;
    std::uint32_t line, column;
};

/// `nan`, `-inf`, and what old C libraries write for them: `-1.#IND`.
bool says_not_finite(std::string_view word) {
    const std::optional<double> number = parse_number(word);
    return number ? !std::isfinite(*number) : word.find(".#") != word.npos;
}

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
        check_bad_uvs();
        if (problems_.empty() && mesh_.face_count() == 0)
            problems_.add({"the file has no face", name_, "expected lines such as f 1 2 3"});
        problems_.throw_if_any();
        name_panels();
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
            add_problem(in_quotes(word) + " in a " + what + " is not a finite number", where,
                        "expected a number such as -0.25 or 1e-3");
        return false;
    }

    void parse_position() {
        glm::dvec3 p{0.0};
        bool good = true;
        for (int i = 0; i < 3 && good; ++i)
            good = parse_number(p[i], "vertex");
        if (good && text_.skip_blanks())
            p /= parse_weight();
        mesh_.position.push_back(p);
    }

    /// What follows the three coordinates of a vertex: w, which divides them, or a colour of three
    /// or four numbers. 1 where it is a colour.
    double parse_weight() {
        const std::string where = text_.where();
        std::array<double, 4> number{};
        std::size_t count = 0;
        while (count < number.size() && text_.skip_blanks())
            if (!parse_number(number[count++], "vertex"))
                return 1.0;
        if (count == 2 || text_.skip_blanks())
            add_problem("a vertex has " + (count == 2 ? std::string("5") : "more than 7") +
                            " numbers",
                        where, "expected x y z, x y z w, x y z r g b or x y z r g b a");
        else if (count == 1 && number[0] == 0.0)
            add_problem("the w of a vertex is 0", where, "expected another number, such as 1");
        else if (count == 1)
            return number[0];
        return 1.0;
    }

    void parse_uv() {
        // The second number may be absent (a one-dimensional texture).
        glm::dvec2 t{0.0};
        if (parse_uv_number(t.x) && text_.skip_blanks())
            parse_uv_number(t.y);
        mesh_.uv.push_back(t);
    }

    /// False after a problem, and where the number is not finite.
    bool parse_uv_number(double &value) {
        if (text_.skip_blanks() && text_.number(value))
            return true;
        TextCursor word = text_;
        if (!says_not_finite(word.word()))
            return parse_number(value, "texture coordinate");
        bad_uvs_.push_back({static_cast<std::int32_t>(mesh_.uv.size()), text_.line(),
                            text_.column(text_.position())});
        return false;
    }

    void parse_name(PanelNames &names) {
        text_.skip_blanks();
        std::string name(text_.rest());
        if (name.empty())
            name = "unnamed";
        names.stated = true;
        const auto [it, added] =
            names.index.try_emplace(name, static_cast<std::uint32_t>(names.name.size()));
        if (added)
            names.name.push_back(name);
        names.current = it->second;
        panel_.reset();
    }

    /// The panel of the current names.
    std::uint32_t current_panel() {
        if (!panel_) {
            const PanelKey key{names_[kGroup].current, names_[kObject].current,
                               names_[kMaterial].current};
            const auto [at, added] =
                panel_index_.try_emplace(key, static_cast<std::uint32_t>(panels_.size()));
            if (added)
                panels_.push_back(key);
            panel_ = at->second;
        }
        return *panel_;
    }

    /// Reads one index of the kind whose count so far is given; 0-based, -1 after a problem.
    std::int64_t parse_index(std::size_t count, bool is_uv) {
        const char *place = text_.position();
        const std::uint32_t column = text_.column(place), line = text_.line();
        const char *kind = is_uv ? "texture coordinate" : "vertex";
        long long index = 0;
        if (!text_.index(index)) {
            add_problem(in_quotes(text_.word()) + " in a face is not an index",
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
            add_problem(in_quotes(text_.word()) + " follows an index", where,
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
        mesh_.face_panel.push_back(current_panel());
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

    void check_bad_uvs() {
        if (bad_uvs_.empty())
            return;
        const std::unordered_set<std::int32_t> used(mesh_.corner_uv.begin(), mesh_.corner_uv.end());
        for (const BadUv &bad : bad_uvs_)
            if (used.contains(bad.uv))
                add_problem("a texture coordinate that a face uses is not finite",
                            text_.where(bad.line, bad.column), "expected finite numbers");
    }

    const std::string &name_of(const PanelKey &panel, std::size_t kind) const {
        return names_[kind].name[panel[kind]];
    }

    /// The first kind that tells faces apart, else the first that the file states.
    std::optional<std::size_t> naming_kind() const {
        for (std::size_t k = 0; k < kPanelKinds; ++k)
            for (const PanelKey &panel : panels_)
                if (panel[k] != panels_.front()[k])
                    return k;
        for (std::size_t k = 0; k < kPanelKinds; ++k)
            if (names_[k].stated)
                return k;
        return {};
    }

    /// Panels are called by one kind of names, and where that is not enough by the others, too:
    /// `FRONT/satin`, `FRONT/crepe`.
    void name_panels() {
        const std::optional<std::size_t> kind = naming_kind();
        if (!kind)
            return;
        struct Alike {
            const PanelKey *first;
            std::array<bool, kPanelKinds> differs{};
        };
        std::unordered_map<std::uint32_t, Alike> alike; // by the first name
        for (const PanelKey &panel : panels_) {
            Alike &all = alike.try_emplace(panel[*kind], Alike{&panel}).first->second;
            for (std::size_t k = 0; k < kPanelKinds; ++k)
                all.differs[k] = all.differs[k] || panel[k] != (*all.first)[k];
        }
        std::unordered_map<std::string, int> uses;
        for (const PanelKey &panel : panels_) {
            std::string name = name_of(panel, *kind);
            for (std::size_t k = 0; k < kPanelKinds; ++k)
                if (alike.at(panel[*kind]).differs[k])
                    name += "/" + name_of(panel, k);
            if (const int use = ++uses[name]; use > 1)
                name += "#" + std::to_string(use);
            mesh_.panel_name.push_back(std::move(name));
            const auto stated = [&](std::size_t k) {
                return names_[k].stated ? name_of(panel, k) : std::string();
            };
            mesh_.panel_label.push_back({.object = stated(kObject),
                                         .group = stated(kGroup),
                                         .material = stated(kMaterial)});
        }
    }

    TextCursor text_;
    std::string name_;
    PolygonMesh mesh_;
    std::array<PanelNames, kPanelKinds> names_;
    std::vector<PanelKey> panels_; ///< in the order of their first faces
    std::map<PanelKey, std::uint32_t> panel_index_;
    std::optional<std::uint32_t> panel_; ///< of the current names
    std::vector<ForwardIndex> forward_;
    std::vector<BadUv> bad_uvs_;
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
