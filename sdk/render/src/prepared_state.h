#pragma once
// What a PreparedScene keeps.

#include "accelerator.h"
#include "tsuya/sdk/prepared_scene.h"

namespace tsuya {

struct PreparedScene::State {
    KeptMaterials materials;
    Accelerator accelerator{};
};

} // namespace tsuya
