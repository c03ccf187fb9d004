#include "prepared_state.h"

namespace tsuya {

PreparedScene::PreparedScene(TableCache cache)
    : state_(new State{.materials = KeptMaterials(std::move(cache))}) {}
PreparedScene::~PreparedScene() = default;
PreparedScene::PreparedScene(PreparedScene &&) noexcept = default;
PreparedScene &PreparedScene::operator=(PreparedScene &&) noexcept = default;

PreparedUse PreparedScene::use() const {
    return {.objects_built = state_->accelerator.objects_built(),
            .objects_kept = state_->accelerator.objects_kept(),
            .tables = state_->materials.use()};
}

PreparedUse PreparedUse::since(const PreparedUse &before) const {
    PreparedUse use = *this;
    use.objects_built -= before.objects_built;
    use.objects_kept -= before.objects_kept;
    use.tables.made -= before.tables.made;
    use.tables.read -= before.tables.read;
    use.tables.shared -= before.tables.shared;
    return use;
}

} // namespace tsuya
