// tsuya lab measure: the pictures of a session become tables of reflectance.

#include <algorithm>
#include <iostream>

#include "command.h"
#include "json.h"
#include "same_file.h"
#include "tsuya/color/image_file.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/lab/session_page.h"
#include "tsuya/lab/session_pictures.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

double degrees_of(double angle) { return std::round(angle / kDegree * 1e6) / 1e6; }

Json json_of(const DirectionPair &at) {
    return {{"theta_i_deg", degrees_of(at.theta_i)},
            {"phi_i_deg", degrees_of(at.phi_i)},
            {"theta_r_deg", degrees_of(at.theta_r)},
            {"phi_r_deg", degrees_of(at.phi_r)}};
}

Json json_of(const lab::ChannelMeasurement &channel) {
    Json views = Json::array(), lamp = Json::array();
    for (const lab::MeasuredView &view : channel.views) {
        Json item = json_of(view.directions);
        item.update({{"view", view.view},
                     {"time_s", view.time_s},
                     {"brdf_per_sr", view.brdf_per_sr},
                     {"sigma_per_sr", view.sigma_per_sr()},
                     {"noise_per_sr", view.noise},
                     {"drift_per_sr", view.drift},
                     {"texture_per_sr", view.texture},
                     {"white_per_sr", view.white}});
        views.push_back(std::move(item));
    }
    for (const lab::LampCourse &course : channel.lamp)
        for (const lab::WhiteReading &reading : course.readings)
            lamp.push_back({{"theta_i_deg", degrees_of(course.theta_i)},
                            {"phi_i_deg", degrees_of(course.phi_i)},
                            {"time_s", reading.time_s},
                            {"dn_per_s", reading.rate},
                            {"sigma_dn_per_s", reading.sigma},
                            {"strike", reading.strike}});
    return {{"name", channel.name},
            {"flicker", channel.flicker},
            {"white", std::move(lamp)},
            {"views", std::move(views)}};
}

struct LabMeasure final : Command {
    std::filesystem::path session_folder{}, output{}, report{}, page{}, map{}, sheet{};
    std::vector<double> repeat_mm{};
    std::vector<std::string> without{};
    double jump = lab::MeasureSettings{}.jump_limit;

    void options(Options &o) override {
        o.argument(&session_folder, "SESSION", "folder of a capture session").required();
        o.option("-o,--output", &output, "TABLE.csv",
                 "table of reflectance; of a camera with several colours TABLE.R.csv and so on")
            .required()
            .result({".csv"});
        o.option("--report", &report, "R.json",
                 "every view with the parts of its error, the lamp, what is left out and why")
            .result({".json"});
        o.option("--html", &page, "PAGE.html",
                 "page of the session: lamp, shutter and frames, drift, errors, what is left out")
            .result({".html"});
        o.option("--map", &map, "MAP.svg",
                 "the values on the hemisphere, of the first colour; what is left out is crossed")
            .result({".svg"});
        o.option("--sheet", &sheet, "SHEET.png", "some frames, with the measured patch outlined")
            .result({".png"});
        o.option(
             "--repeat-mm", &repeat_mm, "WEFT,WARP",
             "size of the weave's repeat, mm: patches are cut to whole repeats; without it, the "
             "spread of patches is counted as error")
            .with_commas()
            .exactly(2)
            .range(0, 1e3, true);
        o.option("--jump", &jump, "SHARE",
                 "relative difference of two white frames that is no drift: views between them are "
                 "left out")
            .range(0, 1, true);
        o.option("--without", &without, "LIST",
                 "corrections that are not made, to see what they do")
            .with_commas()
            .one_of({"black", "dark", "flat", "monitor", "trap", "drift"});
        o.example("tsuya lab measure satin/ -o satin.csv --report satin.json --html satin.html");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        check_place(report);
        check_place(page);
        check_place(map);
        check_place(sheet);
        const lab::Session session = lab::read_session(session_folder);
        check_output(session);
        const lab::SessionMeasurement measured =
            lab::measure_session(session, settings(), console.progress());
        console.end_line();
        for (const std::string &warning : measured.warnings)
            console.warning(warning);
        scene::prepare_output_file(output);
        for (const lab::ChannelMeasurement &channel : measured.channels)
            write_reflectance_table(channel.table, table_of(channel, measured));
        if (prepare_place(report))
            write_file(report, json_of(session, measured).text() + "\n");
        if (prepare_place(page))
            write_file(page, lab::session_page(session, measured));
        if (prepare_place(map))
            write_file(map, lab::table_picture(session, measured));
        if (prepare_place(sheet))
            write_png(sheet, lab::contact_sheet(session, measured));
        print(measured);
        return measured.left_out.empty() ? kDone : kCheckFailed;
    }

