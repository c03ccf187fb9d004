// Prints the edges of an input line until none comes for so long: what gpio_guest.sh watches.
// gpio_watch CHIP LINE SECONDS [low]
#include "tsuya/lab/clock.h"
#include "tsuya/lab/gpio_line.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

int main(int argc, char **argv) {
    if (argc < 4)
        return 2;
    try {
        tsuya::lab::SteadyClock clock;
        tsuya::lab::GpioInput line({.chip = argv[1],
                                    .line = argv[2],
                                    .active_low = argc > 4 && std::string_view(argv[4]) == "low"});
        std::printf("%s is %s\n", line.name().c_str(), line.active() ? "active" : "inactive");
        std::fflush(stdout);
        const auto patience = std::chrono::seconds(std::atoi(argv[3]));
        while (const auto event =
                   line.wait(tsuya::lab::Edge::any, clock.now() + patience, nullptr)) {
            std::printf("%.6f %s\n", static_cast<double>(event->time.count()) * 1e-9,
                        event->active ? "active" : "inactive");
            std::fflush(stdout);
        }
        return 0;
    } catch (const tsuya::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
