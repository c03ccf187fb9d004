// tsuya lab pulse: lamp and shutter of the measuring rig.

#include <iomanip>
#include <iostream>

#include "command.h"
#include "json_file.h"
#include "tsuya/lab/pulse_job.h"

namespace tsuya::program {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

std::chrono::nanoseconds nanoseconds_of(double ms) {
    return std::chrono::round<std::chrono::nanoseconds>(Milliseconds(ms));
}

constexpr double kLongestMs = 1e9; // run_pulse_job knows the limits

double ms_of(std::chrono::nanoseconds time) { return Milliseconds(time).count(); }

struct LabPulse final : Command {
    lab::PulseJob job{.train = {.count = 5}};
    std::string chip{}, lamp_line{};
    double width_ms = 20, period_ms = 100, warm_up_ms = 0;
    bool active_low = false, json = false;

    void options(Options &o) override {
        o.option("--line", &job.shutter.line, "LINE", "name or offset of the shutter's line");
        o.option("--lamp-line", &lamp_line, "LINE",
                 "name or offset of the lamp's line; without it no lamp is driven");
        o.option("--chip", &chip, "CHIP", "GPIO chip; without it, the one that has the line");
        o.option("--width-ms", &width_ms, "MS", "milliseconds that the shutter is open")
            .range(0, kLongestMs);
        o.option("--period-ms", &period_ms, "MS", "milliseconds from one opening to the next")
            .range(0, kLongestMs);
        o.option("--count", &job.train.count, "N", "number of pulses").range(1, 1e6);
        o.option("--warm-up-ms", &warm_up_ms, "MS",
                 "milliseconds that the lamp is on before the first pulse")
            .range(0, kLongestMs);
        o.flag("--active-low", &active_low, "the low level of both lines is the active one");
        o.flag("--simulate", &job.simulate, "simulated lines in virtual time, without hardware");
        o.flag("--json", &json, "print the report as JSON");
        o.example("tsuya lab pulse --line shutter --lamp-line lamp --width-ms 20 --count 5");
        o.notes("Lamp and shutter are off at the end of every run.");
    }

    Status run(Console &console) override {
        job.train.width = nanoseconds_of(width_ms);
        job.train.period = nanoseconds_of(period_ms);
        job.train.warm_up = nanoseconds_of(warm_up_ms);
        job.shutter.chip = chip;
        job.shutter.active_low = active_low;
        if (!lamp_line.empty())
            job.lamp = {.chip = chip, .line = lamp_line, .active_low = active_low};
        const lab::PulseReport report = lab::run_pulse_job(job, console.progress());
        if (json)
            print_json(report);
        else
            print(report);
        return kDone;
    }

    static void print(const lab::PulseReport &report) {
        std::cout << "pulse   opened_ms   closed_ms    width_ms\n"
                  << std::fixed << std::setprecision(3);
        for (std::size_t i = 0; i < report.pulses.size(); ++i) {
            const lab::PulseTiming &p = report.pulses[i];
            std::cout << std::setw(5) << i << std::setw(12) << ms_of(p.opened) << std::setw(12)
                      << ms_of(p.closed) << std::setw(12) << ms_of(p.closed - p.opened) << "\n";
        }
        std::cout << "mean width " << ms_of(report.mean_width) << " ms, late "
                  << ms_of(report.mean_late) << " ms in the mean, " << ms_of(report.largest_late)
                  << " ms at most\n";
    }

    void print_json(const lab::PulseReport &report) const {
        Json numbers{{"schema", "tsuya-lab-pulse 1"},
                     {"simulated", job.simulate},
                     {"mean_width_ms", ms_of(report.mean_width)},
                     {"mean_late_ms", ms_of(report.mean_late)},
                     {"largest_late_ms", ms_of(report.largest_late)},
                     {"pulses", Json::array()}};
        for (const lab::PulseTiming &p : report.pulses)
            numbers["pulses"].push_back(
                {{"opened_ms", ms_of(p.opened)}, {"closed_ms", ms_of(p.closed)}});
        std::cout << numbers.text() << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_lab_pulse() { return std::make_unique<LabPulse>(); }

} // namespace tsuya::program
