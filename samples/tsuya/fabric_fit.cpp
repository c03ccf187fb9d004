// tsuya fabric fit: a few measured views to a fabric.

#include <cmath>
#include <iomanip>
#include <iostream>

#include "command.h"
#include "json.h"
#include "table_input.h"
#include "tsuya/color/upsample.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/dye_separation.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/feature_points.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

struct FabricFit final : Command {
    std::filesystem::path table_file{}, output{};
    std::string name{}, use = "normal";
    std::string lustre{kLustreNames[0]};
    std::optional<double> f0{};
    bool json = false;

    void options(Options &o) override {
        o.argument(&table_file, "TABLE.csv", "measured reflectance").required();
        o.option("-o,--output", &output, "F.fabric.toml", "the fabric").required().result();
        o.option("--name", &name, "NAME", "name of the fabric; without it, that of the table");
        o.option("--f0", &f0, "F0", "reflectance of the fibre at normal incidence").range(1e-6, 1);
        o.option(
             "--use", &use, "ROWS",
             "rows that are fitted: normal, those with theta_i = 0; all, for the model yarn the "
             "others too")
            .one_of({"normal", "all"});
        o.option("--lustre", &lustre, "LUSTRE",
                 "delustrant in the filaments, as it shows when the cloth is dyed: bright, none; "
                 "semi-dull; dull")
            .one_of(std::vector<std::string>(kLustreNames.begin(), kLustreNames.end()));
        o.flag("--json", &json, "print the residuals as JSON");
        o.example("tsuya fabric fit black_satin.csv -o black_satin.fabric.toml");
        o.notes("TABLE.csv has the columns theta_i_deg, phi_i_deg (towards the light), "
                "theta_r_deg, phi_r_deg (towards the viewer), brdf_per_sr (without the cosine) and "
                "optionally sigma_per_sr (its standard error). theta is counted from the normal, "
                "phi from the weft. A line `# symmetry: orthotropic`, `half-turn` or `none` before "
                "them declares the symmetry. Columns brdf_r, brdf_g, brdf_b or such as brdf_550nm "
                "in place of brdf_per_sr are those of a dyed cloth, whose dye is told apart.\n"
                "The residual of each fitted row is printed. Rows under oblique light are compared "
                "with the fabric's model; --use all fits the model yarn to them as well.");
    }

    Status run(Console &console) override {
        scene::check_output_file(output, {".toml"});
        const ReflectanceFile read = read_table(table_file, console);
        const Progress progress = console.progress();
        const std::optional<DyedCloth> dyed = separated(read, progress);
        const ReflectanceTable &table = dyed ? dyed->surface : read.channels.front().table;
        if (!table.symmetry_declared)
            console.warning(table_file.string() +
                            ": the symmetry is not declared, orthotropic is assumed; "
                            "declare it by a line such as `# symmetry: half-turn`");
        const CarriedViews views{.bard = Bard::fit(table, table_file.string(), progress), .f0 = f0};
        const Bard &bard = views.bard;
        Fabric fabric{.name = name.empty() ? table_file.stem().string() : name,
                      .keys = table.keys,
                      .specular = views};
        fabric.colours.lustre = lustre_named(lustre, "");
        if (dyed)
            fabric.colours.dye = spectrum_of(read, dyed->reflectance);
        Report report{.bard = bard, .channels = body_of(read, dyed)};
        if (use == "all") {
            if (const auto brdf = make_brdf(fabric, "fabric", progress))
                report.before = oblique(table, *brdf, progress);
            report.yarn = fit_yarn_lobes(bard, table, f0.value_or(YarnLobes{}.f0),
                                         table_file.string(), progress);
            fabric.specular = *report.yarn;
            fabric.spare = {views};
        }
        if (const Material material = resolve(fabric, "fabric", progress); material.specular)
            report.after = oblique(table, *material.specular, progress);
        report.f0 = bard.peak() > 0 ? f0_of(views) : 1;
        scene::prepare_output_file(output, {".toml"});
        write_fabric(fabric, output);
        json ? print_json(report) : print_text(report);
        warn(report, console);
        return kDone;
    }

    // None where the table has no channels.
    std::optional<DyedCloth> separated(const ReflectanceFile &read,
                                       const Progress &progress) const {
        if (read.channels.size() == 1)
            return std::nullopt;
        if (use == "all")
            throw Error({"--use all has no meaning for a table with channels", table_file.string(),
                         "expected one column of values, brdf_per_sr"});
        return separate_dye(read, table_file.string(), f0, progress);
    }

