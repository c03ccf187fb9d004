#pragma once
// Tables of what yarns show.

#include "tsuya/sdk/reflectance_table.h"
#include "tsuya/sdk/yarn.h"

namespace tsuya::test {

// Views all around under one light; of light from above a quarter, orthotropic.
ReflectanceTable table_of(const YarnBrdf &brdf, double theta_i_deg, double phi_i_deg);

} // namespace tsuya::test
