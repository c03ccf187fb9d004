#include "files/interchange/child_process.h"

#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <vector>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "files/interchange/mesh_bytes.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

using End = ChildResult::End;

constexpr ChildLimits kLimits{.memory_bytes = 1u << 28,
                              .cpu_time = std::chrono::seconds(1),
                              .wall_time = std::chrono::minutes(10),
                              .result_bytes = 1u << 20};

ChildResult run(const std::function<std::string()> &work) {
    return run_in_child(work, kLimits, "test", {});
}

TEST(ChildProcess, ReturnsWhatTheWorkReturns) {
    const std::string long_text(900'000, 'x'); // longer than a pipe holds
    int touched = 0;
    const ChildResult result = run([&] {
        touched = 1;
        return long_text;
    });
    EXPECT_EQ(result.end, End::done);
    EXPECT_EQ(result.bytes, long_text);
    EXPECT_EQ(touched, 0); // in its own memory
    EXPECT_EQ(run([] { return std::string(); }).end, End::done);
}

TEST(ChildProcess, AFailureTellsItsCause) {
    const ChildResult result = run([]() -> std::string { throw std::runtime_error("why"); });
    EXPECT_EQ(result.end, End::failed);
    EXPECT_EQ(result.bytes, "why");
}

TEST(ChildProcess, ACrashIsAFailureWithoutACause) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
        const ChildResult result = run([&] {
            std::raise(signal);
            return std::string("lived");
        });
        EXPECT_EQ(result.end, End::failed) << signal;
        EXPECT_EQ(result.bytes, "");
    }
}

TEST(ChildProcess, TakesNoMoreThanItMay) {
    EXPECT_EQ(run([] {
                  std::vector<char> much(1u << 30, 'x');
                  return std::string(much.begin(), much.begin() + 3);
              }).end,
              End::out_of_memory);
    EXPECT_EQ(run([] { return std::string(1u << 21, 'x'); }).end, End::too_long);
    EXPECT_EQ(run([] {
                  for (volatile bool on = true; on;) {
                  }
                  return std::string();
              }).end,
              End::out_of_cpu_time);
}

std::string sleep_for_an_hour() {
    std::this_thread::sleep_for(std::chrono::hours(1));
    return {};
}

TEST(ChildProcess, MayNotWaitForEver) {
    ChildLimits limits = kLimits;
    limits.wall_time = std::chrono::milliseconds(100);
    EXPECT_EQ(run_in_child(sleep_for_an_hour, limits, "test", {}).end, End::out_of_wall_time);
}

TEST(ChildProcess, AKillIsNoLimit) {
    EXPECT_EQ(run([] {
                  std::raise(SIGKILL);
                  return std::string();
              }).end,
              End::killed);
}

/// Whether the child of a process that is killed ends, too: by the signal that the system sends, or
/// without it, as nobody reads what it writes.
bool ends_with_its_killed_parent(bool by_signal) {
    std::array<int, 2> ends{}; // the write end is open as long as one of the two lives
    EXPECT_EQ(pipe(ends.data()), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        close(ends[0]);
        run([&] {
            const pid_t child = getpid(), above = getppid();
            if (!by_signal)
                prctl(PR_SET_PDEATHSIG, 0);
            if (write(ends[1], &child, sizeof child) != sizeof child || by_signal)
                return sleep_for_an_hour();
            while (getppid() == above)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return std::string(900'000, 'x'); // longer than a pipe holds
        });
        _exit(0);
    }
    close(ends[1]);
    pid_t child = 0;
    EXPECT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    constexpr int kGiveUpMs = 20'000;
    pollfd waiting{.fd = ends[0], .events = POLLIN, .revents = 0};
    const bool ended = poll(&waiting, 1, kGiveUpMs) == 1;
    if (!ended)
        kill(child, SIGKILL);
    close(ends[0]);
    return ended;
}

TEST(ChildProcess, EndsWithAKilledParent) {
    EXPECT_TRUE(ends_with_its_killed_parent(true));
    EXPECT_TRUE(ends_with_its_killed_parent(false));
}

TEST(ChildProcess, StopsWithItsCaller) {
    std::atomic<bool> stop = false;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stop = true;
    });
    EXPECT_THROW(run_in_child(sleep_for_an_hour, kLimits, "test", {.stop = &stop}), Interrupted);
    later.join();
}

TEST(MeshBytes, ComeBackAsTheyWere) {
    MeshFile file;
    file.mesh.position = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    file.mesh.uv = {{1, 0}, {0, 1}, {0, 0}};
    file.mesh.add_face({0, 1, 2}, {2, 1, -1}, 0);
    file.mesh.panel_name = {"a panel"};
    file.mesh.panel_label = {{.object = "o", .group = "g", .material = "m"}};
    file.findings = {{Severity::warning, "key", "what", "", "action"}};
    const std::string bytes = bytes_of(file);
    const MeshFile back = mesh_of_bytes(bytes, "test");
    EXPECT_EQ(back.mesh.position, file.mesh.position);
    EXPECT_EQ(back.mesh.uv, file.mesh.uv);
    EXPECT_EQ(back.mesh.face_offset, file.mesh.face_offset);
    EXPECT_EQ(back.mesh.corner_position, file.mesh.corner_position);
    EXPECT_EQ(back.mesh.corner_uv, file.mesh.corner_uv);
    EXPECT_EQ(back.mesh.face_panel, file.mesh.face_panel);
    EXPECT_EQ(back.mesh.panel_name, file.mesh.panel_name);
    EXPECT_EQ(back.mesh.panel_label, file.mesh.panel_label);
    ASSERT_EQ(back.findings.size(), 1u);
    EXPECT_EQ(back.findings[0].severity, Severity::warning);
    EXPECT_EQ(back.findings[0].action, "action");
    for (std::size_t size = 0; size < bytes.size(); size += 7)
        EXPECT_THROW(mesh_of_bytes(bytes.substr(0, size), "test"), Error) << size;
    EXPECT_THROW(mesh_of_bytes(bytes + "x", "test"), Error);
}

} // namespace
} // namespace tsuya::garment