    // Of a value a channel: at wavelengths, or a smooth one of the colour.
    Spectrum spectrum_of(const ReflectanceFile &read, const std::vector<double> &value) const {
        if (read.channels.front().wavelength_nm) {
            Spectrum spectrum{{}, value};
            for (const TableChannel &channel : read.channels)
                spectrum.wavelength_nm.push_back(*channel.wavelength_nm);
            return spectrum;
        }
        glm::dvec3 colour{0};
        for (std::size_t c = 0; c < value.size(); ++c)
            colour[static_cast<int>(std::string_view("rgb").find(read.channels[c].name))] =
                value[c];
        return reflectance_of_srgb(colour, table_file.string());
    }

    // A channel of a dyed cloth: what its body reflects.
    struct Channel {
        std::string name{};
        double reflectance = 0;
    };
    static std::vector<Channel> body_of(const ReflectanceFile &read,
                                        const std::optional<DyedCloth> &dyed) {
        std::vector<Channel> channels;
        for (std::size_t c = 0; dyed && c < read.channels.size(); ++c)
            channels.push_back({read.channels[c].name, dyed->reflectance[c]});
        return channels;
    }

    // Views under oblique light beside a model.
    struct Oblique {
        std::vector<ModelledView> views{};
        std::size_t lights = 0;
        double l2_cos = 0; // mean of the lights
    };
    struct Report {
        const Bard &bard;
        std::vector<Channel> channels{};
        double f0 = 1;
        std::optional<YarnLobes> yarn{}; // fitted to oblique light too
        Oblique before{}, after{};
    };

    static Oblique oblique(const ReflectanceTable &table, const Brdf &brdf,
                           const Progress &progress) {
        const BrdfFunction f = [&](const glm::dvec3 &l, const glm::dvec3 &v) {
            return static_cast<double>(brdf.evaluate(glm::vec3(l), glm::vec3(v)));
        };
        Oblique found{.views = oblique_views(table, f)};
        ReflectanceTable rows{.symmetry = table.symmetry};
        for (const ModelledView &view : found.views)
            rows.rows.push_back(view.row);
        if (rows.rows.empty())
            return found;
        const Accuracy accuracy = measure_accuracy(rows, f, progress);
        found.lights = accuracy.directions.size();
        found.l2_cos = accuracy.mean.l2_cos.value_or(0);
        return found;
    }

    void warn(const Report &report, Console &console) const {
        const auto degrees = [](double angle) {
            return std::to_string(std::lround(angle / kDegree));
        };
        const auto say = [&](const std::string &view, double measured, double fitted) {
            console.warning(table_file.string() + ": the view at " + view +
                            " degrees does not fit the others: measured " +
                            std::to_string(measured) + ", fitted " + std::to_string(fitted) +
                            " 1/sr");
        };
        for (const BardView &view : misfits(report.bard))
            say("theta " + degrees(view.theta) + ", phi " + degrees(view.phi), view.brdf_per_sr,
                view.fitted_per_sr);
        if (report.yarn)
            for (const ModelledView &view : misfits(report.after.views))
                say("theta " + degrees(view.row.theta_r) + ", phi " + degrees(view.row.phi_r) +
                        " under light at theta_i " + degrees(view.row.theta_i) + ", phi_i " +
                        degrees(view.row.phi_i),
                    view.row.brdf_per_sr, view.fitted_per_sr);
    }

    // Not finite where one of the two is 0.
    static double log_ratio(double fitted, double measured) {
        return std::log10(fitted / measured);
    }

    static void print_text(const Report &report) {
        const Bard &bard = report.bard;
        std::cout << "theta_deg  phi_deg  measured_per_sr  fitted_per_sr  log10_ratio\n";
        std::cout << std::fixed;
        for (const BardView &view : bard.views())
            print_view(view.theta, view.phi, view.brdf_per_sr, view.fitted_per_sr);
        std::cout << "views " << bard.views().size() << ", symmetry " << name_of(bard.symmetry())
                  << ", rms of log10 ratio " << bard.residual() << ", asymmetry "
                  << bard.asymmetry() << "\n"
                  << "facets are shown up to a tilt of " << std::setprecision(1)
                  << shown_tilt(bard) / kDegree << " degrees\n"
                  << "point  theta_deg  phi_deg  brdf_per_sr  facets_per_sr\n";
        for (const FeaturePoint &p : feature_points(bard, report.f0))
            std::cout << std::setw(5) << p.name << std::setprecision(1) << std::setw(11)
                      << p.theta / kDegree << std::setw(9) << p.phi / kDegree
                      << std::setprecision(6) << std::setw(13) << p.brdf_per_sr << std::setw(15)
                      << p.facets_per_sr << (p.extrapolated ? "  extrapolated" : "") << "\n";
        for (const Channel &channel : report.channels)
            std::cout << std::setprecision(4) << "body of channel " << channel.name << ": reflects "
                      << channel.reflectance << "\n";
        print_oblique(report);
    }

