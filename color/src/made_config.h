#pragma once
/// \file
/// The OpenColorIO config that we make.

#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

#include "tsuya/color/config.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

/// The scene-referred reference space.
inline constexpr const char *kReferenceSpace = "CIE XYZ D65";

/// Throws OpenColorIO's exceptions.
OCIO_NAMESPACE::ConstConfigRcPtr make_config(const std::vector<LampWhite> &lamps);

/// An exception of OpenColorIO as Error.
[[noreturn]] void throw_ocio(const std::exception &error, const std::string &where);

} // namespace tsuya
