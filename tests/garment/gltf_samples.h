#pragma once
/// \file
/// glTF files made in memory.

#include <cstring>
#include <string>
#include <vector>

namespace tsuya::garment::test {

/// Bytes of numbers, as a buffer.
template <typename T> std::string bytes_of(const std::vector<T> &numbers) {
    std::string bytes(numbers.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

inline void append_number(std::string &out, std::size_t number) {
    const auto n = static_cast<std::uint32_t>(number);
    out.append(reinterpret_cast<const char *>(&n), sizeof n);
}

/// A GLB of a JSON text and a buffer.
inline std::string glb(std::string json, std::string buffer) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    std::string out = "glTF";
    append_number(out, 2);
    append_number(out, 12 + 8 + json.size() + 8 + buffer.size());
    append_number(out, json.size());
    out += "JSON" + json;
    append_number(out, buffer.size());
    return out + std::string("BIN\0", 4) + buffer;
}

/// A square of 1 m in the plane z = 0 whose glTF UVs are (x, 1 - y): not mirrored. Positions, UVs,
/// tangents along +x, then indices: accessors 0 to 3.
inline std::string square_buffer() {
    return bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
           bytes_of<float>({0, 1, 1, 1, 1, 0, 0, 0}) +
           bytes_of<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}) +
           bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3});
}

/// The JSON of that square. \param node of the one node, beside its mesh \param material of the one
/// material \param attributes beside POSITION and TEXCOORD_0 \param count declared number of
/// vertices
inline std::string square_json(const std::string &node = "", const std::string &material = "",
                               const std::string &attributes = "", const std::string &count = "4") {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
           node +
           R"(}],"meshes":[{"name":"square","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1)" +
           attributes + R"(},"indices":3,"material":0}]}],"materials":[{"name":"silk")" + material +
           R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + count +
           R"(,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
           R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"},)"
           R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)"
           R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
           R"({"buffer":0,"byteOffset":80,"byteLength":64},{"buffer":0,"byteOffset":144,"byteLength":12}],)"
           R"("buffers":[{"byteLength":156}]})";
}

} // namespace tsuya::garment::test
