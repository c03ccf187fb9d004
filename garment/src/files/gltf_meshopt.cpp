// [ExtMeshopt]

#include <meshoptimizer.h>

#include "files/gltf_compression.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

constexpr const char *kExtension = "EXT_meshopt_compression";

[[noreturn]] void refuse(const std::string &what, const std::string &where) {
    throw Error({what, where, "expected whole meshopt data, or an export without compression"});
}

/// The extension's object of one buffer view.
struct Packed {
    std::size_t offset = 0, bytes = 0, stride = 0, count = 0;
    int buffer = -1;
    std::string mode, filter;
};

Packed read_packed(const tinygltf::Value &object, const std::string &where) {
    const auto number = [&](const char *key, bool needed) -> std::size_t {
        const tinygltf::Value &value = object.Get(key);
        const double n = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
        constexpr double kMost = 4294967295.0;
        if (!value.IsNumber() && !needed)
            return 0;
        if (!(n >= 0.0 && n <= kMost))
            refuse(std::string("'") + key + "' of the extension is no count", where);
        return static_cast<std::size_t>(n);
    };
    const auto word = [&](const char *key, const char *otherwise) {
        const tinygltf::Value &value = object.Get(key);
        return value.IsString() ? value.Get<std::string>() : std::string(otherwise);
    };
    return {.offset = number("byteOffset", false),
            .bytes = number("byteLength", true),
            .stride = number("byteStride", true),
            .count = number("count", true),
            .buffer = static_cast<int>(std::min<std::size_t>(number("buffer", true), 1u << 30)),
            .mode = word("mode", ""),
            .filter = word("filter", "NONE")};
}

/// What the decoders take for granted.
void check_packed(const Packed &packed, const std::string &where) {
    const bool attributes = packed.mode == "ATTRIBUTES";
    const bool triangles = packed.mode == "TRIANGLES", indices = packed.mode == "INDICES";
    const bool good_stride =
        attributes ? packed.stride > 0 && packed.stride <= 256 && packed.stride % 4 == 0
                   : packed.stride == 2 || packed.stride == 4;
    if (!attributes && !triangles && !indices)
        refuse("'" + packed.mode + "' is no mode of the extension", where);
    if (!good_stride || packed.count == 0 || (triangles && packed.count % 3 != 0))
        refuse("count or byteStride do not fit the mode", where);
    // 16 bytes take two bits at least.
    if (packed.count * packed.stride > kFreeCorners + kCornersPerByte * packed.bytes)
        refuse("the data declares more entries than its size allows", where);
}

void undo_filter(const Packed &packed, std::vector<unsigned char> &bytes,
                 const std::string &where) {
    const bool octahedral =
        packed.filter == "OCTAHEDRAL" && (packed.stride == 4 || packed.stride == 8);
    const bool quaternion = packed.filter == "QUATERNION" && packed.stride == 8;
    if (octahedral)
        meshopt_decodeFilterOct(bytes.data(), packed.count, packed.stride);
    else if (quaternion)
        meshopt_decodeFilterQuat(bytes.data(), packed.count, packed.stride);
    else if (packed.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(bytes.data(), packed.count, packed.stride);
    else if (packed.filter != "NONE")
        refuse("the filter '" + packed.filter + "' does not fit byteStride", where);
}

std::vector<unsigned char> unpack(const tinygltf::Model &model, const Packed &packed,
                                  const std::string &where) {
    check_packed(packed, where);
    const std::string_view source =
        buffer_bytes(model, packed.buffer, packed.offset, packed.bytes, where);
    const auto *data = reinterpret_cast<const unsigned char *>(source.data());
    std::vector<unsigned char> bytes(packed.count * packed.stride);
    const int result = packed.mode == "ATTRIBUTES"
                           ? meshopt_decodeVertexBuffer(bytes.data(), packed.count, packed.stride,
                                                        data, source.size())
                       : packed.mode == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(bytes.data(), packed.count, packed.stride,
                                                       data, source.size())
                           : meshopt_decodeIndexSequence(bytes.data(), packed.count, packed.stride,
                                                         data, source.size());
    if (result != 0)
        refuse("the meshopt data is damaged", where);
    undo_filter(packed, bytes, where);
    return bytes;
}

} // namespace

void decode_meshopt(tinygltf::Model &model, const std::string &name) {
    for (std::size_t v = 0; v < model.bufferViews.size(); ++v) {
        const auto extension = model.bufferViews[v].extensions.find(kExtension);
        if (extension == model.bufferViews[v].extensions.end() || !extension->second.IsObject())
            continue;
        const std::string where = name + ": buffer view " + std::to_string(v);
        tinygltf::BufferView &view = model.bufferViews[v];
        const Packed packed = read_packed(extension->second, where);
        if (packed.count * packed.stride != view.byteLength)
            refuse("count and byteStride do not fit the length of the buffer view", where);
        std::vector<unsigned char> bytes = unpack(model, packed, where);
        view.extensions.clear();
        view.byteOffset = 0;
        view.byteLength = bytes.size();
        view.buffer = static_cast<int>(model.buffers.size());
        model.buffers.emplace_back().data = std::move(bytes);
    }
}

} // namespace tsuya::garment
