#include "tsuya/lab/plan.h"

#include "json_line.h"
#include "tsuya/sdk/file.h"

#include <cmath>

namespace tsuya::lab {
namespace {

constexpr const char *kSchema = "tsuya-plan 1";
constexpr double kLongest = 86400; // seconds of an exposure
const std::vector<std::string> kKinds{"cloth", "white", "dark", "trap"};
const std::vector<std::string> kWhites{"each-light", "each-view"};

/// Degrees without the rounding of radians: 45 and not 45.00000000000001.
double degrees_of(double angle) { return std::round(angle / kDegree * 1e9) / 1e9; }

void add_directions(JsonTree &line, const DirectionPair &pair) {
    line["theta_i_deg"] = degrees_of(pair.theta_i);
    line["phi_i_deg"] = degrees_of(pair.phi_i);
    line["theta_r_deg"] = degrees_of(pair.theta_r);
    line["phi_r_deg"] = degrees_of(pair.phi_r);
}

DirectionPair take_directions(JsonLine &line) {
    const auto theta = [&](const char *key) { return line.number(key, 0, 90) * kDegree; };
    const auto phi = [&](const char *key) { return line.number(key, -360, 360) * kDegree; };
    return {.theta_i = theta("theta_i_deg"),
            .phi_i = phi("phi_i_deg"),
            .theta_r = theta("theta_r_deg"),
            .phi_r = phi("phi_r_deg")};
}

JsonTree line_of(const LeftOut &left_out) {
    JsonTree line{{"left_out", left_out.why}};
    add_directions(line, left_out.directions);
    return line;
}

JsonTree line_of(const PlannedFrame &frame, std::size_t number) {
    JsonTree line{{"frame", number}, {"kind", name_of(frame.kind)}, {"view", frame.view}};
    add_directions(line, frame.directions);
    line["exposure_s"] = frame.exposure_s;
    return line;
}

PlannedFrame take_frame(JsonLine &line, const std::vector<PlannedFrame> &before) {
    if (const std::size_t number = line.count("frame"); number != before.size())
        line.fail("the frame has the number " + std::to_string(number),
                  "expected " + std::to_string(before.size()));
    PlannedFrame frame{.kind = static_cast<FrameKind>(line.choice("kind", kKinds)),
                       .view = line.count("view"),
                       .directions = take_directions(line),
                       .exposure_s = line.number("exposure_s", 1e-6, kLongest)};
    const std::size_t last = before.empty() ? 0 : before.back().view;
    if (frame.view != last && frame.view != last + 1)
        line.fail("the view has the number " + std::to_string(frame.view),
                  "expected " + std::to_string(last) + " or the next");
    return frame;
}

void take_head(JsonLine line, Plan &plan) {
    if (const std::string schema = line.text("schema"); schema != kSchema)
        line.fail("the schema is '" + schema + "'", std::string("expected ") + kSchema);
    plan.symmetry = static_cast<Symmetry>(line.choice("symmetry", symmetry_names()));
    plan.white = static_cast<WhiteUse>(line.choice("white", kWhites));
    plan.views = line.text("views");
    plan.rig = line.text("rig");
    plan.rig_hash = line.text("rig_hash");
    line.finish();
}

void take_line(JsonLine line, Plan &plan) {
    if (line.has("left_out"))
        plan.left_out.push_back(
            {.directions = take_directions(line), .why = line.text("left_out")});
    else
        plan.frames.push_back(take_frame(line, plan.frames));
    line.finish();
}

} // namespace

const char *name_of(FrameKind kind) { return kKinds[static_cast<std::size_t>(kind)].c_str(); }

std::string reason_of(const LeftOut &left_out) {
    return left_out.why.substr(0, left_out.why.find(':'));
}

Plan read_plan(const std::filesystem::path &file) {
    const std::string text = read_file(file);
    const TextLines lines = lines_of(text);
    Plan plan;
    Problems problems;
    for (std::size_t i = 0; i < lines.whole.size() && !problems.full(); ++i) {
        const std::string where = file.string() + ":" + std::to_string(i + 1);
        try {
            if (i == 0)
                take_head({lines.whole[i], where}, plan);
            else
                take_line({lines.whole[i], where}, plan);
        } catch (const Error &error) {
            problems.add(error);
            if (i == 0)
                break; // no plan: each of its lines would be a problem
        }
    }
    problems.need(lines.rest.empty(), "the last line is cut off", file.string(),
                  "expected a whole plan");
    problems.need(!plan.frames.empty() || !problems.empty(), "the plan has no frame", file.string(),
                  "expected at least one");
    problems.throw_if_any();
    return plan;
}

std::string plan_text(const Plan &plan) {
    std::string text = JsonTree{{"schema", kSchema},
                                {"symmetry", name_of(plan.symmetry)},
                                {"white", kWhites[static_cast<std::size_t>(plan.white)]},
                                {"views", plan.views},
                                {"rig", plan.rig.string()},
                                {"rig_hash", plan.rig_hash}}
                           .dump() +
                       "\n";
    for (const LeftOut &left_out : plan.left_out)
        text += line_of(left_out).dump() + "\n";
    for (std::size_t i = 0; i < plan.frames.size(); ++i)
        text += line_of(plan.frames[i], i).dump() + "\n";
    return text;
}

void write_plan(const Plan &plan, const std::filesystem::path &file) {
    write_file(file, plan_text(plan));
}

} // namespace tsuya::lab
