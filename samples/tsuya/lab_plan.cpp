// tsuya lab plan: every frame of a capture session, in order.

#include <iomanip>
#include <iostream>
#include <map>
#include <utility>

#include "command.h"
#include "json.h"
#include "tsuya/lab/planning.h"
#include "tsuya/lab/session_pictures.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

const std::vector<std::string> kWhites{"each-light", "each-view"};

struct LabPlan final : Command {
    std::filesystem::path rig_file{}, output{}, picture{};
    std::string views = "few:5", white = "each-light";
    std::optional<std::string> symmetry{};
    int white_every = 50;
    bool json = false;

    void options(Options &o) override {
        o.argument(&rig_file, "RIG.toml", "rig file").required();
        o.option("-o,--output", &output, "PLAN.jsonl", "plan of the session")
            .required()
            .result({".jsonl"});
        o.option("--views", &views, "VIEWS",
                 "directions to measure: few:STEP, views every STEP degrees (0.5 to 90), light "
                 "along the normal; paper, the set of Takeda et al.; or a table of reflectance, "
                 "for its directions")
            .or_file()
            .check([this] { lab::check_views_name(views); });
        o.option("--symmetry", &symmetry, "S",
                 "symmetry of the cloth, whose repeated views few:STEP leaves out; without it, "
                 "half-turn for few:STEP, none for paper, and that of a table")
            .one_of(symmetry_names());
        o.option("--white", &white, "USE",
                 "white standard: at one view for each direction of light, or at each view")
            .one_of(kWhites);
        o.option("--white-every", &white_every, "N", "views between white frames").range(1, 1e4);
        o.option("--picture", &picture, "PLAN.svg",
                 "the views on the hemisphere, in their order, with those that are left out")
            .result({".svg"});
        o.flag("--json", &json, "print the report as JSON");
        o.example("tsuya lab plan ogm.rig.toml --views few:5 -o satin.plan.jsonl");
        o.notes("Views that the rig cannot take are left out; the plan names each with its "
                "reason.");
    }

    Status run(Console &) override {
        scene::check_output_file(output);
        if (!picture.empty())
            scene::check_output_file(picture);
        const lab::RigFile rig = lab::read_rig_file(rig_file);
        const Directions directions =
            lab::views_named(views, symmetry_named(symmetry.value_or("")));
        const lab::Plan plan =
            lab::make_plan(rig, {.directions = directions,
                                 .views = views,
                                 .rig = std::filesystem::absolute(rig_file).lexically_normal(),
                                 .white = white == kWhites[0] ? lab::WhiteUse::each_light
                                                              : lab::WhiteUse::each_view,
                                 .white_every = static_cast<std::size_t>(white_every)});
        scene::prepare_output_file(output);
        lab::write_plan(plan, output);
        if (!picture.empty()) {
            scene::prepare_output_file(picture);
            write_file(picture, lab::plan_picture(plan));
        }
        const lab::PlanEstimate sum = lab::estimate(plan, rig);
        if (json)
            print_json(directions, plan, sum);
        else
            print(directions, plan, sum);
        return kDone;
    }

    /// How many views are left out for each reason, of which the numbers are left out.
    static std::map<std::string, std::size_t> reasons(const lab::Plan &plan) {
        std::map<std::string, std::size_t> counts;
        for (const lab::LeftOut &left_out : plan.left_out)
            ++counts[lab::reason_of(left_out)];
        return counts;
    }

    static std::map<std::string, std::size_t> kinds(const lab::Plan &plan) {
        std::map<std::string, std::size_t> counts;
        for (const lab::PlannedFrame &frame : plan.frames)
            ++counts[lab::name_of(frame.kind)];
        return counts;
    }

    /// How many views of the cloth are planned, each in all exposures.
    static std::size_t planned(const lab::Plan &plan) {
        std::size_t count = 0, view = SIZE_MAX;
        for (const lab::PlannedFrame &frame : plan.frames)
            if (frame.kind == lab::FrameKind::cloth &&
                frame.view != std::exchange(view, frame.view))
                ++count;
        return count;
    }

    /// What was asked for, and what becomes of it.
    void print_views(const Directions &directions, const lab::Plan &plan) const {
        std::cout << views << ": " << detail::counted(directions.pairs.size(), "view")
                  << " of the cloth";
        if (directions.repeated > 0)
            std::cout << ", distinct ones of " << directions.pairs.size() + directions.repeated;
        const std::size_t taken = planned(plan), left_out = plan.left_out.size();
        if (taken + left_out < directions.pairs.size())
            std::cout << ", " << directions.pairs.size() - taken - left_out
                      << " of them given more than once";
        std::cout << "; " << taken << " planned, " << left_out << " left out";
        const char *separator = ": ";
        for (const auto &[reason, count] : reasons(plan))
            std::cout << std::exchange(separator, ", ") << reason << " " << count;
        std::cout << "\n";
    }

    void print(const Directions &directions, const lab::Plan &plan,
               const lab::PlanEstimate &sum) const {
        print_views(directions, plan);
        std::cout << detail::counted(sum.frames, "frame") << ":";
        for (const auto &[kind, count] : kinds(plan))
            std::cout << " " << kind << " " << count;
        std::cout << "\nmoves:";
        for (std::size_t i = 0; i < lab::kAxes; ++i)
            std::cout << " " << lab::name_of(static_cast<lab::AxisName>(i)) << " " << sum.moves[i];
        std::cout << ", changes of the sample " << sum.sample_changes << "\n"
                  << std::fixed << std::setprecision(1) << "time " << sum.time.count() / 3600
                  << " h, strikes of the lamp " << sum.strikes << ", disk " << sum.disk_mb / 1000
                  << " GB\n"
                  << output.string() << "\n";
    }

    static void print_json(const Directions &directions, const lab::Plan &plan,
                           const lab::PlanEstimate &sum) {
        Json report{{"schema", "tsuya-lab-plan 1"},
                    {"asked", directions.pairs.size()},
                    {"repeated", directions.repeated},
                    {"planned", planned(plan)},
                    {"frames", sum.frames},
                    {"views", sum.views},
                    {"kinds", Json::object()},
                    {"left_out", plan.left_out.size()},
                    {"left_out_for", Json::object()},
                    {"moves", Json::object()},
                    {"sample_changes", sum.sample_changes},
                    {"strikes", sum.strikes},
                    {"time_s", sum.time.count()},
                    {"disk_mb", sum.disk_mb}};
        for (const auto &[kind, count] : kinds(plan))
            report["kinds"][kind] = count;
        for (const auto &[reason, count] : reasons(plan))
            report["left_out_for"][reason] = count;
        for (std::size_t i = 0; i < lab::kAxes; ++i)
            report["moves"][lab::name_of(static_cast<lab::AxisName>(i))] = sum.moves[i];
        std::cout << report.text() << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_lab_plan() { return std::make_unique<LabPlan>(); }

} // namespace tsuya::program
