#include "tsuya/lab/supervisor.h"

#include "tsuya/lab/pulse_job.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <unistd.h>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;

/// A failed expectation of the child would be lost; an exception is not.
void sleep_for(Worker &worker, std::chrono::nanoseconds time) {
    if (!worker.clock().sleep_until(worker.clock().now() + time, nullptr))
        throw Error({.what = "the sleep ended early"});
}

/// A shared order of the calls that drive lines off in this process.
struct OrderedLine final : OutputLine {
    OrderedLine(std::string its_name, std::vector<std::string> &order)
        : name_(std::move(its_name)), order_(order) {}
    void set(bool active) override { order_.push_back(name_ + (active ? " on" : " off")); }
    const std::string &name() const override { return name_; }
    void check() override {
        if (gone)
            throw Error({.what = "is gone", .where = name_});
    }
    std::string name_;
    std::vector<std::string> &order_;
    bool gone = false;
};

struct SupervisedLines {
    std::vector<std::string> order{};
    OrderedLine lamp{"lamp", order}, shutter{"shutter", order};
    Supervision supervision{.lines = {&lamp, nullptr, &shutter}};

    /// Driven off before the work is killed, and once more after.
    void expect_driven_off_twice() const {
        ASSERT_GE(order.size(), 4u);
        const std::vector<std::string> off{"lamp off", "shutter off", "lamp off", "shutter off"};
        EXPECT_EQ(std::vector<std::string>(order.end() - 4, order.end()), off);
    }
    std::string error_of(const std::function<void(Worker &)> &work) {
        try {
            run_supervised(supervision, work);
        } catch (const Error &error) {
            return error.what();
        }
        return "no error";
    }
};

TEST(Supervisor, PassesMessagesAndProgressToTheCaller) {
    SupervisedLines lines;
    std::vector<std::string> heard;
    lines.supervision.receive = [&](std::string_view text) { heard.emplace_back(text); };
    std::vector<double> told;
    run_supervised(lines.supervision,
                   [](Worker &worker) {
                       for (int i = 0; i < 100; ++i)
                           worker.send("message " + std::to_string(i));
                       worker.progress()("stage", 0.5);
                       worker.send("");
                   },
                   {.report = [&](std::string_view stage, double fraction) {
                       EXPECT_EQ(stage, "stage");
                       told.push_back(fraction);
                   }});
    ASSERT_EQ(heard.size(), 101u);
    EXPECT_EQ(heard[99], "message 99");
    EXPECT_EQ(told, std::vector<double>{0.5});
    lines.expect_driven_off_twice();
}

TEST(Supervisor, WorkThatSleepsLongerThanTheSilenceIsNotKilled) {
    SupervisedLines lines;
    lines.supervision.silence = 500ms; // a busy computer is no fault of the work
    run_supervised(lines.supervision, [](Worker &worker) { sleep_for(worker, 1200ms); });
    lines.expect_driven_off_twice();
}

TEST(Supervisor, PassesErrorsAndInterruptionsOn) {
    SupervisedLines lines;
    try {
        run_supervised(lines.supervision, [](Worker &) {
            throw Error({{.what = "a", .where = "b", .accepted = "c"}, {.what = "d"}});
        });
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "b");
        EXPECT_EQ(error.problems()[0].accepted, "c");
        EXPECT_EQ(error.problems()[1].what, "d");
    }
    EXPECT_EQ(lines.error_of([](Worker &) { throw std::runtime_error("its own"); }), "its own");
    EXPECT_THROW(run_supervised(lines.supervision, [](Worker &) { throw Interrupted("so far"); }),
                 Interrupted);
    lines.expect_driven_off_twice();
}

// Libraries may start threads before main; those that the caller does not name are refused.
TEST(Supervisor, AllowsTheThreadsOfLibrariesAlone) {
    SupervisedLines lines;
    std::atomic<bool> ending{false};
    const auto idle = [&] {
        while (!ending)
            std::this_thread::sleep_for(1ms);
    };
    std::thread first(idle);
    EXPECT_EQ(other_threads(), 1);
    EXPECT_NE(lines.error_of([](Worker &) {}).find("the program has 2 threads"), std::string::npos);
    lines.supervision.library_threads = 1;
    EXPECT_EQ(lines.error_of([](Worker &) {}), "no error");
    std::thread second(idle);
    EXPECT_NE(lines.error_of([](Worker &) {}).find("the program has 3 threads"), std::string::npos);
    ending = true;
    first.join();
    second.join();
}

