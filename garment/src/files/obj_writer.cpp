#include <charconv>

#include "tsuya/garment/obj.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Appends numbers in the shortest form that reads back exactly.
template <typename Number> void append(std::string &text, Number value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    text.append(buffer, result.ptr);
}

template <int N, typename T>
void append_line(std::string &text, const char *keyword, const glm::vec<N, T> &v) {
    text += keyword;
    for (int i = 0; i < N; ++i) {
        text += ' ';
        append(text, v[i]);
    }
    text += '\n';
}

void append_triangle(std::string &text, const Surface &s, const glm::uvec3 &triangle) {
    text += 'f';
    for (int c = 0; c < 3; ++c) {
        text += ' ';
        append(text, triangle[c] + 1);
        if (s.uv.empty() && s.normal.empty())
            continue;
        text += '/';
        if (!s.uv.empty())
            append(text, triangle[c] + 1);
        if (!s.normal.empty()) {
            text += '/';
            append(text, triangle[c] + 1);
        }
    }
    text += '\n';
}

std::string obj_text(const Surface &s) {
    std::string text = "# written by tsuya; metres\n";
    for (const glm::dvec3 &p : s.position)
        append_line(text, "v", p);
    for (const glm::vec2 &t : s.uv)
        append_line(text, "vt", t);
    for (const glm::vec3 &n : s.normal)
        append_line(text, "vn", n);
    for (std::size_t i = 0; i < s.triangle.size(); ++i) {
        const bool named = !s.panel.empty() && s.panel[i] < s.panel_name.size();
        if (named && (i == 0 || s.panel[i] != s.panel[i - 1]))
            text += "g " + s.panel_name[s.panel[i]] + "\n";
        append_triangle(text, s, s.triangle[i]);
    }
    return text;
}

} // namespace

void write_obj(const std::filesystem::path &path, const Surface &surface) {
    check_surface(surface, path.string());
    write_file(path, obj_text(surface));
}

} // namespace tsuya::garment
