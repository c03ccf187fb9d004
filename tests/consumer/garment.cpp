#include "tsuya/garment/subdivide.h"

#include <cstdio>

int main() {
    tsuya::garment::PolygonMesh mesh;
    mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.panel_name = {"cloth"};
    mesh.add_face({0, 1, 2, 3}, {0, 1, 2, 3}, 0);
    const tsuya::garment::LimitMesh limit = tsuya::garment::subdivide(mesh, {.level = 3});
    std::printf("%zu triangles\n", limit.triangle.size());
    return limit.triangle.size() == 128 ? 0 : 1; // 8 x 8 quads
}
