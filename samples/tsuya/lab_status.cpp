// tsuya lab status: how far a session is.

#include <iomanip>
#include <iostream>

#include "command.h"
#include "json.h"
#include "tsuya/lab/session_status.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::program {
namespace {

using detail::counted;

struct LabStatus final : Command {
    std::filesystem::path folder{};
    bool json = false;

    void options(Options &o) override {
        o.argument(&folder, "SESSION", "folder of the session").required();
        o.flag("--json", &json, "print the report as JSON");
        o.example("tsuya lab status satin");
    }

    Status run(Console &) override {
        const lab::SessionStatus status = lab::session_status(folder);
        if (json)
            print_json(status);
        else
            print(status);
        return kDone;
    }

    static void print(const lab::SessionStatus &status) {
        std::cout << status.counted << " of " << counted(status.planned, "frame") << ", "
                  << counted(status.rejected, "picture") << " rejected, "
                  << counted(status.runs, "run") << "\n"
                  << (status.running.empty() ? "not running" : "run by process " + status.running)
                  << ", last event " << (status.last.empty() ? "none" : status.last) << "\n"
                  << "lamp " << lamp_of(status) << ", " << counted(status.strikes, "strike") << ", "
                  << std::fixed << std::setprecision(2) << status.lamp_hours << " hours\n";
        if (status.latched)
            std::cout << "fault to be acknowledged: " << *status.latched << "\n";
    }

    /// A run that was killed could not note what its supervisor did.
    static const char *lamp_of(const lab::SessionStatus &status) {
        if (!status.lamp_lit)
            return "off";
        return status.running.empty() ? "lit when the last run was cut off" : "lit";
    }

    static void print_json(const lab::SessionStatus &status) {
        Json report{
            {"schema", "tsuya-lab-status 1"},  {"planned", status.planned},
            {"counted", status.counted},       {"missing", status.planned - status.counted},
            {"rejected", status.rejected},     {"runs", status.runs},
            {"running", status.running},       {"last_event", status.last},
            {"lamp_lit", status.lamp_lit},     {"strikes", status.strikes},
            {"lamp_hours", status.lamp_hours}, {"latched_fault", status.latched.value_or("")}};
        std::cout << report.text() << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_lab_status() { return std::make_unique<LabStatus>(); }

} // namespace tsuya::program
