#include "tsuya/lab/command_run.h"

#include "tsuya/sdk/error.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

constexpr std::chrono::milliseconds kLook{10}; // at a program that runs
constexpr std::size_t kKeptText = 400;         // bytes of the end of what it printed

/// A child in its own process group; nothing of it is left afterwards.
class Child {
  public:
    Child(const std::vector<std::string> &words, const CommandRun &how) : how_(how) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
            throw Error({std::string("no pipe: ") + std::strerror(errno), words[0], ""});
        output_ = ends[0];
        const int code = spawn(words, ends[1]);
        close(ends[1]);
        if (code != 0) {
            close(output_);
            throw Error({std::string("the program cannot be started: ") + std::strerror(code),
                         words[0], "expected a program that is installed"});
        }
        if (how_.on_group)
            how_.on_group(process_);
    }
    ~Child() {
        kill(-process_, SIGKILL);
        if (!ended_)
            waitpid(process_, nullptr, 0);
        if (how_.on_group)
            how_.on_group(0);
        close(output_);
    }
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    bool ended() {
        take_output();
        // Not reaped yet: until the group is killed its number belongs to it.
        siginfo_t info{};
        if (!ended_ &&
            waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
            info.si_pid == process_) {
            kill(-process_, SIGKILL);
            ended_ = waitpid(process_, &status_, 0) == process_;
            take_output();
        }
        return ended_;
    }
    int status() const { return status_; }
    const std::string &printed() const { return printed_; }

  private:
    int spawn(const std::vector<std::string> &words, int output) {
        std::vector<char *> arguments;
        for (const std::string &word : words)
            arguments.push_back(const_cast<char *>(word.c_str())); // as execve asks
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
        posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
        posix_spawnattr_t how;
        posix_spawnattr_init(&how);
        sigset_t all;
        sigfillset(&all);
        posix_spawnattr_setsigdefault(&how, &all);
        posix_spawnattr_setpgroup(&how, 0);
        posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
        const int code =
            posix_spawnp(&process_, arguments[0], &files, &how, arguments.data(), environ);
        posix_spawnattr_destroy(&how);
        posix_spawn_file_actions_destroy(&files);
        return code;
    }

    void take_output() {
        std::array<char, 512> part{};
        for (ssize_t got; (got = read(output_, part.data(), part.size())) > 0;) {
            printed_.append(part.data(), static_cast<std::size_t>(got));
            if (printed_.size() > kKeptText)
                printed_.erase(0, printed_.size() - kKeptText);
        }
    }

    const CommandRun &how_;
    pid_t process_ = 0;
    int output_ = -1, status_ = 0;
    bool ended_ = false;
    std::string printed_{};
};

std::string end_of(const Child &child) {
    std::string text = child.printed();
    text.erase(text.find_last_not_of(" \r\n\t") + 1);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "" : ": " + text;
}

} // namespace

std::vector<std::string> filled_in(const std::vector<std::string> &command,
                                   const std::map<std::string, std::string> &values) {
    std::vector<std::string> words;
    for (const std::string &word : command) {
        std::string &filled = words.emplace_back();
        for (std::size_t at = 0; at < word.size();) {
            const std::size_t end = word[at] == '{' ? word.find('}', at) : std::string::npos;
            const auto value = end == std::string::npos
                                   ? values.end()
                                   : values.find(word.substr(at + 1, end - at - 1));
            if (value == values.end()) {
                filled += word[at++];
            } else {
                filled += value->second;
                at = end + 1;
            }
        }
    }
    return words;
}

void run_command(const std::vector<std::string> &words, Clock &clock, const CommandRun &how) {
    Child child(words, how); // which may have to be read from a slow disk first
    const Waiting waiting(clock);
    const auto deadline = clock.now() + std::chrono::round<std::chrono::nanoseconds>(how.timeout);
    while (!child.ended()) {
        if (clock.now() >= deadline)
            throw Error({"the program was killed: it was not done in time" + end_of(child),
                         words[0], "expected an end within its timeout_s"});
        if (!clock.sleep_until(std::min(deadline, clock.now() + kLook), how.stop))
            throw Interrupted("stopped while " + words[0] + " ran");
    }
    if (WIFSIGNALED(child.status()))
        throw Error({std::string("the program was killed by ") +
                         strsignal(WTERMSIG(child.status())) + end_of(child),
                     words[0], "expected status 0"});
    if (WEXITSTATUS(child.status()) != 0)
        throw Error({"the program returned status " + std::to_string(WEXITSTATUS(child.status())) +
                         end_of(child),
                     words[0], "expected status 0"});
}

} // namespace tsuya::lab
