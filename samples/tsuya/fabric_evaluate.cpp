// tsuya fabric evaluate: how far the models of a fabric lie from a table.

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "table_input.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

constexpr int kWidth = 16;
constexpr double kAnyWavelength = 560; // in nanometres: the dye is the same at all

struct Result {
    std::string model;
    Accuracy accuracy;
};

struct FabricEvaluate final : Command {
    std::filesystem::path fabric_file{}, table_file{}, values_file{};
    std::string model_name{}, channel{}, part{};
    std::optional<double> reflectance{};
    bool json = false;

    void options(Options &o) override {
        o.argument(&fabric_file, "F.fabric.toml", "fabric").required();
        o.option("--against", &table_file, "TABLE.csv", "measured reflectance").required();
        o.option("--channel", &channel, "NAME",
                 "channel of TABLE.csv, such as r or 550nm, where it has several");
        o.option("--model", &model_name, "NAME",
                 "model, or all that the fabric has the data of; without it, the fabric's own")
            .one_of(model_choices("all"));
        o.option(
             "--reflectance", &reflectance, "R",
             "compare the dyed cloth whose coloured part reflects R at 8 degrees, specular part "
             "excluded")
            .range(0, 1);
        o.option("--part", &part, "PART",
                 "what to compare: surface, the specular part; body, the coloured part; all, both "
                 "(default all with --reflectance, else surface)")
            .one_of({"all", "surface", "body"})
            .check([this] {
                if (!part.empty() && part != "surface" && !reflectance)
                    throw Error(Problem{"the coloured part is compared for no reflectance", "",
                                        "expected --reflectance R"});
            });
        o.option("--values", &values_file, "VALUES.csv",
                 "file for every row of the table beside the models' values")
            .result({".csv"});
        o.flag("--json", &json, "print the error measures as JSON");
        o.example("tsuya fabric evaluate black_satin.fabric.toml --against black_satin.csv "
                  "--model all");
        o.notes(
            "Without --reflectance the specular part is "
            "compared, and not the fabric's own dye; `fabric fit` prints the R of each channel.");
    }

    Status run(Console &console) override {
        if (!values_file.empty())
            scene::check_output_file(values_file);
        const Progress progress = console.progress();
        if (part.empty())
            part = reflectance ? "all" : "surface";
        const Fabric fabric = read_fabric(fabric_file, progress);
        const ReflectanceTable table = read_channel(table_file, channel, console);
        const TableAccuracy against(table, progress);
        if (against.only_from_above())
            console.warning(table_file.string() +
                            ": all light is from straight above, where models that were fitted to "
                            "such views are better than under other light");
        if (fabric.colours.any_dye() && !reflectance)
            console.warning(fabric_file.string() + ": the fabric has a dye, which is not compared");
        std::vector<std::string> models{model_name.empty() ? std::string(model_of(fabric))
                                                           : model_name};
        if (model_name == "all")
            models = models_of(fabric);
        if (!values_file.empty())
            scene::prepare_output_file(values_file);
        std::vector<Result> results;
        std::vector<BrdfFunction> functions;
        for (const std::string &model : models) {
            functions.push_back(function_of(model, fabric, progress));
            results.push_back({model, against.of(functions.back(), progress)});
            progress("models",
                     static_cast<double>(results.size()) / static_cast<double>(models.size()));
        }
        if (!values_file.empty())
            write_values(table, models, functions);
        json ? print_json(results, against.only_from_above()) : print_text(results);
        return kDone;
    }

    // The parts that are compared.
    BrdfFunction function_of(const std::string &model, const Fabric &fabric,
                             const Progress &progress) const {
        if (part == "surface")
            return make_model(model, fabric, fabric_file.string(), progress);
        Fabric dyed = with_model(fabric, model, fabric_file.string());
        // Its surface without a tint, as it is compared; of other models no part follows yarns
        dyed.colours = {.dye = Spectrum::constant(*reflectance), .lustre = fabric.colours.lustre};
        if (model == "yarn")
            dyed.colours.delustre = fabric.colours.delustre;
        const Material material = resolve(dyed, fabric_file.string(), progress);
        BrdfFunction body = coloured_part(material, kAnyWavelength);
        if (part == "body" || !material.specular)
            return body;
        return [body, surface = *material.specular](const glm::dvec3 &l, const glm::dvec3 &v) {
            return body(l, v) + static_cast<double>(surface.evaluate(glm::vec3(l), glm::vec3(v)));
        };
    }

    void write_values(const ReflectanceTable &table, const std::vector<std::string> &models,
                      const std::vector<BrdfFunction> &functions) const {
        std::ostringstream out;
        out << "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";
        for (const std::string &model : models)
            out << "," << model;
        for (const ReflectanceRow &row : table.rows) {
            out << "\n"
                << degrees_of(row.theta_i) << "," << degrees_of(row.phi_i) << ","
                << degrees_of(row.theta_r) << "," << degrees_of(row.phi_r) << ","
                << row.brdf_per_sr;
            for (const BrdfFunction &function : functions)
                out << "," << function(row.to_light(), row.to_viewer());
        }
        out << "\n";
        write_file(values_file, out.str());
    }

    void print_json(const std::vector<Result> &results, bool only_from_above) const {
        Json numbers{{"schema", "tsuya-fabric-evaluate 1"},
                     {"fabric", fabric_file.string()},
                     {"table", table_file.string()},
                     {"only_light_from_above", only_from_above},
                     {"results", Json::array()}};
        if (!channel.empty())
            numbers["channel"] = channel;
        for (const Result &result : results) {
            Json directions = Json::array();
            for (const LightAccuracy &light : result.accuracy.directions) {
                Json direction{{"theta_i_deg", degrees_of(light.theta_i)},
                               {"phi_i_deg", degrees_of(light.phi_i)},
                               {"views", light.views}};
                direction.update(json_of(light.error));
                directions.push_back(std::move(direction));
            }
            numbers["results"].push_back({{"model", result.model},
                                          {"mean", json_of(result.accuracy.mean)},
                                          {"directions", std::move(directions)}});
        }
        std::cout << numbers.text() << "\n";
    }

    static void print_text(const std::vector<Result> &results) {
        for (const Result &result : results) {
            std::cout << result.model << "\n"
                      << "theta_i_deg  phi_i_deg  views";
            for (const NamedMeasure &measure : error_measures())
                std::cout << std::setw(kWidth) << measure.name;
            std::cout << "\n" << std::fixed;
            for (const LightAccuracy &light : result.accuracy.directions) {
                std::cout << std::setprecision(1) << std::setw(11) << degrees_of(light.theta_i)
                          << std::setw(11) << degrees_of(light.phi_i) << std::setw(7)
                          << light.views;
                print_measures(light.error);
            }
            std::cout << std::setw(29) << std::left << "mean" << std::right;
            print_measures(result.accuracy.mean);
        }
    }

    static void print_measures(const ErrorMeasures &error) {
        for (const NamedMeasure &measure : error_measures()) {
            std::ostringstream text;
            if (const auto &value = error.*measure.value)
                text << std::fixed << std::setprecision(4) << *value;
            else
                text << "-";
            std::cout << std::setw(kWidth) << text.str();
        }
        std::cout << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_fabric_evaluate() { return std::make_unique<FabricEvaluate>(); }

} // namespace tsuya::program
