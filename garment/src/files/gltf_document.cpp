#include <fstream> // tiny_gltf.h needs it

#define TINYGLTF_IMPLEMENTATION
#include "files/gltf_document.h"

#include <cmath>
#include <cstring>

#include "files/gltf_compression.h"
#include "files/gltf_extensions.h"
#include "files/words.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Nesting of brackets beyond which a document is refused; tinygltf walks it recursively.
constexpr int kMaxDepth = 64;

/// What the callbacks of tinygltf may read.
struct Sandbox {
    std::filesystem::path folder;
    std::string refused; ///< the last path that was refused
};

/// tinygltf asks for a file in the folder first; that is the only place.
bool read_buffer_file(std::vector<unsigned char> *out, std::string *error, const std::string &path,
                      void *user) {
    auto &sandbox = *static_cast<Sandbox *>(user);
    if (sandbox.folder.empty() || !lies_inside(path, sandbox.folder)) {
        sandbox.refused = path;
        return false;
    }
    if (!std::filesystem::is_regular_file(path)) {
        *error = "no such file";
        return false;
    }
    const std::string bytes = read_file(path);
    out->assign(bytes.begin(), bytes.end());
    return true;
}

/// Images stay encoded. Those of data URIs are kept; others are where the document says.
bool keep_image(tinygltf::Image *image, int, std::string *, std::string *, int, int,
                const unsigned char *bytes, int size, void *) {
    if (image->bufferView < 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

void check_depth(std::string_view text, const std::string &name) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > kMaxDepth)
            throw Error({"the document is nested too deeply", name,
                         "expected at most " + std::to_string(kMaxDepth) + " levels"});
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
}

bool is_binary(std::string_view bytes) { return bytes.starts_with("glTF"); }

/// The JSON of either form; a GLB holds it in its first chunk.
std::string_view json_text(std::string_view bytes, const std::string &name) {
    constexpr std::size_t kHeader = 20; // file header and chunk header
    if (!is_binary(bytes))
        return bytes;
    std::uint32_t length = 0;
    if (bytes.size() >= kHeader)
        std::memcpy(&length, bytes.data() + 12, sizeof length);
    if (bytes.size() < kHeader || length > bytes.size() - kHeader)
        throw Error({"the file is cut short", name, "expected a whole GLB"});
    return bytes.substr(kHeader, length);
}

/// Of a GLB: that its second chunk is as long as it says, if it has one. tinygltf reads on behind
/// the end of one that is not.
void check_binary_chunk(std::string_view bytes, const std::string &name) {
    constexpr std::size_t kChunkHeader = 8;
    const std::string_view json = json_text(bytes, name);
    const std::string_view rest =
        bytes.substr(static_cast<std::size_t>(json.data() - bytes.data()) + json.size());
    std::uint32_t length = 0;
    if (rest.size() >= kChunkHeader)
        std::memcpy(&length, rest.data(), sizeof length);
    if (!rest.empty() && (rest.size() < kChunkHeader || length > rest.size() - kChunkHeader))
        throw Error({"the file is cut short", name, "expected a whole GLB"});
}

/// A text that may quote the document, such as a data URI of any length: its first line, and of
/// that what one can read.
std::string short_line(const std::string &text) {
    constexpr std::size_t kMost = 200;
    std::string line = text.substr(0, text.find('\n'));
    if (line.size() <= kMost)
        return line;
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80)
        --end; // not within a character
    return line.substr(0, end) + "...";
}

void check_version(const tinygltf::Model &model, const std::string &name) {
    if (!model.asset.version.starts_with("2."))
        throw Error({"the document is of glTF " + in_quotes(model.asset.version), name,
                     "expected glTF 2.0"});
}

/// Bytes of one accessor (or of its sparse part).
struct Bytes {
    const unsigned char *data = nullptr;
    std::size_t stride = 0;
};

[[noreturn]] void refuse(const std::string &what, const std::string &where) {
    throw Error({what, where, "expected what the file holds"});
}

