#include "file_opacity.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "index_of.h"
#include "tsuya/color/print_file.h"
#include "tsuya/garment/panels.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

// Areas that a panel has in the UV plane.
struct UvAreas {
    double upright = 0, mirrored = 0;
};

UvAreas uv_areas(const garment::PolygonMesh &mesh, const std::string &panel) {
    UvAreas areas;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.panel_name[mesh.face_panel[f]] != panel)
            continue;
        const double area = garment::uv_area(mesh, f);
        (area < 0 ? areas.mirrored : areas.upright) += std::abs(area);
    }
    return areas;
}

// The share of cloth at a place between texels, 0 to 255; beyond an edge as on the other side.
double sample(const Texture &picture, double x, double y) {
    const auto texel = [&](double column, double row) {
        const auto wrapped = [](double at, int size) {
            const int i = static_cast<int>(at) % size;
            return static_cast<std::size_t>(i < 0 ? i + size : i);
        };
        return static_cast<double>(
            picture.data[wrapped(row, picture.height) * static_cast<std::size_t>(picture.width) +
                         wrapped(column, picture.width)]);
    };
    const double column = std::floor(x - 0.5), row = std::floor(y - 0.5);
    const double s = x - 0.5 - column, t = y - 0.5 - row;
    return std::lerp(std::lerp(texel(column, row), texel(column + 1, row), s),
                     std::lerp(texel(column, row + 1), texel(column + 1, row + 1), s), t);
}

// The share of cloth as a square picture, as the UVs have it. A cutoff is taken between texels, as
// viewers do: a small picture gets finer for it.
Texture coverage_of(const garment::FileOpacity &opacity) {
    constexpr int kFiner = 4, kLargest = 4096;
    const Texture alpha = opacity.picture.empty()
                              ? Texture{.width = 1, .height = 1, .channels = 1, .data = {255}}
                              : decode_coverage(opacity.picture, opacity.picture_name);
    int size = std::max(alpha.width, alpha.height);
    if (opacity.cutoff && !opacity.picture.empty() && size * kFiner <= kLargest)
        size *= kFiner;
    Texture square{.width = size, .height = size, .channels = 1};
    square.data.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double share =
                opacity.factor *
                sample(alpha, (x + 0.5) * alpha.width / size, (y + 0.5) * alpha.height / size) /
                255;
            const double cloth = !opacity.cutoff ? share : share >= *opacity.cutoff ? 1.0 : 0.0;
            square.data.push_back(static_cast<std::uint8_t>(std::lround(255 * cloth)));
        }
    return square;
}

Texture flipped(Texture picture) {
    const auto width = static_cast<std::ptrdiff_t>(picture.width);
    for (auto row = picture.data.begin(); row != picture.data.end(); row += width)
        std::reverse(row, row + width);
    return picture;
}

double grain_of(const garment::MeshFile &mesh, const garment::FrameOptions &frames,
                const std::string &panel) {
    if (const auto stated = frames.grain.find(panel); stated != frames.grain.end())
        return stated->second;
    const auto hint = std::ranges::find(mesh.hints, panel, &garment::FabricHint::panel);
    return hint != mesh.hints.end() && hint->anisotropy_strength > 0 ? hint->grain()
                                                                     : frames.default_grain;
}

// Where a square of UV lies on the cloth, see garment::add_frames: cloth is UV turned back by the
// grain, and u runs the other way where the UVs are mirrored, as does the picture then.
Placement placement_of(double width, double grain, bool mirrored, bool mirrored_repeat) {
    Placement placement{.width = width, .turn = -grain};
    if (mirrored) {
        placement.turn = grain;
        placement.origin = -width * glm::dvec2(std::cos(grain), std::sin(grain));
    }
    placement.repeat = mirrored_repeat ? Repeat::mirror : Repeat::tile;
    return placement;
}

} // namespace

bool is_half_mirrored(const garment::PolygonMesh &mesh, const std::string &panel) {
    constexpr double kLeast = 0.01; // of the area
    const UvAreas areas = uv_areas(mesh, panel);
    return std::min(areas.upright, areas.mirrored) > kLeast * (areas.upright + areas.mirrored);
}

void add_file_opacities(const garment::MeshFile &mesh, const garment::Options &options,
                        double metres_per_uv, Dressing &dressing, Scene &scene) {
    std::map<std::pair<std::size_t, bool>, TextureIndex> textures;
    const auto texture = [&](std::size_t number, bool mirrored) {
        const auto [at, added] =
            textures.try_emplace({number, mirrored}, index_of<TextureTag>(scene.textures.size()));
        if (added) {
            Texture picture = coverage_of(mesh.opacities[number]);
            scene.textures.push_back(mirrored ? flipped(std::move(picture)) : std::move(picture));
        }
        return at->second;
    };
    for (const auto &[panel, number] : dressing.file_opacities) {
        const std::string &name = mesh.mesh.panel_name[panel];
        const UvAreas areas = uv_areas(mesh.mesh, name);
        const bool mirrored = areas.mirrored > areas.upright;
        scene.opacities.push_back({texture(number, mirrored),
                                   placement_of(metres_per_uv, grain_of(mesh, options.frames, name),
                                                mirrored, mesh.opacities[number].mirrored_repeat)});
        std::ranges::find(dressing.panels, panel, &PanelFabric::panel)->opacity =
            index_of<OpacityTag>(scene.opacities.size() - 1);
    }
    dressing.file_opacities.clear();
}

} // namespace tsuya::scene
