#include "files/interchange/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/stop.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

using End = ChildResult::End;

/// First byte of what comes back.
constexpr char kDone = 'D', kFailed = 'F', kNoMemory = 'M';

void set_limit(int what, std::uint64_t soft, std::uint64_t hard) {
    const rlimit limit{soft, hard};
    setrlimit(static_cast<__rlimit_resource_t>(what), &limit);
}

/// Of this process, bytes of address space.
std::uint64_t address_space() {
    unsigned long long pages = 0;
    if (std::FILE *const file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu", &pages) != 1)
            pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

bool write_all(int to, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(to, bytes.data(), bytes.size());
        if (written <= 0)
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::string answer_of(const std::function<std::string()> &work) {
    try {
        return kDone + work();
    } catch (const std::bad_alloc &) {
        return {kNoMemory};
    } catch (const std::exception &error) {
        return kFailed + std::string(error.what());
    } catch (...) {
        return {kFailed};
    }
}

/// The calling process ends when `parent` does. The kernel sends the signal when the thread that
/// forked ends, which waits in run_in_child until then.
void end_with(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) // it ended before the call
        _exit(1);
}

/// The copy, from here to its end.
[[noreturn]] void be_child(int to, const std::function<std::string()> &work,
                           const ChildLimits &limits) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGPIPE, SIGSEGV, SIGABRT, SIGXCPU})
        std::signal(signal, SIG_DFL);
    if (const int nowhere = open("/dev/null", O_RDWR); nowhere >= 0)
        for (const int stream : {0, 1, 2})
            dup2(nowhere, stream);
    set_limit(RLIMIT_CORE, 0, 0);
    const std::uint64_t memory = address_space() + limits.memory_bytes;
    set_limit(RLIMIT_AS, memory, memory);
    // SIGXCPU at the soft limit; the hard one would send SIGKILL, as others do
    const auto seconds = static_cast<std::uint64_t>(limits.cpu_time.count());
    set_limit(RLIMIT_CPU, seconds, seconds + 1);
    _exit(write_all(to, answer_of(work)) ? 0 : 1);
}

/// A running copy; what has not ended is killed.
class Child {
  public:
    explicit Child(pid_t id) : id_(id) {}
    ~Child() {
        if (id_ > 0) {
            kill(id_, SIGKILL);
            wait();
        }
    }
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    /// Its status as waitpid has it.
    int wait() {
        int status = 0;
        while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
        }
        id_ = -1;
        return status;
    }

  private:
    pid_t id_;
};

/// An end of a pipe.
class PipeEnd {
  public:
    explicit PipeEnd(int file) : file_(file) {}
    ~PipeEnd() { close_it(); }
    PipeEnd(const PipeEnd &) = delete;
    PipeEnd &operator=(const PipeEnd &) = delete;
    int file() const { return file_; }
    void close_it() {
        if (file_ >= 0)
            close(file_);
        file_ = -1;
    }

  private:
    int file_;
};

/// Appends all that comes to `bytes`. Returns why it gave up, nothing at the end of the file.
std::optional<End> read_all(int from, const ChildLimits &limits, const Progress &progress,
                            std::string &bytes) {
    using Clock = std::chrono::steady_clock;
    constexpr int kLookEveryMs = 50;
    std::array<char, 1 << 16> block{};
    const Clock::time_point start = Clock::now();
    while (Clock::now() - start < limits.wall_time) {
        look_at_stop(progress);
        pollfd waiting{.fd = from, .events = POLLIN, .revents = 0};
        if (poll(&waiting, 1, kLookEveryMs) <= 0)
            continue;
        const ssize_t got = read(from, block.data(), block.size());
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return std::nullopt;
        bytes.append(block.data(), static_cast<std::size_t>(got));
        if (bytes.size() > limits.result_bytes)
            return End::too_long;
    }
    return End::out_of_wall_time;
}

ChildResult result_of(int status, std::string bytes) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return {End::out_of_cpu_time};
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return {End::killed};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty())
        return {End::failed};
    const char kind = bytes.front();
    bytes.erase(0, 1);
    return {kind == kDone       ? End::done
            : kind == kNoMemory ? End::out_of_memory
                                : End::failed,
            std::move(bytes)};
}

} // namespace

ChildResult run_in_child(const std::function<std::string()> &work, const ChildLimits &limits,
                         const std::string &where, const Progress &progress) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error({"no pipe can be made: " + std::generic_category().message(errno), where,
                     "expected fewer open files"});
    PipeEnd from(ends[0]), to(ends[1]);
    const pid_t parent = getpid(), id = fork();
    if (id < 0)
        throw Error({"no process can be made: " + std::generic_category().message(errno), where,
                     "expected a system with room for one more"});
    if (id == 0) {
        end_with(parent);
        from.close_it(); // so that writing fails where nobody reads
        be_child(to.file(), work, limits);
    }
    Child child(id);
    to.close_it();
    std::string bytes;
    if (const std::optional<End> why = read_all(from.file(), limits, progress, bytes))
        return {*why};
    return result_of(child.wait(), std::move(bytes));
}

} // namespace tsuya::garment