    /// Of a result that may not be asked for.
    static void check_place(const std::filesystem::path &file) {
        if (!file.empty())
            scene::check_output_file(file);
    }
    static bool prepare_place(const std::filesystem::path &file) {
        if (!file.empty())
            scene::prepare_output_file(file);
        return !file.empty();
    }

    /// The session's own tables are read, and must not be replaced.
    void check_output(const lab::Session &session) const {
        const auto *const standard = std::get_if<std::filesystem::path>(&session.rig.white.rho_std);
        for (const std::filesystem::path &read :
             {standard ? *standard : std::filesystem::path(), session.rig.camera.response,
              session.rig.camera.flat})
            if (!read.empty() && is_same_file(output, read))
                throw WrongCall(Problem{"it would replace a file of the session", output.string(),
                                        "expected another name"});
    }

    lab::MeasureSettings settings() const {
        lab::MeasureSettings settings{.jump_limit = jump};
        if (!repeat_mm.empty())
            settings.repeat_mm = {repeat_mm[0], repeat_mm[1]};
        const auto on = [&](const char *name) {
            return std::find(without.begin(), without.end(), name) == without.end();
        };
        settings.corrections = {.black = on("black"),
                                .dark = on("dark"),
                                .flat = on("flat"),
                                .monitor = on("monitor"),
                                .trap = on("trap"),
                                .drift = on("drift")};
        return settings;
    }

    /// Where the table of a colour stands.
    std::filesystem::path table_of(const lab::ChannelMeasurement &channel,
                                   const lab::SessionMeasurement &measured) const {
        std::filesystem::path file = output;
        if (measured.channels.size() > 1)
            file.replace_extension("." + channel.name + ".csv");
        return file;
    }

    static Json json_of(const lab::Session &session, const lab::SessionMeasurement &measured) {
        Json channels = Json::array(), left_out = Json::array(), warnings = Json::array();
        for (const lab::ChannelMeasurement &channel : measured.channels)
            channels.push_back(program::json_of(channel));
        for (const lab::LeftOutView &view : measured.left_out) {
            Json item = program::json_of(view.directions);
            item.update({{"view", view.view},
                         {"reason", lab::name_of(view.reason)},
                         {"detail", view.detail}});
            left_out.push_back(std::move(item));
        }
        for (const std::string &warning : measured.warnings)
            warnings.push_back(warning);
        return {{"schema", "tsuya-lab-measure 1"},
                {"session", session.folder.string()},
                {"journal_hash", session.journal_hash},
                {"lamp_deg", degrees_of(measured.lamp_angle)},
                {"aperture_deg", degrees_of(measured.aperture_angle)},
                {"narrowest_lobe_deg", degrees_of(measured.narrowest_lobe)},
                {"channel_difference", measured.channel_difference},
                {"channels", std::move(channels)},
                {"left_out", std::move(left_out)},
                {"warnings", std::move(warnings)}};
    }

    static void print(const lab::SessionMeasurement &measured) {
        std::cout << detail::counted(measured.channels[0].views.size(), "view") << " measured\n";
        for (const lab::LeftOutView &view : measured.left_out)
            std::cout << "view " << view.view << " left out, " << lab::name_of(view.reason) << ": "
                      << view.detail << "\n";
        if (measured.channels.size() > 1)
            std::cout << "the colours differ by " << 100 * measured.channel_difference << " %\n";
    }
};

} // namespace

std::unique_ptr<Command> make_lab_measure() { return std::make_unique<LabMeasure>(); }

} // namespace tsuya::program
