// tsuya fabric evaluate: how far the models of a fabric lie from a table.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "command.h"
#include "json_file.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {
namespace {

constexpr int kWidth = 16;

struct Result {
    std::string model;
    Accuracy accuracy;
};

class EvaluateCommand final : public Command {
  public:
    explicit EvaluateCommand(CLI::App &fabric)
        : app_(*fabric.add_subcommand("evaluate", "How far a fabric lies from a table")) {
        app_.footer("Example:\n"
                    "  tsuya fabric evaluate black_satin.fabric.toml --against black_satin.csv "
                    "--model all\n"
                    "`tsuya list models` names the models. The dye has no part: only the specular "
                    "reflectance is compared.");
        app_.add_option("fabric", fabric_, "F.fabric.toml")->required();
        app_.add_option("--against", table_, "TABLE.csv of reflectance")->required();
        app_.add_option("--model", model_,
                        "A model, or all that the fabric has the data of; the fabric's own");
        app_.add_option("--values", values_,
                        "Also VALUES.csv: every row of the table beside the models' values");
        app_.add_flag("--json", json_, "As JSON");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        const Fabric fabric = read_fabric(fabric_);
        const ReflectanceTable table = read_reflectance_table(table_);
        if (std::any_of(fabric.dye.value.begin(), fabric.dye.value.end(),
                        [](double v) { return v > 0; }))
            console.warning(fabric_.string() + ": the fabric has a dye, which is not compared");
        std::vector<std::string> models{model_.empty() ? fabric.model : model_};
        if (model_ == "all") {
            models.clear();
            for (const ModelName &model : model_names())
                if (has_data_of(std::string(model.name), fabric))
                    models.emplace_back(model.name);
        }
        if (!values_.empty())
            scene::prepare_output_file(values_, {".csv"});
        std::vector<Result> results;
        std::vector<BrdfFunction> functions;
        for (const std::string &model : models) {
            functions.push_back(make_model(model, fabric, fabric_.string()));
            results.push_back({model, measure_accuracy(table, functions.back())});
        }
        if (!values_.empty())
            write_values(table, models, functions);
        json_ ? print_json(results) : print_text(results);
        return kDone;
    }

  private:
    void write_values(const ReflectanceTable &table, const std::vector<std::string> &models,
                      const std::vector<BrdfFunction> &functions) const {
        std::ostringstream out;
        out << "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";
        for (const std::string &model : models)
            out << "," << model;
        const auto direction = [](double theta, double phi) {
            return glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::max(std::cos(theta), 0.0));
        };
        for (const ReflectanceRow &row : table.rows) {
            out << "\n"
                << degrees_of(row.theta_i) << "," << degrees_of(row.phi_i) << ","
                << degrees_of(row.theta_r) << "," << degrees_of(row.phi_r) << ","
                << row.brdf_per_sr;
            for (const BrdfFunction &function : functions)
                out << ","
                    << function(direction(row.theta_i, row.phi_i),
                                direction(row.theta_r, row.phi_r));
        }
        out << "\n";
        write_file(values_, out.str());
    }

    void print_json(const std::vector<Result> &results) const {
        Json json{{"schema", "tsuya-fabric-evaluate 1"},
                  {"fabric", fabric_.string()},
                  {"table", table_.string()},
                  {"results", Json::array()}};
        for (const Result &result : results) {
            Json directions = Json::array();
            for (const LightAccuracy &light : result.accuracy.directions) {
                Json direction{{"theta_i_deg", degrees_of(light.theta_i)},
                               {"phi_i_deg", degrees_of(light.phi_i)},
                               {"views", light.views}};
                direction.update(json_of(light.error));
                directions.push_back(std::move(direction));
            }
            json["results"].push_back({{"model", result.model},
                                       {"mean", json_of(result.accuracy.mean)},
                                       {"directions", std::move(directions)}});
        }
        std::cout << json.dump(2) << "\n";
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

    CLI::App &app_;
    std::filesystem::path fabric_{}, table_{}, values_{};
    std::string model_{};
    bool json_ = false;
};

} // namespace

std::unique_ptr<Command> make_fabric_evaluate(CLI::App &fabric) {
    return std::make_unique<EvaluateCommand>(fabric);
}

} // namespace tsuya::program
