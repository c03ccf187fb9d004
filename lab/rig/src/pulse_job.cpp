#include "tsuya/lab/pulse_job.h"

#include "pulse_report.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/lab/supervisor.h"
#include "tsuya/sdk/error.h"

#include <cstring>
#include <optional>

namespace tsuya::lab {

void check_pulse_lines(const PulseJob &job) {
    Problems problems;
    const std::string accepted = "a line's name or offset";
    problems.need(!job.shutter.line.empty(), "the line has an empty name", "shutter", accepted);
    if (job.lamp) {
        problems.need(!job.lamp->line.empty(), "the line has an empty name", "lamp",
                      accepted + "; no lamp at all is possible, too");
        problems.need(job.lamp->line != job.shutter.line || job.lamp->chip != job.shutter.chip,
                      "lamp and shutter are the same line '" + job.shutter.line + "'", "lamp",
                      "another line, or none");
    }
    problems.throw_if_any();
}

namespace {

PulseReport run_on_real_lines(const PulseJob &job, const Progress &progress) {
    std::vector<NamedGpioLine> lines{{"shutter", job.shutter}};
    if (job.lamp)
        lines.push_back({"lamp", *job.lamp});
    check_gpio_lines(lines);
    std::optional<GpioLine> lamp;
    if (job.lamp)
        lamp.emplace(*job.lamp);
    GpioLine shutter(job.shutter);
    return run_supervised_pulses(job.train, shutter, lamp ? &*lamp : nullptr, progress,
                                 job.library_threads);
}

} // namespace

PulseReport run_pulse_job(const PulseJob &job, const Progress &progress) {
    check_pulse_train(job.train);
    check_pulse_lines(job);
    if (job.simulate) {
        VirtualClock clock;
        SimulatedLine shutter(job.shutter.line, clock);
        SimulatedLine lamp(job.lamp ? job.lamp->line : "", clock);
        return run_pulses(job.train,
                          {.shutter = shutter, .clock = clock, .lamp = job.lamp ? &lamp : nullptr},
                          progress);
    }
    return run_on_real_lines(job, progress);
}

PulseReport run_supervised_pulses(const PulseTrain &train, OutputLine &shutter, OutputLine *lamp,
                                  const Progress &progress, int library_threads) {
    check_pulse_train(train);
    PulseReport report;
    const Supervision supervision{.lines = {lamp, &shutter},
                                  .receive =
                                      [&](std::string_view message) {
                                          PulseTiming &timing = report.pulses.emplace_back();
                                          std::memcpy(&timing, message.data(), sizeof timing);
                                      },
                                  .library_threads = library_threads};
    const auto work = [&](Worker &worker) {
        run_pulses(train,
                   {.shutter = shutter,
                    .clock = worker.clock(),
                    .lamp = lamp,
                    .on_pulse =
                        [&](const PulseTiming &timing) {
                            worker.send({reinterpret_cast<const char *>(&timing), sizeof timing});
                        }},
                   worker.progress());
    };
    try {
        run_supervised(supervision, work, progress);
    } catch (const Error &error) {
        summarize(train, report);
        throw PulsesFailed(error.problems(), report);
    } catch (const Interrupted &) {
        summarize(train, report);
        throw PulsesInterrupted(stopped_after(report, train), report);
    }
    summarize(train, report);
    return report;
}

} // namespace tsuya::lab
