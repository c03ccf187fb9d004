#include "gnuplot.h"

#include <cerrno>
#include <cstring>
#include <sstream>
#include <string_view>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

// Removed at the end, whatever happens.
struct Temporary {
    fs::path path;
    ~Temporary() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
};

// A name in single quotes, as gnuplot wants it.
std::string quoted(const fs::path &path) {
    std::string text = "'";
    for (const char c : path.string())
        text += c == '\'' ? std::string("''") : std::string(1, c);
    return text + "'";
}

// Exit status; what the program says goes to a file.
int spawn_gnuplot(const fs::path &script, const fs::path &said) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, said.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    std::string program = "gnuplot", argument = script.string();
    char *const arguments[] = {program.data(), argument.data(), nullptr};
    pid_t process = 0;
    const int failed =
        posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed == ENOENT)
        throw Error({"the program gnuplot is not installed", "gnuplot",
                     "expected it on the PATH; on Debian: apt-get install gnuplot-nox"});
    if (failed != 0)
        throw Error(
            {std::string("gnuplot cannot be started: ") + std::strerror(failed), "gnuplot"});
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// In one line.
std::string flattened(const std::string &text) {
    std::istringstream in(text);
    std::string line, word;
    while (in >> word)
        line += (line.empty() ? "" : " ") + word;
    return line;
}

// Gnuplot's SVG without the groups that hold nothing, a sixth of it.
void drop_empty_groups(const fs::path &svg) {
    constexpr std::string_view kOpening = "<g ", kClosing = ">\n</g>\n";
    const std::string text = read_file(svg);
    std::string kept;
    std::size_t done = 0;
    while (true) {
        const std::size_t from = text.find(kOpening, done);
        if (from == std::string::npos)
            break;
        const std::size_t end = text.find('>', from);
        kept.append(text, done, from - done);
        if (end == std::string::npos || text.compare(end, kClosing.size(), kClosing) != 0) {
            kept += kOpening;
            done = from + kOpening.size();
        } else {
            done = end + kClosing.size();
        }
    }
    write_file(svg, kept + text.substr(done));
}

} // namespace

void run_gnuplot(const std::string &script, const fs::path &file, int width, int height) {
    prepare_output_file(file, {".svg", ".png"});
    const Temporary picture{temporary_name(file)};
    const Temporary commands{temporary_name(fs::path(file).replace_extension(".gnuplot"))};
    const Temporary said{temporary_name(fs::path(file).replace_extension(".log"))};
    const std::string size = " size " + std::to_string(width) + "," + std::to_string(height);
    const std::string terminal = file.extension() == ".svg" ? "svg" : "pngcairo";
    write_file(commands.path, "set encoding utf8\nset terminal " + terminal + size +
                                  " font 'DejaVu Sans,12' background 'white'\nset output " +
                                  quoted(picture.path) + "\n" + script);
    if (spawn_gnuplot(commands.path, said.path) != 0)
        throw Error({"gnuplot failed: " + flattened(read_file(said.path)), file.string()});
    if (terminal == "svg")
        drop_empty_groups(picture.path);
    fs::rename(picture.path, file);
}

} // namespace tsuya::scene
