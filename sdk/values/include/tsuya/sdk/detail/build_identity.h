#pragma once
/// \file
/// Which build of the code runs, on which kind of processor: whose numbers are equal to the last
/// bit.

#include <string>

namespace tsuya::detail {

/// The identity that the linker gave the program or library with this code, and the vector
/// instructions that the processor has. Empty where the linker gave none.
std::string build_identity();

} // namespace tsuya::detail
