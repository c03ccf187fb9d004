#pragma once
// What tests of `tsuya fabric` share beside process.h.

#include <filesystem>
#include <string>
#include <vector>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/scene/data_folder.h"

namespace tsuya::program {

/// `tsuya fabric` with these arguments.
inline Outcome run_fabric(const scene::Scratch &scratch, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fabric");
    return run_program(arguments, scratch.folder());
}

inline std::filesystem::path satin() {
    return scene::data_folder() / "fabrics/black_satin.fabric.toml";
}

} // namespace tsuya::program
