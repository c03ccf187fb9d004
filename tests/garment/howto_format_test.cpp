// The example of sdk/docs/howto/mesh_format.md: a reader of a made-up format, TRI.

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

// [doc:tri_header]
/// Reads a TRI file from text in memory: the numbers of vertices and triangles, then `x y z u v`
/// for each vertex and three indices from 0 for each triangle, all apart by blanks. Throws Error
/// naming the file if a number is wrong or missing, if it declares more than it holds, or names a
/// vertex that is not there. \param name stands for the file in errors
PolygonMesh parse_tri(std::string_view text, const std::string &name);
// [/doc:tri_header]

// [doc:tri_numbers]
/// Takes numbers off a text.
class Numbers {
  public:
    Numbers(std::string_view text, const std::string &name) : text_(text), name_(name) {}

    template <class T> T next() {
        text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size()));
        T value{};
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (error != std::errc{})
            throw Error({"'" + std::string(text_.substr(0, 12)) + "' is no number", name_,
                         "expected as many numbers as the first line declares"});
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return value;
    }
    std::size_t bytes_left() const { return text_.size(); }

  private:
    std::string_view text_;
    const std::string &name_;
};
// [/doc:tri_numbers]

// [doc:tri_reader]
PolygonMesh parse_tri(std::string_view text, const std::string &name) {
    constexpr std::size_t kVertexBytes = 10, kTriangleBytes = 6; // a digit and a blank a number
    Numbers numbers(text, name);
    const auto vertices = numbers.next<std::uint32_t>();
    const auto triangles = numbers.next<std::uint32_t>();
    // A small file cannot ask for a large mesh
    if (vertices * kVertexBytes + triangles * kTriangleBytes > numbers.bytes_left() + 1)
        throw Error({"more is declared than the file holds", name,
                     "expected no more vertices and triangles than the file has room for"});
    PolygonMesh mesh;
    mesh.position.reserve(vertices);
    mesh.uv.reserve(vertices);
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const double x = numbers.next<double>(), y = numbers.next<double>();
        mesh.position.emplace_back(x, y, numbers.next<double>());
        const double u = numbers.next<double>();
        mesh.uv.emplace_back(u, numbers.next<double>());
    }
    for (std::uint32_t i = 0; i < triangles; ++i) {
        std::vector<std::uint32_t> corners;
        for (int k = 0; k < 3; ++k)
            corners.push_back(numbers.next<std::uint32_t>());
        mesh.add_face(corners, {corners.begin(), corners.end()}, 0);
    }
    check_indices(mesh, name); // and that every number is finite
    share_equal_uvs(mesh);
    return mesh;
}
// [/doc:tri_reader]

// [doc:tri_test]
TEST(Tri, ReadsTrianglesAndUvs) {
    const PolygonMesh mesh = parse_tri("3 1\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 1 2\n", "a.tri");
    ASSERT_EQ(mesh.face_count(), 1u);
    EXPECT_EQ(mesh.position[1], glm::dvec3(1, 0, 0));
    EXPECT_EQ(mesh.uv[static_cast<std::size_t>(mesh.corner_uv[2])], glm::dvec2(0, 1));
}

TEST(Tri, RefusesWhatItCannotRead) {
    for (const std::string bad : {"",                          // no counts
                                  "3 4000000000\n0 0 0 0 0\n", // counts larger than the file
                                  "3 1\n0 0 0 0 0\n1 0 x 1 0\n0 1 0 0 1\n0 1 2\n", // no number
                                  "3 1\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 1 3\n", // no such vertex
                                  "3 1\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 1",     // cut short
                                  "3 1\n0 0 0 0 0\nnan 0 0 1 0\n0 1 0 0 1\n0 1 2\n"}) // not finite
        try {
            parse_tri(bad, "a.tri");
            ADD_FAILURE() << "accepted: " << bad;
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].where, "a.tri") << bad;
        }
}
// [/doc:tri_test]

} // namespace
} // namespace tsuya::garment
