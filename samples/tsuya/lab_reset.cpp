// tsuya lab reset: ends a fault of interlock or emergency stop.

#include <iostream>

#include "command.h"
#include "tsuya/lab/lamp_log.h"
#include "tsuya/lab/safety.h"

namespace tsuya::program {
namespace {

struct LabReset final : Command {
    std::filesystem::path rig{};
    std::string reason{};

    void options(Options &o) override {
        o.argument(&rig, "RIG.toml", "rig file").required();
        o.option("--acknowledge", &reason, "REASON", "what was found and done").required();
        o.example("tsuya lab reset ogm.rig.toml --acknowledge \"door was ajar, closed\"");
        o.notes("The fault and the reason stay in RIG.faults.jsonl beside the rig file.");
    }

    Status run(Console &) override {
        const std::filesystem::path log = lab::fault_log_of(rig);
        const auto fault = lab::latched_fault(log);
        lab::acknowledge_fault(log, reason, lab::moment_now().time_s);
        std::cout << "acknowledged: " << fault.value_or("") << "\n";
        return kDone;
    }
};

} // namespace

std::unique_ptr<Command> make_lab_reset() { return std::make_unique<LabReset>(); }

} // namespace tsuya::program
