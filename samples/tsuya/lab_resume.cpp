// tsuya lab resume: goes on with a session that ended early.

#include "lab_session.h"

namespace tsuya::program {
namespace {

struct LabResume final : Command {
    std::filesystem::path folder{};
    SessionOptions session{};

    void options(Options &o) override {
        o.argument(&folder, "SESSION", "folder of the session").required();
        session.options(o);
        o.example("tsuya lab resume satin");
        o.notes("Takes the frames that do not count yet. A rig file or plan that has changed is "
                "refused.");
    }

    Status run(Console &console) override { return session.run(folder, console); }
};

} // namespace

std::unique_ptr<Command> make_lab_resume() { return std::make_unique<LabResume>(); }

} // namespace tsuya::program
