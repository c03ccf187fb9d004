#pragma once
/// \file
/// Files that other programs exchange: FBX, Collada (`.dae`) and STL, through Assimp.

#include <filesystem>

#include "tsuya/garment/mesh_file.h"

namespace tsuya::garment {

/// Reads `.fbx`, `.dae` or `.stl`, as the extension says. Faces keep their size, corners their UVs,
/// and a panel is what a node has of one material. Positions are in metres with y up where the file
/// states its unit and axis (`file_units`); STL states neither. Assimp gives every corner a vertex
/// of its own: those of a node at exactly one place become one. The first of several UV sets is
/// taken (`uv_sets`); skins, morph targets and animations are not (`not_read`, `skin_not_applied`).
/// What Assimp has to remark is a finding (`importer_remarks`).
///
/// Assimp runs in a process of its own with a limit of memory and time, so that a file that crashes
/// it is an Error as any other. Throws Error naming the file, also where this build has no Assimp;
/// Interrupted where `progress` says stop.
MeshFile read_interchange(const std::filesystem::path &path, const Progress &progress = {});

} // namespace tsuya::garment
