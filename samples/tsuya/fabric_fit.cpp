// tsuya fabric fit: a few measured views to a fabric.

#include <cmath>
#include <iomanip>
#include <iostream>
#include <numbers>

#include <nlohmann/json.hpp>

#include "command.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/feature_points.h"

namespace tsuya::program {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class FitCommand final : public Command {
  public:
    explicit FitCommand(CLI::App &fabric)
        : fit_(*fabric.add_subcommand("fit", "From a few measured views to a fabric")) {
        fit_.footer("Example:\n  tsuya fabric fit black_satin.csv -o black_satin.fabric.toml\n"
                    "The rows with theta_i = 0 are fitted; the residual of each is printed.");
        fit_.add_option("table", table_, "TABLE.csv of reflectance")->required();
        fit_.add_option("-o,--output", output_, "F.fabric.toml")->required();
        fit_.add_option("--name", name_, "Of the fabric; the file's, if not given");
        fit_.add_option("--f0", f0_, "Reflectance of the fibre at normal incidence")
            ->check(CLI::Range(1e-6, 1.0));
        fit_.add_flag("--json", json_, "Residuals as JSON");
    }

    bool called() const override { return fit_.parsed(); }

    Status run(Console &console) override {
        const ReflectanceTable table = read_reflectance_table(table_);
        if (!table.symmetry_declared)
            console.warning(table_.string() +
                            ": the symmetry is not declared, orthotropic is assumed; "
                            "declare it by a line such as `# symmetry: half-turn`");
        Fabric fabric{.name = name_.empty() ? table_.stem().string() : name_, .keys = table.keys};
        fabric.bard = Bard::fit(table, table_.string());
        if (f0_ > 0)
            fabric.f0 = f0_;
        resolve(fabric, "fabric");
        scene::prepare_output_file(output_, {".toml"});
        write_fabric(fabric, output_);
        const double f0 = fabric.bard->peak() > 0 ? f0_of(fabric, "fabric") : 1;
        json_ ? print_json(*fabric.bard, f0) : print_text(*fabric.bard, f0);
        for (const BardView &view : misfits(*fabric.bard))
            console.warning(table_.string() + ": the view at theta " +
                            std::to_string(std::lround(view.theta / kDegree)) + ", phi " +
                            std::to_string(std::lround(view.phi / kDegree)) +
                            " degrees does not fit the others: measured " +
                            std::to_string(view.brdf_per_sr) + ", fitted " +
                            std::to_string(view.fitted_per_sr) + " 1/sr");
        return kDone;
    }

  private:
    static double log_ratio(const BardView &view) {
        return std::log10(view.fitted_per_sr / view.brdf_per_sr);
    }

    static void print_text(const Bard &bard, double f0) {
        std::cout << "theta_deg  phi_deg  measured_per_sr  fitted_per_sr  log10_ratio\n";
        std::cout << std::fixed;
        for (const BardView &view : bard.views())
            std::cout << std::setprecision(1) << std::setw(9) << view.theta / kDegree
                      << std::setw(9) << view.phi / kDegree << std::setprecision(6) << std::setw(17)
                      << view.brdf_per_sr << std::setw(15) << view.fitted_per_sr
                      << std::setprecision(5) << std::setw(13) << log_ratio(view) << "\n";
        std::cout << "views " << bard.views().size() << ", symmetry " << name_of(bard.symmetry())
                  << ", rms of log10 ratio " << bard.residual() << ", asymmetry "
                  << bard.asymmetry() << "\n"
                  << "facets are shown up to a tilt of " << std::setprecision(1)
                  << shown_tilt(bard) / kDegree << " degrees\n"
                  << "point  theta_deg  phi_deg  brdf_per_sr  facets_per_sr\n";
        for (const FeaturePoint &p : feature_points(bard, f0))
            std::cout << std::setw(5) << p.name << std::setprecision(1) << std::setw(11)
                      << p.theta / kDegree << std::setw(9) << p.phi / kDegree
                      << std::setprecision(6) << std::setw(13) << p.brdf_per_sr << std::setw(15)
                      << p.facets_per_sr << (p.extrapolated ? "  extrapolated" : "") << "\n";
    }

    static void print_json(const Bard &bard, double f0) {
        nlohmann::ordered_json json{{"schema", "tsuya-fabric-fit 1"},
                                    {"symmetry", name_of(bard.symmetry())},
                                    {"residual", bard.residual()},
                                    {"asymmetry", bard.asymmetry()},
                                    {"shown_tilt_deg", shown_tilt(bard) / kDegree},
                                    {"feature_points", nlohmann::ordered_json::array()},
                                    {"misfits", nlohmann::ordered_json::array()},
                                    {"views", nlohmann::ordered_json::array()}};
        for (const FeaturePoint &p : feature_points(bard, f0))
            json["feature_points"].push_back({{"name", p.name},
                                              {"theta_deg", p.theta / kDegree},
                                              {"phi_deg", p.phi / kDegree},
                                              {"brdf_per_sr", p.brdf_per_sr},
                                              {"facets_per_sr", p.facets_per_sr},
                                              {"extrapolated", p.extrapolated}});
        for (const BardView &view : misfits(bard))
            json["misfits"].push_back(
                {{"theta_deg", view.theta / kDegree}, {"phi_deg", view.phi / kDegree}});
        for (const BardView &view : bard.views())
            json["views"].push_back({{"theta_deg", view.theta / kDegree},
                                     {"phi_deg", view.phi / kDegree},
                                     {"brdf_per_sr", view.brdf_per_sr},
                                     {"fitted_per_sr", view.fitted_per_sr},
                                     {"log10_ratio", log_ratio(view)}});
        std::cout << json.dump(2) << "\n";
    }

    CLI::App &fit_;
    std::filesystem::path table_{}, output_{};
    std::string name_{};
    double f0_ = 0;
    bool json_ = false;
};

} // namespace

std::unique_ptr<Command> make_fabric_fit(CLI::App &fabric) {
    return std::make_unique<FitCommand>(fabric);
}

} // namespace tsuya::program
