// Pulses on real lines until the train ends or a signal comes: what gpio_guest.sh watches.
// gpio_pulses CHIP SHUTTER LAMP WIDTH_MS PERIOD_MS COUNT [low]
#include "tsuya/lab/progress_relay.h"
#include "tsuya/lab/pulse_job.h"
#include "tsuya/sdk/error.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

// [doc:pulses]
namespace {

std::atomic<bool> stop{false}; // a signal handler can only reach something global

/// Returns the exit status of the program.
int run(const tsuya::lab::PulseJob &job) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(signal, [](int) { stop = true; });
    std::signal(SIGPIPE, SIG_IGN);
    // On a thread of its own: a paused terminal holds up no pulse.
    tsuya::lab::ProgressRelay relay(
        {.report =
             [](std::string_view stage, double fraction) {
                 std::fprintf(stderr, "%s %.0f %%\n", std::string(stage).c_str(), 100 * fraction);
             },
         .stop = &stop});
    try {
        const tsuya::lab::PulseReport report = run_pulse_job(job, relay.progress());
        std::printf("%zu pulses, %.3f ms late at most\n", report.pulses.size(),
                    static_cast<double>(report.largest_late.count()) * 1e-6);
        return 0;
    } catch (const tsuya::Error &error) { // lamp and shutter are off here, too
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    } catch (const tsuya::Interrupted &interrupted) { // and here
        std::fprintf(stderr, "%s\n", interrupted.what());
        return 3;
    }
}

} // namespace
// [/doc:pulses]

int main(int argc, char **argv) {
    if (argc < 7)
        return 2;
    using tsuya::lab::GpioLineSettings;
    const bool active_low = argc > 7 && std::string_view(argv[7]) == "low";
    const auto milliseconds = [](const char *text) {
        return std::chrono::milliseconds(std::atoi(text));
    };
    return run(
        {.train = {.width = milliseconds(argv[4]),
                   .period = milliseconds(argv[5]),
                   .count = std::atoi(argv[6])},
         .shutter = {.chip = argv[1], .line = argv[2], .active_low = active_low},
         .lamp = GpioLineSettings{.chip = argv[1], .line = argv[3], .active_low = active_low}});
}
