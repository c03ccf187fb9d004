#pragma once
// Rays through cloth without an edge: the one file of the lab that knows Embree.

#include <cstdint>
#include <memory>

#include <glm/glm.hpp>

#include "filament_cell.h"

namespace tsuya::lab {

// Where a ray met a filament.
struct Meeting {
    glm::vec3 point, normal; // the normal is smooth and points outwards
    std::uint32_t system;
    bool on_cone;
    std::uint32_t segment; // cone or tube segment
    float along;           // share of the segment's length
};

enum class Fate { met, above, below, lost };

class FilamentScene {
  public:
    explicit FilamentScene(FilamentCell cell);
    ~FilamentScene();
    FilamentScene(const FilamentScene &) = delete;
    FilamentScene &operator=(const FilamentScene &) = delete;

    // Follows a ray to the first filament or out of the cloth. The cell repeats in x and y: what
    // leaves on one side comes in on the other. Lost: a ray that stays within the cloth for
    // thousands of cells.
    Fate trace(glm::vec3 origin, const glm::vec3 &direction, Meeting &meeting) const;

    // Whether a ray leaves the cloth, upwards. Filaments that share space hide each other here.
    bool escapes(glm::vec3 origin, const glm::vec3 &direction) const;

    // A point somewhere on the outline of the filament that was met, at the same place along it.
    // \param u in [0, 1)
    Meeting around(const Meeting &meeting, float u) const;

    const FilamentCell &cell() const { return cell_; }

  private:
    struct State;
    struct Leg;
    Leg leg(glm::vec3 &origin, const glm::vec3 &direction) const;

    FilamentCell cell_;
    std::unique_ptr<State> state_;
};

} // namespace tsuya::lab
