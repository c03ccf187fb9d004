#include "samples/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "tsuya/sdk/file.h"

extern char **environ;

namespace tsuya::program {
namespace {

using nlohmann::json;

constexpr int kPatienceMs = 120'000;   // for one answer, on a busy machine
constexpr int kReads = 3, kWrites = 4; // the browser's ends of the pipes
constexpr int kOutOfTheWay = 10;

struct Pipe {
    int read = -1, write = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error("no pipe");
    Pipe made{fcntl(ends[0], F_DUPFD_CLOEXEC, kOutOfTheWay),
              fcntl(ends[1], F_DUPFD_CLOEXEC, kOutOfTheWay)};
    close(ends[0]);
    close(ends[1]);
    return made;
}

std::string bytes_of_base64(const std::string &text) {
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const char *const digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::string_view all(digits);
        const std::size_t value = all.find(c);
        if (value == std::string_view::npos)
            break;
        bits = bits << 6 | static_cast<unsigned>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> count & 0xff);
        }
    }
    return bytes;
}

} // namespace

std::string find_chromium() {
    std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string program = folder + "/chromium"; access(program.c_str(), X_OK) == 0)
            return program;
    return "";
}

Browser::Browser(const std::string &program, const std::filesystem::path &profile) {
    const Pipe in = make_pipe(), out = make_pipe();
    std::vector<std::string> words{program,
                                   "--headless=new",
                                   "--no-sandbox",
                                   "--use-gl=angle",
                                   "--use-angle=swiftshader",
                                   "--enable-unsafe-swiftshader",
                                   "--force-color-profile=srgb",
                                   "--hide-scrollbars",
                                   "--disable-dev-shm-usage",
                                   "--no-first-run",
                                   "--remote-debugging-pipe",
                                   "--user-data-dir=" + profile.string(),
                                   "about:blank"};
    std::vector<char *> arguments;
    for (std::string &word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.read, kReads);
    posix_spawn_file_actions_adddup2(&actions, out.write, kWrites);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const int failed =
        posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(in.read);
    close(out.write);
    to_browser_ = in.write;
    from_browser_ = out.read;
    if (failed)
        throw std::runtime_error("cannot start " + program);
    const json made = call("Target.createTarget", {{"url", "about:blank"}});
    const json attached =
        call("Target.attachToTarget", {{"targetId", made.at("targetId")}, {"flatten", true}});
    session_ = attached.at("sessionId");
    for (const char *domain : {"Page.enable", "Runtime.enable", "Log.enable"})
        call(domain, json::object());
}

Browser::~Browser() {
    if (to_browser_ >= 0)
        close(to_browser_); // it ends with its pipe
    if (from_browser_ >= 0)
        close(from_browser_);
    if (process_ > 0) {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
}

json Browser::read_message() {
    while (true) {
        if (const std::size_t end = waiting_.find('\0'); end != std::string::npos) {
            const json message = json::parse(waiting_.substr(0, end));
            waiting_.erase(0, end + 1);
            return message;
        }
        pollfd ready{from_browser_, POLLIN, 0};
        std::array<char, 65536> buffer{};
        if (poll(&ready, 1, kPatienceMs) <= 0)
            throw std::runtime_error("the browser does not answer");
        const ssize_t count = read(from_browser_, buffer.data(), buffer.size());
        if (count <= 0)
            throw std::runtime_error("the browser has ended");
        waiting_.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

void Browser::note(const json &event) {
    const std::string method = event.value("method", "");
    if (method == "Page.loadEventFired")
        loaded_ = true;
    if (method == "Runtime.exceptionThrown")
        complaints_.push_back(event.at("params").dump());
    if (method == "Runtime.consoleAPICalled" && event["params"]["type"] != "log")
        complaints_.push_back(event.at("params").at("args").dump());
    if (method == "Log.entryAdded" && event["params"]["entry"]["level"] == "error")
        complaints_.push_back(event.at("params").at("entry").dump());
}

json Browser::call(const std::string &method, json parameters) {
    json message{{"id", ++calls_}, {"method", method}, {"params", std::move(parameters)}};
    if (!session_.empty())
        message["sessionId"] = session_;
    std::string text = message.dump();
    text += '\0';
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t count = write(to_browser_, text.data() + sent, text.size() - sent);
        if (count <= 0)
            throw std::runtime_error("the browser has ended");
        sent += static_cast<std::size_t>(count);
    }
    while (true) {
        json answer = read_message();
        if (answer.value("id", -1) != calls_) {
            note(answer);
            continue;
        }
        if (answer.contains("error"))
            throw std::runtime_error(method + ": " + answer["error"].dump());
        return answer.at("result");
    }
}

void Browser::open(const std::filesystem::path &file) {
    loaded_ = false;
    call("Page.navigate", {{"url", "file://" + file.string()}});
    while (!loaded_)
        note(read_message());
}

json Browser::evaluate(const std::string &expression) {
    const json result =
        call("Runtime.evaluate",
             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (result.contains("exceptionDetails"))
        throw std::runtime_error(result["exceptionDetails"].dump());
    return result.at("result").value("value", json());
}

void Browser::resize(int width, int height, bool touch) {
    call("Emulation.setDeviceMetricsOverride", {{"width", width},
                                                {"height", height},
                                                {"deviceScaleFactor", touch ? 2 : 1},
                                                {"mobile", touch}});
    call("Emulation.setTouchEmulationEnabled", {{"enabled", touch}});
}

void Browser::screenshot(const std::filesystem::path &file) {
    const json shot = call("Page.captureScreenshot", {{"format", "png"}});
    write_file(file, bytes_of_base64(shot.at("data")));
}

} // namespace tsuya::program
