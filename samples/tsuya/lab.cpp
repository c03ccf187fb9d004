// tsuya lab: lamp and shutter of the measuring rig.

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

double ms_of(std::chrono::nanoseconds time) { return Milliseconds(time).count(); }

class LabCommand final : public Command {
  public:
    explicit LabCommand(CLI::App &program)
        : app_(*program.add_subcommand("lab", "Drive the measuring rig")),
          pulse_(*app_.add_subcommand("pulse", "Open the shutter for exact times")) {
        const char *const example =
            "Example:\n  tsuya lab pulse --line shutter --lamp-line lamp --width-ms 20 --count 5\n"
            "With --simulate: in virtual time, without hardware. Lamp and shutter are off at the "
            "end of every run.";
        app_.require_subcommand(1);
        app_.footer(example);
        pulse_.footer(example);
        pulse_.add_option("--line", job_.shutter.line, "Shutter's line: its name or offset")
            ->capture_default_str();
        pulse_.add_option("--lamp-line", lamp_line_, "Lamp's line; none if not given");
        pulse_.add_option("--chip", chip_, "GPIO chip; the one that has the line if not given");
        // CLI::Range admits any finite positive time; run_pulse_job knows the limits
        pulse_.add_option("--width-ms", width_ms_, "Of a pulse")
            ->check(CLI::Range(0.0, kLongestMs))
            ->capture_default_str();
        pulse_.add_option("--period-ms", period_ms_, "From one opening to the next")
            ->check(CLI::Range(0.0, kLongestMs))
            ->capture_default_str();
        pulse_.add_option("--count", job_.train.count, "Of pulses")->capture_default_str();
        pulse_.add_option("--warm-up-ms", warm_up_ms_, "Lamp on before the first pulse")
            ->check(CLI::Range(0.0, kLongestMs))
            ->capture_default_str();
        pulse_.add_flag("--active-low", active_low_, "Active is the low level of both lines");
        pulse_.add_flag("--simulate", job_.simulate, "Virtual time and lines");
        pulse_.add_flag("--json", json_, "The report as JSON");
    }

    bool called() const override { return pulse_.parsed(); }

    Status run(Console &console) override {
        job_.train.width = nanoseconds_of(width_ms_);
        job_.train.period = nanoseconds_of(period_ms_);
        job_.train.warm_up = nanoseconds_of(warm_up_ms_);
        job_.shutter.chip = chip_;
        job_.shutter.active_low = active_low_;
        if (!lamp_line_.empty())
            job_.lamp = {.chip = chip_, .line = lamp_line_, .active_low = active_low_};
        const lab::PulseReport report = lab::run_pulse_job(job_, console.progress());
        if (json_)
            print_json(report);
        else
            print(report);
        return kDone;
    }

  private:
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
        Json json{{"schema", "tsuya-lab-pulse 1"},
                  {"simulated", job_.simulate},
                  {"mean_width_ms", ms_of(report.mean_width)},
                  {"mean_late_ms", ms_of(report.mean_late)},
                  {"largest_late_ms", ms_of(report.largest_late)},
                  {"pulses", Json::array()}};
        for (const lab::PulseTiming &p : report.pulses)
            json["pulses"].push_back(
                {{"opened_ms", ms_of(p.opened)}, {"closed_ms", ms_of(p.closed)}});
        std::cout << json.dump(2) << "\n";
    }

    static constexpr double kLongestMs = 1e9;

    CLI::App &app_;
    CLI::App &pulse_;
    lab::PulseJob job_{.train = {.count = 5}};
    std::string chip_{}, lamp_line_{};
    double width_ms_ = 20, period_ms_ = 100, warm_up_ms_ = 0;
    bool active_low_ = false, json_ = false;
};

} // namespace

std::unique_ptr<Command> make_lab(CLI::App &program) {
    return std::make_unique<LabCommand>(program);
}

} // namespace tsuya::program
