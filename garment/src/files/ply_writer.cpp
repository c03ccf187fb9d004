#include <bit>
#include <cstring>

#include "files/block_writer.h"
#include "tsuya/garment/ply.h"

namespace tsuya::garment {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says little endian");

template <typename T> void append(std::string &bytes, const T &value) {
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

std::string header(const Surface &s) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by tsuya; metres\n";
    for (std::size_t p = 0; p < s.panel_name.size(); ++p)
        text += "comment panel " + std::to_string(p) + " " + one_line(s.panel_name[p]) + "\n";
    text += "element vertex " + std::to_string(s.position.size()) + "\n";
    const auto properties = [&](const char *type, std::initializer_list<const char *> names) {
        for (const char *name : names)
            text += std::string("property ") + type + " " + name + "\n";
    };
    properties("double", {"x", "y", "z"});
    if (!s.normal.empty())
        properties("float", {"nx", "ny", "nz"});
    if (!s.uv.empty())
        properties("float", {"u", "v"});
    if (!s.warp.empty())
        properties("float", {"warp_x", "warp_y", "warp_z"});
    if (!s.weft.empty())
        properties("float", {"weft_x", "weft_y", "weft_z"});
    text += "element face " + std::to_string(s.triangle.size()) +
            "\nproperty list uchar int vertex_indices\n";
    if (!s.panel.empty())
        properties("uint", {"panel"});
    return text + "end_header\n";
}

} // namespace

void write_ply(const std::filesystem::path &path, const Surface &surface,
               const Progress &progress) {
    check_surface(surface, path.string());
    begin_stage(progress, "garment: write");
    BlockWriter out(path, progress);
    std::string &bytes = out.bytes();
    bytes = header(surface);
    for (std::size_t v = 0; v < surface.position.size(); ++v) {
        append(bytes, surface.position[v]);
        if (!surface.normal.empty())
            append(bytes, surface.normal[v]);
        if (!surface.uv.empty())
            append(bytes, surface.uv[v]);
        if (!surface.warp.empty())
            append(bytes, surface.warp[v]);
        if (!surface.weft.empty())
            append(bytes, surface.weft[v]);
        out.end_entry();
    }
    for (std::size_t i = 0; i < surface.triangle.size(); ++i) {
        append(bytes, std::uint8_t{3});
        for (int c = 0; c < 3; ++c)
            append(bytes, static_cast<std::int32_t>(surface.triangle[i][c]));
        if (!surface.panel.empty())
            append(bytes, surface.panel[i]);
        out.end_entry();
    }
    out.commit();
}

} // namespace tsuya::garment