    static void print_view(double theta, double phi, double measured, double fitted) {
        std::cout << std::setprecision(1) << std::setw(9) << theta / kDegree << std::setw(9)
                  << phi / kDegree << std::setprecision(6) << std::setw(17) << measured
                  << std::setw(15) << fitted << std::setprecision(5) << std::setw(13);
        if (const double ratio = log_ratio(fitted, measured); std::isfinite(ratio))
            std::cout << ratio << "\n";
        else
            std::cout << "-\n";
    }

    static void print_oblique(const Report &report) {
        if (report.after.views.empty())
            return;
        if (report.yarn) {
            std::cout << "theta_i_deg  phi_i_deg  theta_deg  phi_deg  measured_per_sr  "
                         "fitted_per_sr  log10_ratio\n";
            for (const ModelledView &view : report.after.views) {
                std::cout << std::setprecision(1) << std::setw(11) << view.row.theta_i / kDegree
                          << std::setw(11) << view.row.phi_i / kDegree << std::setw(2) << "";
                print_view(view.row.theta_r, view.row.phi_r, view.row.brdf_per_sr,
                           view.fitted_per_sr);
            }
        }
        std::cout << "oblique views " << report.after.views.size() << " under "
                  << report.after.lights << " lights, " << (report.yarn ? "" : "not ")
                  << "fitted: l2_cos " << std::setprecision(4) << report.after.l2_cos;
        if (report.yarn)
            std::cout << ", from above alone " << report.before.l2_cos << "; pits of weft "
                      << report.yarn->pit[0] << ", of warp " << report.yarn->pit[1];
        std::cout << "\n";
    }

    static void print_json(const Report &report) {
        const Bard &bard = report.bard;
        Json numbers{{"schema", "tsuya-fabric-fit 1"},
                     {"symmetry", name_of(bard.symmetry())},
                     {"residual", bard.residual()},
                     {"asymmetry", bard.asymmetry()},
                     {"shown_tilt_deg", shown_tilt(bard) / kDegree},
                     {"feature_points", Json::array()},
                     {"misfits", Json::array()},
                     {"views", Json::array()}};
        if (!report.channels.empty())
            numbers["body"] = Json::array();
        for (const FeaturePoint &p : feature_points(bard, report.f0))
            numbers["feature_points"].push_back({{"name", p.name},
                                                 {"theta_deg", p.theta / kDegree},
                                                 {"phi_deg", p.phi / kDegree},
                                                 {"brdf_per_sr", p.brdf_per_sr},
                                                 {"facets_per_sr", p.facets_per_sr},
                                                 {"extrapolated", p.extrapolated}});
        for (const BardView &view : misfits(bard))
            numbers["misfits"].push_back(
                {{"theta_deg", view.theta / kDegree}, {"phi_deg", view.phi / kDegree}});
        for (const BardView &view : bard.views())
            numbers["views"].push_back(
                {{"theta_deg", view.theta / kDegree},
                 {"phi_deg", view.phi / kDegree},
                 {"brdf_per_sr", view.brdf_per_sr},
                 {"fitted_per_sr", view.fitted_per_sr},
                 {"log10_ratio", log_ratio(view.fitted_per_sr, view.brdf_per_sr)}});
        if (!report.after.views.empty())
            numbers["oblique"] = json_of_oblique(report);
        for (const Channel &channel : report.channels)
            numbers["body"].push_back(
                {{"channel", channel.name}, {"reflectance", channel.reflectance}});
        std::cout << numbers.text() << "\n";
    }

    static Json json_of_oblique(const Report &report) {
        Json numbers{{"lights", report.after.lights},
                     {"fitted", report.yarn.has_value()},
                     {"l2_cos", report.after.l2_cos}};
        if (report.yarn)
            numbers.update({{"l2_cos_from_above", report.before.l2_cos},
                            {"pit_weft", report.yarn->pit[0]},
                            {"pit_warp", report.yarn->pit[1]}});
        numbers["views"] = Json::array();
        for (const ModelledView &view : report.after.views)
            numbers["views"].push_back(
                {{"theta_i_deg", view.row.theta_i / kDegree},
                 {"phi_i_deg", view.row.phi_i / kDegree},
                 {"theta_deg", view.row.theta_r / kDegree},
                 {"phi_deg", view.row.phi_r / kDegree},
                 {"brdf_per_sr", view.row.brdf_per_sr},
                 {"fitted_per_sr", view.fitted_per_sr},
                 {"log10_ratio", log_ratio(view.fitted_per_sr, view.row.brdf_per_sr)}});
        return numbers;
    }
};

} // namespace

std::unique_ptr<Command> make_fabric_fit() { return std::make_unique<FabricFit>(); }

} // namespace tsuya::program
