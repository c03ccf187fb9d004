// tsuya compare: one render under several lamps, side by side and in numbers.

#include <iomanip>
#include <iostream>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "tsuya/color/compare.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/sheet.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/picture.h"

namespace tsuya::program {
namespace {

class CompareCommand final : public Command {
  public:
    explicit CompareCommand(CLI::App &program)
        : app_(*program.add_subcommand("compare", "One render under several lamps")) {
        app_.footer("Example:\n  tsuya compare dress.exr --lamps D65,HP4,A -o sheet.png\n"
                    "Prints CIEDE2000 between the lamps, each picture adapted to D65 by CAT02.");
        app_.add_option("transport", transport_, "OUT.exr of render or tryon")->required();
        app_.add_option("--lamps", lamps_, "Names of `tsuya list lamps`, or F.csv; two or more")
            ->delimiter(',')
            ->required();
        app_.add_option("-o,--output", output_, "SHEET.png")->required();
        app_.add_option("--report", report_, "FILE.json of the differences");
        app_.add_flag("--json", json_, "The differences as JSON");
        look_.add_to(app_);
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &) override {
        const DisplayOptions look = look_.look();
        const SpectralImage transport = read_spectral_exr(transport_);
        const std::vector<NamedLamp> lamps = scene::parse_lamps(lamps_);
        const std::vector<LampDifference> differences =
            compare_lamps(transport, lamps, {.exposure_stops = look.exposure_stops});
        Sheet sheet;
        for (const NamedLamp &lamp : lamps)
            sheet.pictures.push_back(
                {scene::picture_under(transport, {&lamp, 1}, look), scene::caption_of(lamp)});
        const Image drawn = draw_sheet(sheet);
        scene::prepare_output_file(output_, {".png"});
        if (!report_.empty())
            scene::prepare_output_file(report_, {".json"});
        write_png(output_, drawn);
        const Json json = json_of_differences(differences);
        if (!report_.empty())
            write_json(report_, json);
        if (json_)
            std::cout << json.dump(2) << "\n";
        else
            print(differences);
        return kDone;
    }

  private:
    Json json_of_differences(const std::vector<LampDifference> &differences) const {
        Json json{{"schema", "tsuya-compare 1"},
                  {"transport", transport_.string()},
                  {"measure", "CIEDE2000"},
                  {"adaptation", to_string(CompareOptions{}.adapt)},
                  {"differences", Json::array()}};
        for (const LampDifference &d : differences)
            json["differences"].push_back({{"first", d.first},
                                           {"second", d.second},
                                           {"mean", d.mean},
                                           {"p95", d.p95},
                                           {"max", d.max},
                                           {"pixels", d.pixels}});
        return json;
    }

    static void print(const std::vector<LampDifference> &differences) {
        std::cout << "CIEDE2000 after adaptation\n"
                  << std::left << std::setw(12) << "first" << std::setw(12) << "second"
                  << std::right << std::setw(8) << "mean" << std::setw(8) << "p95" << std::setw(8)
                  << "max" << std::setw(10) << "pixels"
                  << "\n"
                  << std::fixed << std::setprecision(2);
        for (const LampDifference &d : differences)
            std::cout << std::left << std::setw(12) << d.first << std::setw(12) << d.second
                      << std::right << std::setw(8) << d.mean << std::setw(8) << d.p95
                      << std::setw(8) << d.max << std::setw(10) << d.pixels << "\n";
    }

    CLI::App &app_;
    std::filesystem::path transport_{}, output_{}, report_{};
    std::vector<std::string> lamps_{};
    bool json_ = false;
    LookOptions look_{};
};

} // namespace

std::unique_ptr<Command> make_compare(CLI::App &program) {
    return std::make_unique<CompareCommand>(program);
}

} // namespace tsuya::program
