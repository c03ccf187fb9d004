// The program `tsuya`: parses, calls the SDK, prints.

#include <array>

#include "command.h"

namespace {

using namespace tsuya::program;

constexpr std::array kCommands{
    CommandEntry{"tryon", "Show a garment in a fabric, dyed and lit", make_tryon},
    CommandEntry{"render", "Render a scene file to light transport, without lamps", make_render},
    CommandEntry{"relight", "A picture under a lamp, from one render", make_relight},
    CommandEntry{"compare", "One render under several lamps, with colour differences",
                 make_compare},
    CommandEntry{"aovs", "The AOVs of a render as pictures on a sheet", make_aovs},
    CommandEntry{"fabric", "Make fabrics from measurements or weaves, examine them", nullptr},
    CommandEntry{"fabric fit", "Fit a fabric to a few measured views", make_fabric_fit},
    CommandEntry{"fabric simulate", "Measure a weave by a virtual goniometer",
                 make_fabric_simulate},
    CommandEntry{"fabric evaluate", "How far the models of a fabric lie from a table",
                 make_fabric_evaluate},
    CommandEntry{"fabric show", "Draw what a fabric reflects, or a weave", make_fabric_show},
    CommandEntry{"fabric paper", "The tables of Takeda et al. beside ours", make_fabric_paper},
    // [doc:command_table]
    CommandEntry{"garment", "Examine, subdivide and export meshes", nullptr},
    CommandEntry{"garment check", "What is wrong with a mesh", make_garment_check},
    // [/doc:command_table]
    CommandEntry{"garment export", "A dressed garment for viewers of glTF", make_garment_export},
    CommandEntry{"garment subdivide", "The limit surface of a mesh", make_garment_subdivide},
    CommandEntry{"lab", "Drive the measuring rig", nullptr},
    CommandEntry{"lab lines", "The GPIO lines of this computer", make_lab_lines},
    CommandEntry{"lab pulse", "Open the shutter for exact times", make_lab_pulse},
    CommandEntry{"lab plan", "Plan the frames of a capture session", make_lab_plan},
    CommandEntry{"lab run", "Take the frames of a plan", make_lab_run},
    CommandEntry{"lab resume", "Go on with a capture session", make_lab_resume},
    CommandEntry{"lab status", "How far a capture session is", make_lab_status},
    CommandEntry{"lab reset", "Acknowledge a fault of interlock or emergency stop", make_lab_reset},
    CommandEntry{"lab measure", "Turn a session's pictures into a table of reflectance",
                 make_lab_measure},
    CommandEntry{"list", "What can be named: lamps, dyes, fabrics, ...", make_list},
};

} // namespace

int main(int argc, char **argv) { return run_program(kCommands, argc, argv); }
