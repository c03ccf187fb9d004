#pragma once
/// \file
/// The reflectance of the white standard.

#include <string>
#include <vector>

#include "tsuya/lab/rig_file.h"
#include "tsuya/sdk/directions.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::lab {

/// A number or a spectrum stands for an ideal diffuser, a table for what it says.
class WhiteStandard {
  public:
    /// \param colour of the camera: R, G and B take the part of a spectrum from 600, 500 and 400 nm
    /// on, each 100 nm wide; others 400 to 700 nm. Throws Error at the file.
    WhiteStandard(const RigWhite &white, const std::string &colour);

    /// About its spectrum, see read_dye_file.
    const std::vector<std::string> &warnings() const { return warnings_; }
    bool is_table() const { return !table_.rows.empty(); }
    /// In 1/sr. Throws Error if the table has no row within half a degree of the directions.
    double brdf_per_sr(const DirectionPair &directions) const;

  private:
    double reflectance_ = 1;
    ReflectanceTable table_{};
    std::string file_{};
    std::vector<std::string> warnings_{};
};

} // namespace tsuya::lab
