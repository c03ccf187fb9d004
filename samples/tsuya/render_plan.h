#pragma once
/// \file
/// What `tsuya render --explain` prints.

#include <string>

#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/render.h"

namespace tsuya::program {

/// How well three lamps make the colours of an environment.
std::string environment_text(double error);

/// The plan of a render of a scene file, as lines of text or as `tsuya-render-plan 1`.
std::string plan_text(const scene::SceneFile &file, const scene::BuiltScene &built,
                      const RenderSettings &settings, bool as_json);

} // namespace tsuya::program
