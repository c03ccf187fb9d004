#include "tsuya/sdk/detail/limited_albedo.h"

namespace tsuya {

void LimitedAlbedo::tabulate(Symmetry symmetry,
                             const std::function<float(const glm::vec3 &)> &albedo,
                             int columns_of_quarter) {
    limited_below_ = 0;
    unlimited_ = AlbedoTable(symmetry, albedo, columns_of_quarter);
    unlimited_maximum_ = unlimited_.maximum();
    limited_below_ = unlimited_.cosine_above(1);
    albedo_ = limited_below_ > 0 ? AlbedoTable(symmetry, albedo, columns_of_quarter) : unlimited_;
}

} // namespace tsuya
