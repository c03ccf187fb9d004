#pragma once
/// \file
/// An albedo as a function of direction: smooth over most of the hemisphere, steep at grazing.

#include <cstddef>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// Bilinear table over sqrt(cos theta), in which albedos are nearly straight down to the horizon,
/// and azimuth. Only the azimuths that the symmetry leaves are held.
class AlbedoTable {
  public:
    AlbedoTable() = default;
    /// \param function called at unit directions with z > 0, from several threads
    /// \param columns_of_quarter steps of azimuth in a quarter turn; 8 are 11 degrees
    AlbedoTable(Symmetry symmetry, const std::function<float(const glm::vec3 &)> &function,
                int columns_of_quarter = 8);
    /// The same of values at the directions of `nodes`.
    AlbedoTable(Symmetry symmetry, std::vector<float> values, int columns_of_quarter);
    /// The unit directions, z > 0, at which the table holds a value.
    static std::vector<glm::vec3> nodes(Symmetry symmetry, int columns_of_quarter);

    /// \param direction unit, z >= 0
    float at(const glm::vec3 &direction) const;
    float maximum() const;
    std::size_t bytes() const { return value_.size() * sizeof(float); }
    /// Nowhere at or above this cosine is the table above `value`; 0 where it never is.
    float cosine_above(float value) const;

  private:
    template <class F, detail::MaybeConst<AlbedoTable> T> friend void each_part(F &&f, T &t) {
        auto &[symmetry, columns_of_quarter, columns, value] = t;
        f(symmetry, columns_of_quarter, columns, value);
    }

    Symmetry symmetry_ = Symmetry::orthotropic;
    int columns_of_quarter_ = 0, columns_ = 0;
    std::vector<float> value_{}; ///< [row from the horizon to the pole][azimuth], ends included
};

} // namespace tsuya
