#include "files/gltf_compression.h"

#include <cstring>

#include <nlohmann/json.hpp>

namespace tsuya::garment {
namespace {

using nlohmann::json;

/// Calls `visit` with every entry of an array that is a member of `object`.
template <typename Visit> void visit_entries(json &object, const char *key, Visit &&visit) {
    if (object.is_object() && object.contains(key) && object[key].is_array())
        for (json &entry : object[key])
            visit(entry);
}

bool stands_for_meshopt(const json &buffer) {
    const json::json_pointer flag("/extensions/EXT_meshopt_compression/fallback");
    return buffer.is_object() && !buffer.contains("uri") && buffer.contains(flag) &&
           buffer.at(flag) == true;
}

bool has_draco(const json &primitive) {
    return primitive.is_object() &&
           primitive.contains(json::json_pointer("/extensions/KHR_draco_mesh_compression"));
}

void remove_placeholders(json &document) {
    visit_entries(document, "buffers", [](json &buffer) {
        if (stands_for_meshopt(buffer))
            buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
    });
    visit_entries(document, "meshes", [](json &mesh) {
        visit_entries(mesh, "primitives", [](json &primitive) {
            if (has_draco(primitive))
                primitive.erase("indices");
        });
    });
}

/// Whether any skin had none.
bool add_inverse_bind_matrices(json &document) {
    bool added = false;
    visit_entries(document, "skins", [&](json &skin) {
        if (skin.is_object() && !skin.contains("inverseBindMatrices")) {
            skin["inverseBindMatrices"] = -1;
            added = true;
        }
    });
    return added;
}

void append_number(std::string &out, std::size_t number) {
    const auto n = static_cast<std::uint32_t>(number);
    out.append(reinterpret_cast<const char *>(&n), sizeof n);
}

/// The GLB with another JSON chunk.
std::string with_json(std::string_view glb, std::size_t old_chunk, std::string text) {
    constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string_view rest = glb.substr(kFileHeader + kChunkHeader + old_chunk);
    std::string out(glb.substr(0, 8));
    append_number(out, kFileHeader + kChunkHeader + text.size() + rest.size());
    append_number(out, text.size());
    out += "JSON" + text;
    return out.append(rest);
}

} // namespace

std::optional<std::string> adapted_to_parser(std::string_view bytes) {
    constexpr std::size_t kJsonStart = 20; // of a GLB: file header and chunk header
    const bool glb = bytes.starts_with("glTF") && bytes.size() >= kJsonStart;
    std::uint32_t length = 0;
    if (glb)
        std::memcpy(&length, bytes.data() + 12, sizeof length);
    const std::string_view text = glb ? bytes.substr(kJsonStart, length) : bytes;
    const bool compressed = text.find("EXT_meshopt_compression") != text.npos ||
                            text.find("KHR_draco_mesh_compression") != text.npos;
    if (!compressed && text.find("\"skins\"") == text.npos)
        return std::nullopt;
    json document = json::parse(text, nullptr, false);
    if (!document.is_object())
        return std::nullopt;
    const bool added = add_inverse_bind_matrices(document);
    if (!compressed && !added)
        return std::nullopt;
    remove_placeholders(document);
    std::string changed = document.dump(-1, ' ', false, json::error_handler_t::replace);
    return glb ? with_json(bytes, length, std::move(changed)) : changed;
}

} // namespace tsuya::garment
