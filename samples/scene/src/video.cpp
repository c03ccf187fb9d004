#include "tsuya/scene/video.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

/// What ffmpeg takes literally in a pattern of numbered files.
std::string escaped(const std::string &name) {
    std::string text;
    for (const char c : name)
        text += c == '%' ? "%%" : std::string(1, c);
    return text;
}

std::vector<std::string> call(const fs::path &to, const fs::path &pictures, int frames_per_second) {
    // A relative name may begin as an option does, or as a protocol
    const auto named = [](const fs::path &path) { return fs::absolute(path).string(); };
    return {"ffmpeg",
            "-nostdin",
            "-hide_banner",
            "-loglevel",
            "error",
            "-y",
            "-framerate",
            std::to_string(frames_per_second),
            "-i",
            escaped(named(pictures)) + "-%04d.png",
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
            "-c:v",
            "libx264",
            "-crf",
            "17",
            "-pix_fmt",
            "yuv420p",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-movflags",
            "+faststart",
            named(to)};
}

/// Both ends of a pipe, closed at the end.
struct Pipe {
    std::array<int, 2> end{-1, -1};
    Pipe() {
        if (pipe2(end.data(), O_CLOEXEC) != 0)
            end = {-1, -1};
    }
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe &) = delete;
    Pipe &operator=(const Pipe &) = delete;
    void close_end(std::size_t i) {
        if (end[i] >= 0)
            close(end[i]);
        end[i] = -1;
    }
    std::string read_all() {
        std::string text;
        std::array<char, 4096> part{};
        for (ssize_t n = 1; n > 0;) {
            n = ::read(end[0], part.data(), part.size());
            if (n > 0)
                text.append(part.data(), static_cast<std::size_t>(n));
            else if (n < 0 && errno == EINTR)
                n = 1;
        }
        return text;
    }
};

/// Runs a program of the PATH. \return what it said on stderr where it failed, else empty
std::string failure_of(std::vector<std::string> words) {
    std::vector<char *> arguments;
    for (std::string &word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    Pipe errors;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, errors.end[1], STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int code =
        posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0)
        return "it cannot be started: " + std::string(std::strerror(code));
    errors.close_end(1);
    std::string said = errors.read_all();
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return {};
    return said.empty() ? "it ended without a message" : said.substr(0, said.find('\n'));
}

} // namespace

void write_video(const fs::path &file, const fs::path &pictures, int frames_per_second) {
    const fs::path part = temporary_name(file);
    const std::string failure = failure_of(call(part, pictures, frames_per_second));
    if (failure.empty())
        return replace_file(part, file);
    std::error_code ignored;
    fs::remove(part, ignored);
    throw Error({"ffmpeg made no video: " + failure, file.string(),
                 "expected the program ffmpeg with libx264 on the PATH; the pictures are there"});
}

} // namespace tsuya::scene
