#pragma once
/// \file
/// STL files as other programs write them.

#include <string>

namespace tsuya::garment {

/// The bytes in the form that Assimp takes: a binary file without what follows its last facet, a
/// text with keywords in lower case. Throws Error naming `where` for what is neither, such as a
/// binary file that is shorter than its count of facets says.
std::string stl_bytes(std::string bytes, const std::string &where);

} // namespace tsuya::garment
