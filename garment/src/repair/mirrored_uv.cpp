// UV islands that fold over themselves.

#include <unordered_map>

#include "mesh/islands.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"
#include "tsuya/garment/panels.h"

namespace tsuya::garment {

void MeshRepair::cut_folded_islands() {
    const SetNumbers islands = find_islands(mesh_, edges());
    std::vector<bool> upright(islands.count, false);
    std::vector<double> area(mesh_.face_count());
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        look_at_stop(progress_, f);
        area[f] = uv_area(mesh_, f);
        if (area[f] > 0.0)
            upright[islands.of[f]] = true;
    }
    // The mirrored faces of an island that has others, too, get UV indices of their own.
    std::unordered_map<std::int32_t, std::int32_t> copies;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        if (!(area[f] < 0.0) || !upright[islands.of[f]])
            continue;
        for (std::uint32_t c = mesh_.face_offset[f]; c < mesh_.face_offset[f + 1]; ++c) {
            const std::int32_t uv = mesh_.corner_uv[c];
            const auto [copy, added] =
                copies.try_emplace(uv, static_cast<std::int32_t>(mesh_.uv.size()));
            if (added)
                mesh_.uv.push_back(mesh_.uv[static_cast<std::size_t>(uv)]);
            mesh_.corner_uv[c] = copy->second;
        }
    }
}

} // namespace tsuya::garment
