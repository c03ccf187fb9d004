// PLY and OFF through OpenMesh. Its readers allocate what the header declares and read on behind
// the end of a file, so the counts of the header are checked against the file size first, and the
// end of the text throws.

#include <array>
#include <charconv>
#include <mutex>
#include <sstream>
#include <utility>

#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "files/polygon_importer.h"
#include "tsuya/garment/ply.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/text.h"

namespace tsuya::garment {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlanks, end);
    }
    return words;
}

/// Takes the next line off `text`.
std::string_view take_line(std::string_view &text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

std::uint64_t parse_count(std::string_view word, const std::string &where) {
    std::uint64_t count = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || stop != word.data() + word.size())
        throw Error({"'" + std::string(word) + "' is no count", where, "expected a number"});
    return count;
}

void check_count(std::uint64_t count, std::uint64_t bytes_each, std::uint64_t bytes,
                 const std::string &where) {
    if (bytes_each > 0 && count > bytes / bytes_each)
        throw Error({detail::counted(count, "entry is", "entries are") + " declared and " +
                         detail::counted(bytes, "byte is", "bytes are") + " left",
                     where, "expected no more than the file holds"});
}

std::uint64_t ply_type_bytes(std::string_view type, const std::string &where) {
    constexpr std::array<std::pair<std::string_view, std::uint64_t>, 16> kTypes{{{"char", 1},
                                                                                 {"int8", 1},
                                                                                 {"uchar", 1},
                                                                                 {"uint8", 1},
                                                                                 {"short", 2},
                                                                                 {"int16", 2},
                                                                                 {"ushort", 2},
                                                                                 {"uint16", 2},
                                                                                 {"int", 4},
                                                                                 {"int32", 4},
                                                                                 {"uint", 4},
                                                                                 {"uint32", 4},
                                                                                 {"float", 4},
                                                                                 {"float32", 4},
                                                                                 {"double", 8},
                                                                                 {"float64", 8}}};
    for (const auto &[name, bytes] : kTypes)
        if (name == type)
            return bytes;
    throw Error({"'" + std::string(type) + "' is no type of PLY", where, "expected float or int"});
}

/// Holds the counts of the header against the bytes that follow it.
void check_ply(std::string_view text, const std::string &name) {
    struct Element {
        std::uint64_t count, row_bytes;
        std::string where;
    };
    std::vector<Element> elements;
    bool ascii = true, ended = false,
         started = words_of(take_line(text)) == std::vector<std::string_view>{"ply"};
    for (int line = 2; started && !text.empty() && !ended; ++line) {
        const std::string where = name + ":" + std::to_string(line);
        const auto words = words_of(take_line(text));
        if (words.size() > 1 && words[0] == "format")
            ascii = words[1] == "ascii";
        else if (words.size() == 3 && words[0] == "element")
            elements.push_back({parse_count(words[2], where), 0, where});
        else if (words.size() >= 3 && words[0] == "property" && !elements.empty())
            // A number as text takes a digit and a blank; a list at least its length.
            elements.back().row_bytes +=
                ascii ? 2 : ply_type_bytes(words[words[1] == "list" ? 2 : 1], where);
        ended = !words.empty() && words[0] == "end_header";
    }
    if (!ended)
        throw Error({"the header of the PLY file is not whole", name,
                     "expected ply at the start and end_header at its end"});
    for (const Element &e : elements)
        check_count(e.count, std::max<std::uint64_t>(e.row_bytes, 1), text.size() + 1, e.where);
}

/// Holds the counts of the second line against the bytes that follow it.
void check_off(std::string_view text, const std::string &name) {
    std::vector<std::string_view> words;
    std::string_view first;
    while (!text.empty() && words.size() < 2) {
        const std::string_view line = take_line(text);
        for (const std::string_view word : words_of(line.substr(0, line.find('#')))) {
            if (first.empty())
                first = word;
            else
                words.push_back(word);
        }
    }
    if (!first.ends_with("OFF") || words.size() < 2)
        throw Error({"the header of the OFF file is not whole", name,
                     "expected OFF, and the numbers of vertices and faces"});
    if (words[0] == "BINARY")
        throw Error({"binary OFF files are not read", name, "expected text"});
    constexpr std::uint64_t kVertexBytes = 6, kFaceBytes = 8; // the shortest lines
    check_count(parse_count(words[0], name), kVertexBytes, text.size() + 1, name);
    check_count(parse_count(words[1], name), kFaceBytes, text.size() + 1, name);
}

/// Keeps OpenMesh's own messages quiet while it reads.
class Quiet {
  public:
    Quiet() : was_(omerr().is_enabled()) { omerr().disable(); }
    ~Quiet() {
        if (was_)
            omerr().enable();
    }
    Quiet(const Quiet &) = delete;
    Quiet &operator=(const Quiet &) = delete;

  private:
    bool was_;
};

/// Calls a reader of OpenMesh; they are singletons with a state.
template <typename Reader>
PolygonMesh read_with(Reader &reader, std::string_view text, const std::string &name,
                      const Progress &progress) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const Quiet quiet;
    PolygonImporter importer(name, progress);
    std::istringstream in{std::string(text)};
    in.exceptions(std::ios::failbit | std::ios::badbit);
    OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexTexCoord);
    bool good = false;
    try {
        good = reader.read(in, importer, options);
    } catch (const Error &) {
        throw;
    } catch (const Interrupted &) {
        throw;
    } catch (const std::exception &) { // the end of the text, or an allocation
        good = false;
    }
    if (!good)
        throw Error(
            {"the file is cut short or damaged", name, "expected as many entries as it declares"});
    PolygonMesh mesh = importer.take();
    share_equal_uvs(mesh);
    return mesh;
}

} // namespace

PolygonMesh parse_ply(std::string_view text, const std::string &name, const Progress &progress) {
    check_ply(text, name);
    return read_with(OpenMesh::IO::PLYReader(), text, name, progress);
}

PolygonMesh parse_off(std::string_view text, const std::string &name, const Progress &progress) {
    check_off(text, name);
    return read_with(OpenMesh::IO::OFFReader(), text, name, progress);
}

PolygonMesh read_ply(const std::filesystem::path &path, const Progress &progress) {
    return parse_ply(read_file(path), path.string(), progress);
}

PolygonMesh read_off(const std::filesystem::path &path, const Progress &progress) {
    return parse_off(read_text(path), path.string(), progress);
}

} // namespace tsuya::garment
