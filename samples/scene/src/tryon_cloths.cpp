#include "tryon_cloths.h"

#include <algorithm>

#include "tsuya/scene/read_cloth.h"

namespace tsuya::scene {

Cloths::Cloths(const TryOn &job, const Progress &progress) {
    const auto index = [&](const std::filesystem::path &file) -> std::optional<std::size_t> {
        if (file.empty())
            return {};
        const auto known = std::find(files_.begin(), files_.end(), file);
        if (known == files_.end()) {
            files_.push_back(file);
            fabrics.push_back(read_cloth(file, progress));
            return files_.size() - 1;
        }
        return static_cast<std::size_t>(known - files_.begin());
    };
    fabrics.push_back(read_cloth(job.fabric, progress));
    files_.emplace_back(); // dyed for each render, so that no panel shares it
    if (const auto behind = index(job.back))
        back = FabricIndex{static_cast<std::uint32_t>(*behind)};
    for (const PanelCloth &panel : job.panels)
        entries.push_back({.panels = panel.panels,
                           .where = "panel '" + panel.panels + "'",
                           .fabric = index(panel.fabric),
                           .back = index(panel.back)});
}

bool Cloths::need_frames() const {
    return std::any_of(fabrics.begin(), fabrics.end(), needs_frames);
}

std::vector<DressingFabric> Cloths::dressing() const {
    std::vector<DressingFabric> all;
    for (const Fabric &fabric : fabrics)
        all.push_back({.needs_frames = needs_frames(fabric)});
    return all;
}

} // namespace tsuya::scene
