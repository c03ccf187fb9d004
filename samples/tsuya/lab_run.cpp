// tsuya lab run: takes the frames of a plan.

#include "lab_session.h"

namespace tsuya::program {
namespace {

struct LabRun final : Command {
    std::filesystem::path plan{}, folder{};
    SessionOptions session{};

    void options(Options &o) override {
        o.argument(&plan, "PLAN.jsonl", "plan of the session").required();
        o.option("-o,--output", &folder, "SESSION", "new folder of the session").required();
        session.options(o);
        o.example("tsuya lab run satin.plan.jsonl -o satin --dry-run");
        o.notes("Lamp and shutter are off at the end of every run. Exit status 4: finished, but "
                "frames are\nmissing whose pictures were rejected; `tsuya lab resume` takes them "
                "again.");
    }

    Status run(Console &console) override { return session.run(folder, console, plan); }
};

} // namespace

std::unique_ptr<Command> make_lab_run() { return std::make_unique<LabRun>(); }

} // namespace tsuya::program
