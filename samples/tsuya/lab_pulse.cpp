// tsuya lab pulse: lamp and shutter of the measuring rig.

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "command.h"
#include "json.h"
#include "tsuya/lab/progress_relay.h"
#include "tsuya/lab/pulse_job.h"
#include "tsuya/lab/supervisor.h"

namespace tsuya::program {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

std::chrono::nanoseconds nanoseconds_of(double ms) {
    return std::chrono::round<std::chrono::nanoseconds>(Milliseconds(ms));
}

double ms_of(std::chrono::nanoseconds time) { return Milliseconds(time).count(); }

/// The options of one line.
struct LineOptions {
    std::string chip{}, drive{"push-pull"}, bias{"as-is"};
    bool active_low = false;

    /// \param prefix of the options' names, `--lamp`
    /// \param line where there is one, the option without which these have no meaning
    void options(Options &o, const std::string &prefix, const std::string &what,
                 const Option *line) {
        for (Option *option :
             {&o.option(prefix + "-chip", &chip, "CHIP",
                        "GPIO chip of the " + what +
                            ": name, path, label or number; without it, "
                            "the one that has the line"),
              &o.flag(prefix + "-active-low", &active_low,
                      "the low level of the " + what + "'s line is the active one"),
              &o.option(prefix + "-drive", &drive, "DRIVE", "how the " + what + "'s line is driven")
                   .one_of(kDrives),
              &o.option(prefix + "-bias", &bias, "BIAS", "resistor of the " + what + "'s line")
                   .one_of(kBiases)})
            if (line)
                option->needs(*line);
    }
    lab::GpioLineSettings settings(const std::string &line) const {
        return {.chip = chip,
                .line = line,
                .active_low = active_low,
                .drive = static_cast<lab::Drive>(place_of(drive, kDrives)),
                .bias = static_cast<lab::Bias>(place_of(bias, kBiases))};
    }

  private:
    static std::ptrdiff_t place_of(const std::string &name, const std::vector<std::string> &names) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    }
    // in the order of lab::Drive and lab::Bias
    inline static const std::vector<std::string> kDrives{"push-pull", "open-drain", "open-source"};
    inline static const std::vector<std::string> kBiases{"as-is", "disabled", "pull-up",
                                                         "pull-down"};
};

struct LabPulse final : Command {
    lab::PulseJob job{.train = {.count = 5}};
    std::string line = "shutter";
    std::optional<std::string> lamp_line{};
    LineOptions shutter{}, lamp{};
    double width_ms = 20, period_ms = 100, warm_up_ms = 0;
    std::optional<double> tolerance_ms{};
    bool json = false;

    void options(Options &o) override {
        o.option("--line", &line, "LINE", "name or offset of the shutter's line");
        shutter.options(o, "--line", "shutter", nullptr);
        const Option &lamp_option =
            o.option("--lamp-line", &lamp_line, "LINE",
                     "name or offset of the lamp's line; without it no lamp is driven")
                .check([this] { lab::check_pulse_lines(with_lines()); });
        lamp.options(o, "--lamp", "lamp", &lamp_option);
        o.option("--width-ms", &width_ms, "MS", "milliseconds that the shutter is open")
            .range(0, ms_of(lab::kLongestPeriod), true);
        o.option("--period-ms", &period_ms, "MS", "milliseconds from one opening to the next")
            .range(0, ms_of(lab::kLongestPeriod), true)
            .check([this] { lab::check_pulse_train(train()); });
        o.option("--count", &job.train.count, "N", "number of pulses").range(1, lab::kMostPulses);
        o.option("--warm-up-ms", &warm_up_ms, "MS",
                 "milliseconds that the lamp is on before the first pulse")
            .range(0, ms_of(lab::kLongestWarmUp));
        o.option("--tolerance-ms", &tolerance_ms, "MS",
                 "how late an opening or closing may be; without it, the larger of 0.5 ms and 2 % "
                 "of the width")
            .range(0, ms_of(lab::kLongestPeriod), true);
        o.flag("--simulate", &job.simulate, "simulated lines in virtual time, without hardware");
        o.flag("--json", &json, "print the report as JSON");
        o.example("tsuya lab pulse --line shutter --lamp-line lamp --width-ms 20 --count 5");
        o.notes("Lamp and shutter are off at the end of every run. The pulses that were done are "
                "printed\nalso where the run ends with an error or is interrupted.");
    }

    lab::PulseTrain train() const {
        lab::PulseTrain asked = job.train;
        asked.width = nanoseconds_of(width_ms);
        asked.period = nanoseconds_of(period_ms);
        asked.warm_up = nanoseconds_of(warm_up_ms);
        if (tolerance_ms)
            asked.tolerance = nanoseconds_of(*tolerance_ms);
        return asked;
    }

    lab::PulseJob with_lines() const {
        lab::PulseJob asked = job;
        asked.shutter = shutter.settings(line);
        if (lamp_line)
            asked.lamp = lamp.settings(*lamp_line);
        return asked;
    }

    Status run(Console &console) override {
        job = with_lines();
        job.train = train();
        job.library_threads = lab::other_threads(); // none is our own yet
        try {
            print(pulse(console));
        } catch (const lab::PulsesFailed &failed) {
            print(failed.report());
            throw;
        } catch (const lab::PulsesInterrupted &interrupted) {
            print(interrupted.report());
            throw;
        }
        return kDone;
    }

    /// The lines are let go before anything waits for a terminal that does not take the progress.
    lab::PulseReport pulse(Console &console) const {
        lab::ProgressRelay relay(console.progress());
        const SignalShield shield;
        return lab::run_pulse_job(job, relay.progress());
    }

    void print(const lab::PulseReport &report) const {
        if (json)
            print_json(report);
        else
            print_table(report);
    }

    static void print_table(const lab::PulseReport &report) {
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
                     {"planned_pulses", job.train.count},
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
