// tsuya fabric simulate: the virtual goniometer.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include "command.h"
#include "json_file.h"
#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/scene/output_file.h"
#include "weave_name.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;

constexpr double kNormalStep = 5;
constexpr double kPhiPerTheta = 5.0 / 3.0; // of the steps of [Takeda]: 3 and 5 degrees

// About that, and a whole part of 45 degrees, so that views lie in all three planes.
double phi_step(double theta_step) {
    return 45 / std::max(1.0, std::round(45 / (theta_step * kPhiPerTheta)));
}

class SimulateCommand final : public Command {
  public:
    explicit SimulateCommand(CLI::App &fabric)
        : app_(*fabric.add_subcommand("simulate", "Measure a weave that exists as a draft only")) {
        app_.footer("Example:\n"
                    "  tsuya fabric simulate \"polyester taffeta\" -o taffeta.csv\n"
                    "`tsuya list weaves` names the presets. An interrupted measurement leaves what "
                    "it has in TABLE.csv,\nand TABLE.csv.checkpoint for --resume.");
        app_.add_option("weave", weave_, "WEAVE.toml, DRAFT.wif or a preset")->required();
        app_.add_option("-o,--output", output_, "TABLE.csv of reflectance")->required();
        app_.add_option("--directions", directions_,
                        "normal: light from straight above; paper: the set of Takeda et al.; or a "
                        "table, whose directions are taken")
            ->capture_default_str();
        app_.add_option(
                "--step", step_deg_,
                "Degrees between views: 5 for normal, 3 (theta, with about 5/3 of it in phi) "
                "for paper")
            ->check(CLI::Range(0.5, 45.0));
        app_.add_option("--photons", settings_.photons, "A direction of light, at most")
            ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
            ->capture_default_str();
        app_.add_option("--error", settings_.error, "Until the relative standard error is below")
            ->check(CLI::Range(1e-6, 1.0));
        app_.add_option("--time", settings_.seconds, "Seconds")->check(CLI::Range(1e-3, 1e6));
        app_.add_option("--wavelength", wavelength_nm_, "Nanometres: of the index and the dye")
            ->check(CLI::Range(380.0, 780.0))
            ->capture_default_str();
        app_.add_option("--seed", settings_.seed, "Of the noise")->capture_default_str();
        app_.add_option("--threads", settings_.threads, "0: all")->check(CLI::Range(0, 4096));
        app_.add_flag("--resume", settings_.resume, "Go on from TABLE.csv.checkpoint");
        app_.add_flag("--json", json_, "The report as JSON");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        const lab::Weave weave = weave_named(weave_);
        const Symmetry symmetry = lab::symmetry_of(weave);
        const lab::Directions directions = read_directions(symmetry);
        if (directions.symmetry > symmetry)
            console.warning(weave_ + ": its symmetry is " + std::string(name_of(symmetry)) +
                            " and not " + std::string(name_of(directions.symmetry)) +
                            ", as the table will claim");
        settings_.checkpoint = output_;
        settings_.checkpoint += ".checkpoint";
        scene::prepare_output_file(output_, {".csv"});
        if (settings_.resume && !fs::exists(settings_.checkpoint))
            console.warning("there is no " + settings_.checkpoint.string() + "; starting anew");
        const lab::FilamentRepeat repeat =
            lab::build_filaments(weave, {.wavelength_nm = wavelength_nm_});
        lab::Measurement measured = lab::measure(repeat, directions, settings_, console.progress());
        add_keys(measured, weave);
        write_reflectance_table(measured.table, output_);
        json_ ? print_json(measured) : print_text(measured);
        if (!measured.interrupted)
            return kDone;
        console.error("interrupted; --resume goes on from " + settings_.checkpoint.string());
        return kInterrupted;
    }

  private:
    lab::Directions read_directions(Symmetry symmetry) const {
        if (directions_ == "normal")
            return lab::normal_incidence(step_deg_.value_or(kNormalStep), symmetry);
        if (directions_ != "paper") {
            if (step_deg_)
                throw Error({"--step has no meaning for the directions of a table", "--step",
                             "expected --directions normal or paper"});
            return lab::directions_of(read_reflectance_table(directions_));
        }
        return step_deg_ ? lab::paper_directions(*step_deg_, phi_step(*step_deg_))
                         : lab::paper_directions();
    }

    // Nothing that changes from run to run: equal calls give equal files.
    void add_keys(lab::Measurement &measured, const lab::Weave &weave) const {
        std::map<std::string, std::string> &keys = measured.table.keys;
        keys["instrument"] = "virtual goniometer";
        keys["material"] = weave.name;
        std::uint64_t photons = 0;
        for (const lab::LightReport &light : measured.lights)
            photons += light.photons;
        std::ostringstream text;
        text << "simulated from " << weave_ << "; " << photons << " photons for "
             << measured.lights.size() << " directions of light; seed " << settings_.seed << "; "
             << wavelength_nm_ << " nm";
        keys["provenance"] = text.str();
    }

    static double rate(const lab::Measurement &measured) {
        return measured.seconds > 0 ? static_cast<double>(measured.photons) / measured.seconds : 0;
    }

    static void print_text(const lab::Measurement &measured) {
        std::cout << "theta_i_deg  phi_i_deg      photons  reflected   +-     transmitted   +-     "
                     "relative_error\n"
                  << std::fixed;
        for (const lab::LightReport &light : measured.lights)
            std::cout << std::setprecision(1) << std::setw(11) << degrees_of(light.theta_i)
                      << std::setw(11) << degrees_of(light.phi_i) << std::setw(13) << light.photons
                      << std::setprecision(5) << std::setw(11) << light.reflected << std::setw(9)
                      << light.reflected_sigma << std::setw(12) << light.transmitted << std::setw(9)
                      << light.transmitted_sigma << std::setw(14) << light.relative_error << "\n";
        std::cout << measured.photons << " photons, " << measured.rays << " rays, "
                  << std::setprecision(1) << measured.seconds << " s, " << std::setprecision(3)
                  << rate(measured) * 1e-6 << " million photons/s\n";
    }

    void print_json(const lab::Measurement &measured) const {
        Json json{{"schema", "tsuya-fabric-simulate 1"}, {"table", output_.string()},
                  {"photons", measured.photons},         {"rays", measured.rays},
                  {"seconds", measured.seconds},         {"photons_per_second", rate(measured)},
                  {"interrupted", measured.interrupted}, {"lights", Json::array()}};
        for (const lab::LightReport &light : measured.lights)
            json["lights"].push_back({{"theta_i_deg", degrees_of(light.theta_i)},
                                      {"phi_i_deg", degrees_of(light.phi_i)},
                                      {"photons", light.photons},
                                      {"reflected", light.reflected},
                                      {"reflected_sigma", light.reflected_sigma},
                                      {"transmitted", light.transmitted},
                                      {"transmitted_sigma", light.transmitted_sigma},
                                      {"relative_error", light.relative_error}});
        std::cout << json.dump(2) << "\n";
    }

    CLI::App &app_;
    std::string weave_{}, directions_ = "normal";
    fs::path output_{};
    std::optional<double> step_deg_{};
    double wavelength_nm_ = 589;
    lab::GoniometerSettings settings_{};
    bool json_ = false;
};

} // namespace

std::unique_ptr<Command> make_fabric_simulate(CLI::App &fabric) {
    return std::make_unique<SimulateCommand>(fabric);
}

} // namespace tsuya::program