Bytes find_bytes(const tinygltf::Model &model, int view_index, std::size_t offset,
                 std::size_t count, std::size_t row_bytes, const std::string &where) {
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size())
        refuse("buffer view " + std::to_string(view_index) + " does not exist", where);
    const tinygltf::BufferView &view = model.bufferViews[static_cast<std::size_t>(view_index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
        refuse("buffer " + std::to_string(view.buffer) + " does not exist", where);
    const auto &data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        refuse("buffer view " + std::to_string(view_index) + " is longer than its buffer", where);
    const std::size_t stride = view.byteStride ? view.byteStride : row_bytes;
    const bool fits = count > 0 && offset <= view.byteLength &&
                      row_bytes <= view.byteLength - offset &&
                      count - 1 <= (view.byteLength - offset - row_bytes) / stride;
    if (!fits)
        refuse(detail::counted(count, "entry does", "entries do") + " not fit into buffer view " +
                   std::to_string(view_index),
               where);
    return {data.data() + view.byteOffset + offset, stride};
}

template <typename T> double number_at(const unsigned char *at, bool normalized) {
    T value;
    std::memcpy(&value, at, sizeof value);
    if (!normalized || std::is_floating_point_v<T>)
        return static_cast<double>(value);
    // glTF 2.0, 3.11: c / max, signed ones clamped to -1
    return std::max(-1.0, static_cast<double>(value) /
                              static_cast<double>(std::numeric_limits<T>::max()));
}

double component_at(const unsigned char *at, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return number_at<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return number_at<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return number_at<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return number_at<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return number_at<std::uint32_t>(at, normalized);
    default:
        return number_at<float>(at, false);
    }
}

std::size_t component_bytes(int type, const std::string &where) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        refuse("component type " + std::to_string(type) + " is not one of glTF", where);
    }
}

const tinygltf::Accessor &find_accessor(const tinygltf::Model &model, int index,
                                        const std::string &where) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
        refuse("accessor " + std::to_string(index) + " does not exist", where);
    return model.accessors[static_cast<std::size_t>(index)];
}

/// Rows that a sparse accessor replaces.
void apply_sparse(const tinygltf::Model &model, const tinygltf::Accessor &accessor,
                  std::size_t components, std::size_t each, std::vector<double> &out,
                  const std::string &where) {
    const auto &sparse = accessor.sparse;
    if (sparse.count <= 0)
        refuse("a sparse accessor has no entries", where);
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t index_bytes = component_bytes(sparse.indices.componentType, where);
    const Bytes indices =
        find_bytes(model, sparse.indices.bufferView,
                   static_cast<std::size_t>(std::max(0, sparse.indices.byteOffset)), count,
                   index_bytes, where);
    const Bytes values = find_bytes(model, sparse.values.bufferView,
                                    static_cast<std::size_t>(std::max(0, sparse.values.byteOffset)),
                                    count, components * each, where);
    for (std::size_t i = 0; i < count; ++i) {
        const double row =
            component_at(indices.data + i * indices.stride, sparse.indices.componentType, false);
        if (!(row >= 0 && row < static_cast<double>(accessor.count)))
            refuse("a sparse index is out of range", where);
        for (std::size_t c = 0; c < components; ++c)
            out[static_cast<std::size_t>(row) * components + c] =
                component_at(values.data + i * values.stride + c * each, accessor.componentType,
                             accessor.normalized);
    }
}

} // namespace

bool lies_inside(const std::filesystem::path &path, const std::filesystem::path &folder) {
    std::error_code error;
    const auto file = std::filesystem::weakly_canonical(path, error);
    if (error)
        return false;
    const auto root = std::filesystem::weakly_canonical(folder, error);
    if (error)
        return false;
    const auto relative = file.lexically_relative(root);
    return !relative.empty() && *relative.begin() != "..";
}