// What the work runs is killed with it, also in a process group of its own.
TEST(Supervisor, KillsTheCommandOfTheWork) {
    SupervisedLines lines;
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("tsuya_group_" + std::to_string(getpid()));
    EXPECT_NE(lines.error_of([&](Worker &worker) {
        const pid_t command = fork();
        if (command == 0) {
            setpgid(0, 0);
            sleep(60);
            _exit(0);
        }
        setpgid(command, command);
        std::ofstream(file) << command;
        worker.command_group(command);
        kill(getpid(), SIGKILL);
    }),
              "no error");
    int group = 0;
    std::ifstream(file) >> group;
    std::filesystem::remove(file);
    ASSERT_GT(group, 0);
    SteadyClock clock;
    for (int i = 0; i < 200 && kill(-group, 0) == 0; ++i)
        static_cast<void>(clock.sleep_until(clock.now() + 10ms, nullptr));
    EXPECT_NE(kill(-group, 0), 0);
}

TEST(Supervisor, WorkThatHangsIsKilled) {
    SupervisedLines lines;
    const auto hang = [](Worker &) {
        for (;;)
            pause();
    };
    EXPECT_NE(lines.error_of(hang).find("the work hung"), std::string::npos);
    lines.expect_driven_off_twice();
    EXPECT_NE(lines.error_of([](Worker &) { std::raise(SIGSTOP); }).find("the work hung"),
              std::string::npos);
}

/// Work that computes for so long.
void stay_silent(std::chrono::nanoseconds time) {
    SteadyClock clock;
    static_cast<void>(clock.sleep_until(clock.now() + time, nullptr));
}

TEST(Supervisor, WorkThatWaitsMayNotBeSilentAsLongAsWorkThatComputes) {
    SupervisedLines lines;
    lines.supervision.silence_at_work = 5s;
    const auto compute = [](Worker &worker) {
        stay_silent(400ms);
        sleep_for(worker, 10ms);
        stay_silent(400ms);
    };
    EXPECT_EQ(lines.error_of(compute), "no error");
    const auto hang = [](Worker &worker) {
        sleep_for(worker, 10ms);
        const Waiting outer(worker.clock());
        sleep_for(worker, 10ms);
        { const Waiting inner(worker.clock()); }
        stay_silent(60s);
    };
    SteadyClock clock;
    const auto begin = clock.now();
    EXPECT_NE(lines.error_of(hang).find("the work hung"), std::string::npos);
    EXPECT_LT(clock.now() - begin, 4s) << "of the 5 s of work that computes";
    lines.expect_driven_off_twice();
}

TEST(Supervisor, WorkThatDiesIsNamed) {
    SupervisedLines lines;
    for (const int signal : {SIGKILL, SIGSEGV, SIGABRT}) {
        lines.order.clear();
        const std::string what = lines.error_of([signal](Worker &) {
            std::signal(signal, SIG_DFL);
            std::raise(signal);
        });
        EXPECT_NE(what.find("killed by signal " + std::to_string(signal)), std::string::npos)
            << what;
        lines.expect_driven_off_twice();
    }
    EXPECT_NE(lines.error_of([](Worker &) { _exit(0); }).find("without saying how"),
              std::string::npos);
}

// The worker waits for the stop; one that does not hear is killed.
TEST(Supervisor, AStopEndsTheWork) {
    SupervisedLines lines;
    lines.supervision.silence = 5s;
    const std::atomic<bool> stop{true};
    EXPECT_THROW(run_supervised(lines.supervision,
                                [](Worker &worker) {
                                    const Progress progress = worker.progress();
                                    if (!worker.clock().sleep_until(worker.clock().now() + 1h,
                                                                    progress.stop))
                                        throw Interrupted("heard");
                                },
                                {.stop = &stop}),
                 Interrupted);
    lines.expect_driven_off_twice();
    EXPECT_THROW(run_supervised(lines.supervision,
                                [](Worker &) {
                                    for (;;)
                                        pause();
                                },
                                {.stop = &stop}),
                 Interrupted);
    lines.expect_driven_off_twice();
}

TEST(Supervisor, ALineThatIsGoneEndsTheWork) {
    SupervisedLines lines;
    lines.lamp.gone = true;
    const auto start = SteadyClock().now();
    EXPECT_EQ(lines.error_of([](Worker &worker) { sleep_for(worker, 1h); }), "lamp: is gone");
    EXPECT_LT(SteadyClock().now() - start, 1h); // whatever load the computer has
    lines.expect_driven_off_twice();
}

