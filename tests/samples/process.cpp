#include "samples/process.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tsuya::program {
namespace {

std::string text_of(const std::filesystem::path &file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

[[noreturn]] void become(std::vector<char *> &arguments, const char *out, const char *err) {
    setenv("XDG_CACHE_HOME", TSUYA_TEST_CACHE, 0);
    const int flags = O_CREAT | O_WRONLY | O_TRUNC;
    const int to_out = open(out, flags, 0600), to_err = open(err, flags, 0600);
    const int from_nothing = open("/dev/null", O_RDONLY);
    if (dup2(from_nothing, STDIN_FILENO) < 0 || dup2(to_out, STDOUT_FILENO) < 0 ||
        dup2(to_err, STDERR_FILENO) < 0)
        _exit(126);
    execv(arguments[0], arguments.data());
    _exit(127);
}

} // namespace

Outcome run_program(const std::vector<std::string> &arguments, const std::filesystem::path &scratch,
                    const std::function<int(const std::string &err)> &signal_for) {
    const std::string out = scratch.string() + ".out", err = scratch.string() + ".err";
    std::vector<std::string> all{TSUYA_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char *> pointers;
    for (std::string &argument : all)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);

    const pid_t child = fork();
    if (child < 0)
        throw std::runtime_error("no new process");
    if (child == 0)
        become(pointers, out.c_str(), err.c_str());
    int status = 0;
    while (waitpid(child, &status, signal_for ? WNOHANG : 0) == 0) {
        if (const int signal = signal_for(text_of(err)); signal != 0)
            kill(child, signal);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const Outcome run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return run;
}

std::function<int(const std::string &)> once(int signal, std::string text) {
    return [signal, text = std::move(text), sent = false](const std::string &err) mutable {
        if (sent || err.find(text) == std::string::npos)
            return 0;
        sent = true;
        return signal;
    };
}

} // namespace tsuya::program
