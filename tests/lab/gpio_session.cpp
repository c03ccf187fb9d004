// Sessions on real lines: what gpio_session_guest.sh watches. A picture is a line of text.
// gpio_session create RIG.toml FOLDER | run FOLDER | reset RIG.toml REASON
// The status of `run` is that of `tsuya lab run`.
#include "lab/session_bed.h"
#include "tsuya/lab/session_job.h"

#include <csignal>
#include <cstdio>

namespace tsuya::lab {
namespace {

std::atomic<bool> stop{false}; // a signal handler can only reach something global

int create(const std::filesystem::path &rig_file, const std::filesystem::path &folder) {
    const std::filesystem::path plan_file = folder.string() + ".plan.jsonl";
    write_plan(make_plan(read_rig_file(rig_file),
                         {.directions = views_named("few:45", Symmetry::orthotropic),
                          .views = "few:45",
                          .rig = rig_file}),
               plan_file);
    create_session(folder, plan_file, rig_file);
    return 0;
}

int run(const std::filesystem::path &folder) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(signal, [](int) { stop = true; });
    const SessionResult result =
        run_session_job({.folder = folder, .read = read_picture}, {.stop = &stop});
    std::printf("%zu of %zu frames\n", result.counted, result.planned);
    return result.missing() == 0 ? 0 : 4;
}

int reset(const std::filesystem::path &rig_file, const std::string &reason) {
    acknowledge_fault(fault_log_of(rig_file), reason, moment_now().time_s);
    return 0;
}

} // namespace
} // namespace tsuya::lab

int main(int argc, char **argv) {
    using namespace tsuya;
    const std::string task = argc > 2 ? argv[1] : "";
    try {
        if (task == "create" && argc == 4)
            return lab::create(argv[2], argv[3]);
        if (task == "run" && argc == 3)
            return lab::run(argv[2]);
        if (task == "reset" && argc == 4)
            return lab::reset(argv[2], argv[3]);
        return 2;
    } catch (const Error &error) { // lamp and shutter are off here, too
        std::printf("%s\n", error.what());
        return 1;
    } catch (const Interrupted &interrupted) { // and here
        std::printf("%s\n", interrupted.what());
        return 3;
    }
}
