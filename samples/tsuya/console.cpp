#include "console.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <iostream>
#include <span>

#include <signal.h>
#include <unistd.h>

#include "command.h"
#include "json.h"
#include "tsuya/garment/report.h"

namespace tsuya::program {
namespace {

std::atomic<bool> stop{false}; // a signal handler can only reach something global
static_assert(std::atomic<bool>::is_always_lock_free);

std::atomic<bool> snapshot{false};

constexpr std::array kEnding{SIGINT, SIGTERM, SIGHUP};
constexpr std::array kShielded{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP};

void handle(std::span<const int> signals, void (*handler)(int), int flags) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    for (const int signal : signals) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (signal != SIGHUP || before.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
}

void handle_signals(void (*handler)(int)) {
    handle(kEnding, handler, static_cast<int>(SA_RESETHAND));
}

std::string text_of(const Problem &problem) {
    return (problem.where.empty() ? "" : problem.where + ": ") + problem.what +
           (problem.accepted.empty() ? "" : "; " + problem.accepted);
}

constexpr int kBarWidth = 40;
constexpr int kPlainStep = 10; // percent between lines

} // namespace

std::string shown(std::string_view text, std::string_view kept) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte_at = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0xFFu;
    };
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned byte = byte_at(i);
        const bool c0 = (byte < 0x20 || byte == 0x7F) && kept.find(text[i]) == kept.npos;
        // U+0080 to U+009F
        const bool c1 = byte == 0xC2 && byte_at(i + 1) >= 0x80 && byte_at(i + 1) < 0xA0;
        const std::size_t count = c0 ? 1 : c1 ? 2 : 0;
        for (std::size_t k = 0; k < count; ++k) {
            out += "\\x";
            out += kDigits[byte_at(i + k) >> 4];
            out += kDigits[byte_at(i + k) & 15];
        }
        if (count == 0)
            out += text[i];
        i += count == 2 ? 1 : 0;
    }
    return out;
}

ProgressMode parse_progress_mode(const std::string &name) {
    if (name == "auto")
        return isatty(STDERR_FILENO) != 0 ? ProgressMode::bar : ProgressMode::off;
    if (name == "plain")
        return ProgressMode::plain;
    return name == "json" ? ProgressMode::json : ProgressMode::off;
}

void watch_signals() {
    signal(SIGUSR1, SIG_IGN); // a render that has begun listens to it, and nothing dies of it
    handle_signals([](int) {
        constexpr std::string_view kText = "\ntsuya: interrupted\n";
        [[maybe_unused]] const auto told = write(STDERR_FILENO, kText.data(), kText.size());
        _exit(kInterrupted);
    });
}

SignalShield::SignalShield() {
    handle(
        kShielded, [](int) { stop = true; }, 0);
    struct sigaction ignored {};
    ignored.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignored, nullptr);
}

// No word to stderr, which may be the pipe that is full.
SignalShield::~SignalShield() {
    handle(
        kShielded, [](int) { _exit(kInterrupted); }, 0);
}

std::atomic<bool> &watch_snapshot_signal() {
    struct sigaction action {};
    action.sa_handler = [](int) { snapshot = true; };
    action.sa_flags = SA_RESTART;
    sigaction(SIGUSR1, &action, nullptr);
    return snapshot;
}

Progress Console::progress() {
    handle_signals([](int) { stop = true; });
    Progress progress{.stop = &stop};
    if (mode_ != ProgressMode::off)
        progress.report = [this](std::string_view stage, double fraction) {
            report(stage, fraction);
        };
    return progress;
}

void Console::report(std::string_view stage, double fraction) {
    const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
    if (stage == stage_ && percent == told_percent_)
        return;
    const bool new_step = stage != stage_ || percent / kPlainStep != told_percent_ / kPlainStep;
    stage_ = stage;
    told_percent_ = percent;
    if (mode_ == ProgressMode::json) {
        const Json line{{"schema", "tsuya-progress 1"},
                        {"stage", stage_},
                        {"fraction", std::clamp(fraction, 0.0, 1.0)}};
        std::cerr << line.one_line() + "\n";
    } else if (mode_ == ProgressMode::plain) {
        if (new_step)
            std::cerr << shown(stage_) + " " + std::to_string(percent) + " %\n";
    } else {
        const auto full = static_cast<std::size_t>(percent * kBarWidth / 100);
        std::cerr << "\r\033[K[" + std::string(full, '#') + std::string(kBarWidth - full, ' ') +
                         "] " + std::to_string(percent) + " % " + shown(stage_)
                  << std::flush;
        line_open_ = true;
    }
}

void Console::end_line() {
    if (line_open_)
        std::cerr << "\n";
    line_open_ = false;
}

void Console::error(std::string_view text) {
    end_line();
    std::cerr << "tsuya: " << shown(text, "\n\t") << "\n";
}

void Console::error(const Problem &problem) { error(text_of(problem)); }

void Console::errors(const Error &error) {
    for (const Problem &problem : error.problems())
        this->error(problem);
}

void Console::warning(std::string_view text) { error("warning: " + std::string(text)); }

void Console::warning(const Problem &problem) { warning(text_of(problem)); }

void Console::warnings(const Error &error) {
    for (const Problem &problem : error.problems())
        warning(problem);
}

void Console::warnings(const std::vector<std::string> &texts) {
    for (const std::string &text : texts)
        warning(text);
}

void Console::warnings(const garment::Report &report, const std::string &file) {
    for (const garment::Finding &finding : report.findings)
        if (finding.severity == garment::Severity::warning)
            warning(file + ": " + finding.what +
                    (finding.where.empty() ? "" : " (" + finding.where + ")") +
                    (finding.action.empty() ? "" : "; " + finding.action));
}

} // namespace tsuya::program
