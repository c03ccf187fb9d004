#pragma once
/// \file
/// How bright the lamp was between two looks at the white standard.

#include <optional>
#include <vector>

namespace tsuya::lab {

/// The white standard, measured.
struct WhiteReading {
    double time_s = 0; ///< middle of the exposures, seconds since 1970
    double rate = 0;   ///< DN a second, without stray light
    double sigma = 0;  ///< noise of it
    int strike = 0;    ///< which lighting of the lamp
};

/// The lamp's light at a time, in the white standard's DN a second.
struct LampLight {
    double rate = 0;
    double sigma = 0; ///< of drift, flicker and the noise of the white frames
    /// The white before and the white after it differ by more than the limit.
    bool jump = false;
};

/// White readings of one view, of one direction of light. The lamp is taken as linear in time
/// between two of them of one lighting, and as the nearer one outside of them.
class LampDrift {
  public:
    /// \param jump_limit relative difference of neighbours that is no drift, > 0
    /// \param flicker relative; what a frame's light differs from the drift's line by
    LampDrift(std::vector<WhiteReading> readings, double jump_limit, double flicker);

    /// Nothing for a lighting without a reading.
    std::optional<LampLight> at(double time_s, int strike) const;
    /// By strike and time.
    const std::vector<WhiteReading> &readings() const { return readings_; }

  private:
    std::vector<WhiteReading> readings_; // by strike and time
    double jump_limit_, flicker_;
};

/// The relative flicker of single frames: root mean square of what each reading between two others
/// of its lighting differs from the line between them by, freed of noise and of the part that the
/// two neighbours have in it. Readings of other directions of light may stand in other lists.
/// Nothing where no reading has two neighbours.
std::optional<double> flicker_of(const std::vector<std::vector<WhiteReading>> &lists);

} // namespace tsuya::lab
