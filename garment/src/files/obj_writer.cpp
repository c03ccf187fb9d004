#include <charconv>

#include "files/block_writer.h"
#include "tsuya/garment/obj.h"

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

} // namespace

void write_obj(const std::filesystem::path &path, const Surface &s, const Progress &progress) {
    check_surface(s, path.string());
    begin_stage(progress, "garment: write");
    BlockWriter out(path, progress);
    std::string &text = out.bytes();
    text = "# written by tsuya; metres\n";
    const auto append_lines = [&](const char *keyword, const auto &rows) {
        for (const auto &row : rows) {
            append_line(text, keyword, row);
            out.end_entry();
        }
    };
    append_lines("v", s.position);
    append_lines("vt", s.uv);
    append_lines("vn", s.normal);
    for (std::size_t i = 0; i < s.triangle.size(); ++i) {
        const bool named = !s.panel.empty() && s.panel[i] < s.panel_name.size();
        if (named && (i == 0 || s.panel[i] != s.panel[i - 1]))
            text += "g " + one_line(s.panel_name[s.panel[i]]) + "\n";
        append_triangle(text, s, s.triangle[i]);
        out.end_entry();
    }
    out.commit();
}

} // namespace tsuya::garment