tinygltf::Model parse_gltf_document(std::string_view bytes, const std::string &name,
                                    const std::filesystem::path &folder) {
    check_depth(json_text(bytes, name), name);
    const std::optional<std::string> changed = adapted_to_parser(bytes);
    if (changed)
        bytes = *changed;
    if (is_binary(bytes))
        check_binary_chunk(bytes, name);
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error({"the file is larger than 4 GiB", name, "expected less"});
    Sandbox sandbox{folder, ""};
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_image, nullptr);
    loader.SetFsCallbacks({[](const std::string &, void *) { return true; },
                           [](const std::string &path, void *) { return path; }, read_buffer_file,
                           nullptr, &sandbox});
    tinygltf::Model model;
    std::string error, warning;
    bool good = false;
    const auto size = static_cast<unsigned int>(bytes.size());
    try {
        good =
            is_binary(bytes)
                ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char *>(bytes.data()),
                                              size, folder.string())
                : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size,
                                             folder.string());
    } catch (const Error &) {
        throw;
    } catch (const std::exception &problem) { // of nlohmann::json or an allocation
        throw Error({std::string("the document is not valid: ") + short_line(problem.what()), name,
                     "expected glTF 2.0"});
    }
    check_version(model, name);
    if (!sandbox.refused.empty())
        throw Error({"'" + short_line(sandbox.refused) + "' lies outside the folder of the file",
                     name, "expected buffers beside the file"});
    if (!good || !error.empty())
        throw Error({error.empty() ? "the document is not valid" : short_line(error), name,
                     "expected glTF 2.0"});
    check_required_extensions(model, name);
    decode_meshopt(model, name);
    decode_draco(model, name);
    return model;
}

std::string_view buffer_bytes(const tinygltf::Model &model, int buffer, std::size_t offset,
                              std::size_t count, const std::string &where) {
    if (buffer < 0 || static_cast<std::size_t>(buffer) >= model.buffers.size())
        refuse("buffer " + std::to_string(buffer) + " does not exist", where);
    const auto &data = model.buffers[static_cast<std::size_t>(buffer)].data;
    if (offset > data.size() || count > data.size() - offset)
        refuse("buffer " + std::to_string(buffer) + " has fewer bytes", where);
    return {reinterpret_cast<const char *>(data.data()) + offset, count};
}

int add_buffer_view(tinygltf::Model &model, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteLength = bytes.size();
    model.buffers.emplace_back().data = std::move(bytes);
    model.bufferViews.push_back(std::move(view));
    return static_cast<int>(model.bufferViews.size() - 1);
}

std::vector<double> read_accessor(const tinygltf::Model &model, int index, int components,
                                  std::size_t rows, const std::string &where) {
    const tinygltf::Accessor &accessor = find_accessor(model, index, where);
    const std::string place = where + ": accessor " + std::to_string(index);
    if (accessor.type < 0 ||
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
        refuse("the entries have not " + std::to_string(components) + " numbers", place);
    if (rows > 0 && accessor.count != rows)
        refuse(detail::counted(accessor.count, "entry", "entries") + " for " +
                   detail::counted(rows, "vertex", "vertices"),
               place);
    const std::size_t each = component_bytes(accessor.componentType, place);
    const auto width = static_cast<std::size_t>(components);
    std::vector<double> out;
    if (accessor.bufferView >= 0) {
        const Bytes bytes = find_bytes(model, accessor.bufferView, accessor.byteOffset,
                                       accessor.count, each * width, place);
        out.reserve(accessor.count * width);
        for (std::size_t i = 0; i < accessor.count; ++i)
            for (std::size_t c = 0; c < width; ++c)
                out.push_back(component_at(bytes.data + i * bytes.stride + c * each,
                                           accessor.componentType, accessor.normalized));
    } else if (rows > 0) {
        out.assign(rows * width, 0.0); // glTF 2.0, 3.6.2.3: without a buffer view, zeros
    } else {
        refuse("it has no buffer view", place);
    }
    if (accessor.sparse.isSparse)
        apply_sparse(model, accessor, width, each, out, place);
    for (const double value : out)
        if (!std::isfinite(value))
            refuse("a number is not finite", place);
    return out;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model &model, int index,
                                        const std::string &where) {
    const std::vector<double> numbers = read_accessor(model, index, 1, 0, where);
    const auto &accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.normalized)
        refuse("indices are no integers", where + ": accessor " + std::to_string(index));
    std::vector<std::uint32_t> out;
    out.reserve(numbers.size());
    for (const double n : numbers) {
        if (n < 0)
            refuse("an index is negative", where + ": accessor " + std::to_string(index));
        out.push_back(static_cast<std::uint32_t>(n));
    }
    return out;
}

} // namespace tsuya::garment
