// tsuya relight: a picture under a lamp, from one render.

#include <iostream>

#include "command.h"
#include "look_options.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/relight.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/picture.h"

namespace tsuya::program {
namespace {

class RelightCommand final : public Command {
  public:
    explicit RelightCommand(CLI::App &program)
        : app_(*program.add_subcommand("relight", "A picture under a lamp, from one render")) {
        app_.footer(
            "Example:\n  tsuya relight dress.exr --lamp key=A --lamp fill=D65 -o dress.png");
        app_.add_option("transport", transport_, "OUT.exr of render or tryon")->required();
        app_.add_option("--lamp", lamps_,
                        "Name of `tsuya list lamps` or F.csv; GROUP=LAMP for one light group")
            ->required();
        app_.add_option("-o,--output", output_, "OUT.png")->required();
        app_.add_option("--bits", bits_, "Of the PNG, 8 or 16")
            ->check(CLI::IsMember({8, 16}))
            ->capture_default_str();
        look_.add_to(app_);
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &) override {
        const DisplayOptions look = look_.look();
        const SpectralImage transport = read_spectral_exr(transport_);
        const std::vector<NamedLamp> lamps = scene::parse_group_lamps(lamps_, transport.groups);
        const Image picture = scene::picture_under(transport, lamps, look);
        scene::prepare_output_file(output_, {".png"});
        write_png(output_, picture, bits_);
        std::cout << output_.string() << "\n";
        return kDone;
    }

  private:
    CLI::App &app_;
    std::filesystem::path transport_{}, output_{};
    std::vector<std::string> lamps_{};
    int bits_ = 8;
    LookOptions look_{};
};

} // namespace

std::unique_ptr<Command> make_relight(CLI::App &program) {
    return std::make_unique<RelightCommand>(program);
}

} // namespace tsuya::program
