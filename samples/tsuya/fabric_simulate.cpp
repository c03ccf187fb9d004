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
#include "look_options.h"
#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/reflectance_file.h"
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

struct FabricSimulate final : Command {
    std::string weave_name{}, directions_name = "normal";
    fs::path output{};
    std::optional<double> step_deg{};
    double wavelength_nm = 589;
    std::string part = "all";
    lab::GoniometerSettings settings{};
    bool json = false;

    void options(Options &o) override {
        o.argument(&weave_name, "WEAVE", "WEAVE.toml, DRAFT.wif or a preset")
            .required()
            .check([this] { check_weave_name(weave_name); });
        o.option("-o,--output", &output, "TABLE.csv", "simulated reflectance")
            .required()
            .result({".csv"});
        o.option("--directions", &directions_name, "SET",
                 "directions of light and view: normal, light along the normal; paper, the set of "
                 "Takeda et al.; or a table of reflectance, for its directions")
            .one_of({"normal", "paper"})
            .or_file();
        o.option("--step", &step_deg, "DEGREES",
                 "angle between views: 5 for normal; 3 for paper (theta; about 5/3 of it in phi)")
            .range(0.5, 45)
            .check([this] {
                if (step_deg && directions_name != "normal" && directions_name != "paper")
                    throw Error(Problem{"it has no meaning for the directions of a table", "",
                                        "expected --directions normal or paper"});
            });
        o.option("--photons", &settings.photons, "N", "most photons for a direction of light")
            .range(1, static_cast<double>(std::uint64_t{1} << 40));
        o.option("--error", &settings.error, "E",
                 "trace photons until the relative standard error is below E")
            .range(1e-6, 1);
        o.option("--time", &settings.seconds, "S", "trace photons for S seconds").range(1e-3, 1e6);
        o.option("--part", &part, "PART",
                 "light to measure: surface never entered a filament, body has been in one")
            .one_of({"all", "surface", "body"});
        o.option("--wavelength", &wavelength_nm, "NM",
                 "wavelength in nanometres, for the refractive index and the dye")
            .range(380, 780);
        o.option("--seed", &settings.seed, "N", "random seed");
        add_threads(o, settings.threads);
        o.flag("--resume", &settings.resume, "go on from TABLE.csv.checkpoint");
        o.flag("--json", &json, "print the report as JSON");
        o.example("tsuya fabric simulate \"polyester taffeta\" -o taffeta.csv");
        o.notes("`tsuya list weaves` names the presets. An interrupted measurement leaves what it "
                "has in TABLE.csv, and TABLE.csv.checkpoint for --resume.");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        const lab::Weave weave = weave_named(weave_name);
        const Symmetry symmetry = lab::symmetry_of(weave);
        const Directions directions = read_directions(symmetry);
        if (directions.symmetry > symmetry)
            console.warning(weave_name + ": its symmetry is " + std::string(name_of(symmetry)) +
                            " and not " + std::string(name_of(directions.symmetry)) +
                            ", as the table will claim");
        settings.part = part == "surface" ? lab::LightPart::surface
                        : part == "body"  ? lab::LightPart::body
                                          : lab::LightPart::all;
        settings.checkpoint = output;
        settings.checkpoint += ".checkpoint";
        scene::prepare_output_file(output);
        if (settings.resume && !fs::exists(settings.checkpoint))
            console.warning("there is no " + settings.checkpoint.string() + "; starting anew");
        const lab::FilamentRepeat repeat =
            lab::build_filaments(weave, {.wavelength_nm = wavelength_nm});
        lab::Measurement measured = lab::measure(repeat, directions, settings, console.progress());
        add_keys(measured, weave);
        refuse_nothing(measured);
        warn_of_unmeasured(measured, console);
        write_reflectance_table(measured.table, output);
        json ? print_json(measured) : print_text(measured);
        if (!measured.interrupted) {
            fs::remove(settings.checkpoint); // only now of no more use
            return kDone;
        }
        console.error("interrupted; --resume goes on from " + settings.checkpoint.string());
        return kInterrupted;
    }

    Directions read_directions(Symmetry symmetry) const {
        if (directions_name == "normal")
            return normal_incidence(step_deg.value_or(kNormalStep), symmetry);
        if (directions_name != "paper")
            return directions_of(read_reflectance_table(directions_name));
        return step_deg ? paper_directions(*step_deg, phi_step(*step_deg)) : paper_directions();
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
        text << "simulated from " << weave_name << "; " << photons << " photons for "
             << measured.lights.size() << " directions of light; seed " << settings.seed << "; "
             << wavelength_nm << " nm";
        if (part != "all")
            text << "; " << part << " part";
        keys["provenance"] = text.str();
    }

    void refuse_nothing(const lab::Measurement &measured) const {
        if (!measured.table.rows.empty())
            return;
        if (measured.interrupted)
            throw Interrupted("interrupted; --resume goes on from " + settings.checkpoint.string());
        throw Error({"no direction of light got a photon", "--time", "expected more seconds"});
    }

    /// Where the time was over, or the run was stopped, before a light had its turn.
    static void warn_of_unmeasured(const lab::Measurement &measured, Console &console) {
        const auto without = static_cast<std::size_t>(
            std::count_if(measured.lights.begin(), measured.lights.end(),
                          [](const lab::LightReport &light) { return light.photons == 0; }));
        if (without > 0)
            console.warning({detail::counted(without, "direction") +
                                 " of light without a photon left out of the table",
                             "", "expected a longer --time, or --resume"});
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
        std::cout << detail::counted(measured.photons, "photon") << ", "
                  << detail::counted(measured.rays, "ray") << ", " << std::setprecision(1)
                  << measured.seconds << " s, " << std::setprecision(3) << rate(measured) * 1e-6
                  << " million photons/s\n";
    }

    void print_json(const lab::Measurement &measured) const {
        Json numbers{{"schema", "tsuya-fabric-simulate 1"}, {"table", output.string()},
                     {"photons", measured.photons},         {"rays", measured.rays},
                     {"seconds", measured.seconds},         {"photons_per_second", rate(measured)},
                     {"interrupted", measured.interrupted}, {"lights", Json::array()}};
        for (const lab::LightReport &light : measured.lights)
            numbers["lights"].push_back({{"theta_i_deg", degrees_of(light.theta_i)},
                                         {"phi_i_deg", degrees_of(light.phi_i)},
                                         {"photons", light.photons},
                                         {"reflected", light.reflected},
                                         {"reflected_sigma", light.reflected_sigma},
                                         {"transmitted", light.transmitted},
                                         {"transmitted_sigma", light.transmitted_sigma},
                                         {"relative_error", light.relative_error}});
        std::cout << numbers.text() << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_fabric_simulate() { return std::make_unique<FabricSimulate>(); }

} // namespace tsuya::program
