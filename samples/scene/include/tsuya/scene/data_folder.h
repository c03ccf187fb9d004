#pragma once
/// \file
/// Where the sample data lies: garments, dress form, fabrics and scenes.

#include <filesystem>
#include <string>
#include <vector>

namespace tsuya::scene {

/// The folder of the sample data: `chosen` if it is not empty, else the first that exists of
/// `../share/tsuya` beside the folder of the running program, the installed folder, and the source
/// tree. Throws Error naming the folder if it holds no sample data.
std::filesystem::path data_folder(const std::filesystem::path &chosen = {});

/// Names of the fabrics in the sample data, sorted: `NAME` for `fabrics/NAME.fabric.toml`.
std::vector<std::string> sample_fabrics(const std::filesystem::path &data);

/// A fabric as programs name it: one of sample_fabrics, or a path that ends in `.toml`. Throws
/// Error for another name, with the known ones and the nearest.
std::filesystem::path find_fabric(const std::string &name, const std::filesystem::path &data);

} // namespace tsuya::scene
