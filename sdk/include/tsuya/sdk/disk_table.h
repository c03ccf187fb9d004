#pragma once
/// \file
/// A function of direction as a table on the equal-area disk of the hemisphere.

#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// Bilinear table over the upper hemisphere; one quadrant where the function is orthotropic.
class DiskTable {
  public:
    DiskTable() = default;
    /// \param nodes along one axis of the quadrant (orthotropic) or of the whole square
    DiskTable(int nodes, bool orthotropic, const std::function<float(const glm::vec3 &)> &function);
    /// \param direction unit, z >= 0
    float at(const glm::vec3 &direction) const;

  private:
    int nodes_ = 0;
    bool orthotropic_ = true;
    std::vector<float> value_{};
};

} // namespace tsuya
