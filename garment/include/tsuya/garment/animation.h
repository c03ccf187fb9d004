#pragma once
/// \file
/// A garment that moves: frames of one topology, such as morph targets or a simulator's OBJ files.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tsuya/garment/garment.h"

namespace tsuya::garment {

/// A garment and further shapes of its topology, in the order of the files.
struct GarmentFrames {
    MeshFile first{};
    std::vector<std::vector<glm::dvec3>> further{}; ///< positions, in units of the files
};

/// Reads a mesh and the positions of further ones. \param with_morph_targets the targets of
/// `first` come before the files. Throws Error as read_mesh, and naming the file and its counts
/// where the faces are not those of the first.
GarmentFrames read_frames(const std::filesystem::path &first,
                          const std::vector<std::filesystem::path> &further,
                          bool with_morph_targets = false, const Progress &progress = {});

/// Repairs, seams, rates of tessellation, numbering and UVs are those of the first frame and are
/// worked out once; seams that were joined stay joined.
class AnimatedGarment {
  public:
    /// \param file the first frame \param where names it in errors. Throws as load.
    AnimatedGarment(const MeshFile &file, const Options &options, const std::string &where,
                    const Progress &progress = {});

    ~AnimatedGarment();
    /// Moves; the garment moved from may only be assigned to.
    AnimatedGarment(AnimatedGarment &&) noexcept;
    /// As the move constructor.
    AnimatedGarment &operator=(AnimatedGarment &&) noexcept;

    /// The first frame, with its report.
    const LoadedGarment &first() const;
    /// The surface of other positions, in units and order of the file's vertices; its vertices and
    /// triangles have the numbers of the first. Throws Error for another number of positions, or
    /// one that is not finite.
    Surface frame(const std::vector<glm::dvec3> &positions);
    /// The same in the memory of another frame's surface, or of a copy of the first: faster.
    void frame(const std::vector<glm::dvec3> &positions, Surface &surface);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tsuya::garment
