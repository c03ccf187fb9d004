// [KhrDraco]

#include <cstring>

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include "files/gltf_compression.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

constexpr const char *kExtension = "KHR_draco_mesh_compression";

[[noreturn]] void refuse(const std::string &what, const std::string &where) {
    throw Error({what, where, "expected whole Draco data, or an export without compression"});
}

/// Faces that the head of the data declares: the decoder allocates them before it reads them.
std::uint64_t declared_faces(std::string_view bytes, const std::string &where) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        refuse("the data does not begin as Draco data does", where);
    buffer.set_bitstream_version(
        static_cast<std::uint16_t>(header.version_major << 8 | header.version_minor));
    if (header.flags & METADATA_FLAG_MASK) {
        draco::GeometryMetadata metadata;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
            refuse("the metadata of the Draco data is damaged", where);
    }
    constexpr int kFirstWithVarints =
        0x0202; // older files are of the years before glTF's extension
    if (buffer.bitstream_version() < kFirstWithVarints)
        refuse("the Draco data is of a version before 2.2", where);
    const bool edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    std::uint8_t traversal = 0;
    std::uint32_t vertices = 0, faces = 0;
    const bool good = edgebreaker
                          ? buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer) &&
                                draco::DecodeVarint(&faces, &buffer)
                          : draco::DecodeVarint(&faces, &buffer);
    if (!good)
        refuse("the Draco data is cut short", where);
    return std::max(vertices, faces);
}

std::unique_ptr<draco::Mesh> decode(std::string_view bytes, const std::string &where) {
    if (3 * declared_faces(bytes, where) > kFreeCorners + kCornersPerByte * bytes.size())
        refuse("the Draco data declares more faces than its size allows", where);
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    try {
        auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok())
            refuse("the Draco data is damaged (" + mesh.status().error_msg_string() + ")", where);
        return std::move(mesh).value();
    } catch (const std::bad_alloc &) {
        refuse("the Draco data asks for more memory than there is", where);
    }
}

template <typename T> void append(std::vector<unsigned char> &bytes, T value) {
    const auto *begin = reinterpret_cast<const unsigned char *>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
}

/// Divides integers that the accessor calls normalised, where the data itself does not.
double normalisation(const tinygltf::Accessor &accessor, const draco::PointAttribute &attribute) {
    if (!accessor.normalized || attribute.normalized())
        return 1.0;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535.0;
    default:
        return 1.0;
    }
}

int add_attribute(tinygltf::Model &model, const draco::Mesh &mesh,
                  const draco::PointAttribute &attribute, tinygltf::Accessor accessor,
                  const std::string &where) {
    constexpr int kMostComponents = 4;
    const int components = attribute.num_components();
    if (components < 1 || components > kMostComponents)
        refuse("an attribute has " + std::to_string(components) + " numbers", where);
    const double divisor = normalisation(accessor, attribute);
    std::vector<unsigned char> bytes;
    for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
        float value[kMostComponents] = {};
        if (!attribute.ConvertValue<float>(attribute.mapped_index(p),
                                           static_cast<std::int8_t>(components), value))
            refuse("an attribute cannot be read as numbers", where);
        for (int c = 0; c < components; ++c)
            append(bytes, static_cast<float>(value[c] / divisor));
    }
    accessor.bufferView = add_buffer_view(model, std::move(bytes));
    accessor.byteOffset = 0;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.normalized = false;
    accessor.count = mesh.num_points();
    accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components; // VEC2 is 2, and so on
    accessor.sparse.isSparse = false;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size() - 1);
}

int add_indices(tinygltf::Model &model, const draco::Mesh &mesh) {
    std::vector<unsigned char> bytes;
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
        for (const draco::PointIndex &corner : mesh.face(f))
            append(bytes, static_cast<std::uint32_t>(corner.value()));
    tinygltf::Accessor accessor;
    accessor.bufferView = add_buffer_view(model, std::move(bytes));
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.count = std::size_t{3} * mesh.num_faces();
    accessor.type = TINYGLTF_TYPE_SCALAR;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size() - 1);
}

void decode_primitive(tinygltf::Model &model, tinygltf::Primitive &primitive,
                      const tinygltf::Value &extension, const std::string &where) {
    const tinygltf::Value &view_number = extension.Get("bufferView");
    const tinygltf::Value &attributes = extension.Get("attributes");
    const int v = view_number.IsInt() ? view_number.GetNumberAsInt() : -1;
    if (v < 0 || static_cast<std::size_t>(v) >= model.bufferViews.size() || !attributes.IsObject())
        refuse("the extension names no buffer view or no attributes", where);
    const tinygltf::BufferView &view = model.bufferViews[static_cast<std::size_t>(v)];
    const auto mesh =
        decode(buffer_bytes(model, view.buffer, view.byteOffset, view.byteLength, where), where);
    for (const std::string &key : attributes.Keys()) {
        const auto at = primitive.attributes.find(key);
        const tinygltf::Value &id = attributes.Get(key);
        const draco::PointAttribute *attribute =
            id.IsInt() ? mesh->GetAttributeByUniqueId(
                             static_cast<std::uint32_t>(std::max(0, id.GetNumberAsInt())))
                       : nullptr;
        if (!attribute || at == primitive.attributes.end() || at->second < 0 ||
            static_cast<std::size_t>(at->second) >= model.accessors.size())
            refuse("the Draco data has no attribute for '" + key + "'", where);
        at->second = add_attribute(model, *mesh, *attribute,
                                   model.accessors[static_cast<std::size_t>(at->second)], where);
    }
    primitive.indices = add_indices(model, *mesh);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

} // namespace

void decode_draco(tinygltf::Model &model, const std::string &name) {
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
            tinygltf::Primitive &primitive = model.meshes[m].primitives[p];
            const auto extension = primitive.extensions.find(kExtension);
            if (extension == primitive.extensions.end() || !extension->second.IsObject())
                continue;
            decode_primitive(model, primitive, extension->second,
                             name + ": mesh " + std::to_string(m) + ": primitive " +
                                 std::to_string(p));
        }
}

} // namespace tsuya::garment
