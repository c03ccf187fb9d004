// The program `tsuya` with the commands of the lab alone: it starts at once in the guest of
// gpio_test.sh.

#include "command.h"

#include <array>

namespace {

using namespace tsuya::program;

constexpr std::array kCommands{
    CommandEntry{"lab", "Drive the measuring rig", nullptr},
    CommandEntry{"lab lines", "The GPIO lines of this computer", make_lab_lines},
    CommandEntry{"lab pulse", "Open the shutter for exact times", make_lab_pulse},
};

} // namespace

int main(int argc, char **argv) { return run_program(kCommands, argc, argv); }
