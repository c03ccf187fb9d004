#pragma once
// Rays through cloth without an edge: the one file of the lab that knows Embree.

#include <cstdint>
#include <memory>

#include <glm/glm.hpp>

#include "filament_cell.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::lab {

inline constexpr float kRayOffset = 2e-3f; // of a ray from the surface that it leaves, radii

// Where a ray hits a filament.
struct Hit {
    glm::vec3 point, normal; // the normal points outwards
    std::uint32_t system;
    bool on_cone;
    std::uint32_t segment; // cone or tube segment
};

// A point within a filament.
struct Inside {
    glm::vec3 point;
    std::uint32_t segment;
    bool on_cone;
};

enum class Fate { hit, above, below, lost };

class FilamentScene {
  public:
    // Normals of hits are those of the smooth filament, or of the shape itself.
    enum class Normals {
        smooth,
        for_light // of the shape where light goes through a filament: by a smooth one it would
                  // leave on the side that it came from; else smooth
    };

    // Throws Interrupted where `progress` is stopped.
    FilamentScene(FilamentCell cell, const Progress &progress,
                  Normals normals = Normals::for_light);
    ~FilamentScene();
    FilamentScene(const FilamentScene &) = delete;
    FilamentScene &operator=(const FilamentScene &) = delete;

    // Follows a ray to the first filament or out of the cloth. The cell repeats in x and y: what
    // leaves on one side comes in on the other. Lost: a ray that stays within the cloth for
    // thousands of cells.
    Fate trace(glm::vec3 origin, const glm::vec3 &direction, Hit &hit) const;

    // Whether a ray leaves the cloth, upwards. Filaments that share space hide each other here.
    bool escapes(glm::vec3 origin, const glm::vec3 &direction) const;

    // The number of a filament in cell().strands.
    std::uint32_t strand(std::uint32_t segment, bool on_cone) const {
        return on_cone ? cell_.cones.strand[segment] : cell_.tubes.strand[segment];
    }

    // Follows a ray within a filament to its wall, or for `reach` where that is nearer. `travelled`
    // is how far it came; at a wall, `hit` is where, else `place` is. Hit: at the wall. Lost:
    // not at the wall.
    Fate within(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                float &travelled) const;

    const FilamentCell &cell() const { return cell_; }

  private:
    struct State;
    struct Leg;
    bool is_smooth(std::uint32_t system) const {
        return normals_ == Normals::smooth || !cell_.clear[system];
    }
    Leg leg(glm::vec3 &origin, const glm::vec3 &direction) const;
    Fate within_cones(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                      float &travelled) const;
    Fate within_tube(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                     float &travelled) const;

    FilamentCell cell_;
    Normals normals_;
    std::unique_ptr<State> state_;
};

} // namespace tsuya::lab