TEST(Supervisor, KillsWhatTheWorkStarted) {
    SupervisedLines lines;
    pid_t started = 0;
    lines.supervision.receive = [&](std::string_view text) {
        started = std::stoi(std::string(text));
    };
    run_supervised(lines.supervision, [](Worker &worker) {
        const pid_t command = fork();
        if (command == 0) {
            execlp("sleep", "sleep", "1000", static_cast<char *>(nullptr));
            _exit(1);
        }
        worker.send(std::to_string(command));
    });
    ASSERT_GT(started, 0);
    SteadyClock clock;
    bool gone = false;
    for (int i = 0; i < 1000 && !gone; ++i) { // until whoever inherits it has waited for it
        gone = kill(started, 0) != 0;
        std::FILE *file = std::fopen(("/proc/" + std::to_string(started) + "/stat").c_str(), "r");
        char state = 'Z';
        if (file) {
            if (std::fscanf(file, "%*d (%*[^)]) %c", &state) != 1)
                state = 'Z';
            std::fclose(file);
        }
        gone = gone || state == 'Z';
        static_cast<void>(clock.sleep_until(clock.now() + 10ms, nullptr));
    }
    EXPECT_TRUE(gone);
}

TEST(Supervisor, BeatsOnTheHeartbeatLineAndLeavesItOff) {
    SupervisedLines lines;
    SteadyClock clock;
    SimulatedLine heartbeat("heartbeat", clock);
    lines.supervision.heartbeat = &heartbeat;
    run_supervised(lines.supervision, [](Worker &worker) { sleep_for(worker, 300ms); });
    EXPECT_GE(heartbeat.transitions().size(), 2u);
    EXPECT_FALSE(heartbeat.active());
}

TEST(Supervisor, AnExceptionOfTheReceiverEndsTheWork) {
    SupervisedLines lines;
    lines.supervision.receive = [](std::string_view) { throw std::domain_error("the caller's"); };
    EXPECT_THROW(run_supervised(lines.supervision,
                                [](Worker &worker) {
                                    worker.send("a");
                                    sleep_for(worker, 1h);
                                }),
                 std::domain_error);
    lines.expect_driven_off_twice();
}

TEST(Supervisor, RefusesThreadsAndSilencesOutOfRange) {
    SupervisedLines lines;
    for (const auto silence : {99ms, 5001ms}) {
        lines.supervision.silence = silence;
        EXPECT_NE(lines.error_of([](Worker &) {}).find("silence: is "), std::string::npos);
    }
    lines.supervision.silence = 200ms;
    for (const auto silence : {199ms, 5001ms}) {
        lines.supervision.silence_at_work = silence;
        EXPECT_NE(lines.error_of([](Worker &) {}).find("silence_at_work: is "), std::string::npos);
    }
    lines.supervision.silence_at_work = 0ms;
    std::atomic<bool> end{false};
    std::thread other([&] {
        while (!end)
            std::this_thread::yield();
    });
    const std::string what = lines.error_of([](Worker &) {});
    end = true;
    other.join();
    EXPECT_NE(what.find("the program has 2 threads"), std::string::npos) << what;
    EXPECT_TRUE(lines.order.empty());
}

TEST(SupervisedPulses, ReportEachPulse) {
    SteadyClock clock;
    SimulatedLine shutter("shutter", clock), lamp("lamp", clock);
    const PulseTrain train{.width = 2ms, .period = 10ms, .count = 4, .tolerance = 1s};
    const PulseReport report = run_supervised_pulses(train, shutter, &lamp);
    ASSERT_EQ(report.pulses.size(), 4u);
    EXPECT_GE(report.pulses[3].opened, 30ms);
    EXPECT_GE(report.pulses[3].closed, 32ms);
}

TEST(SupervisedPulses, CarryThePulsesDoneBeforeTheWorkWasKilled) {
    SteadyClock clock;
    SimulatedLine lamp("lamp", clock);
    struct Killer final : OutputLine {
        void set(bool active) override {
            if (active && ++opened == 3)
                std::raise(SIGKILL);
        }
        const std::string &name() const override { return its_name; }
        int opened = 0;
        std::string its_name = "shutter";
    } shutter;
    try {
        run_supervised_pulses({.width = 2ms, .period = 10ms, .count = 9, .tolerance = 1s}, shutter,
                              &lamp);
        FAIL() << "no error";
    } catch (const PulsesFailed &error) {
        EXPECT_EQ(error.report().pulses.size(), 2u);
    }
}

} // namespace
} // namespace tsuya::lab
