#include "tsuya/lab/off_guard.h"

#include <exception>

namespace tsuya::lab {
namespace {

/// Why the line could not be driven off; empty when it is off.
std::string try_off(OutputLine &line) {
    std::string why;
    for (int attempt = 0; attempt < OffGuard::kAttempts; ++attempt) {
        try {
            line.set(false);
            return "";
        } catch (const std::exception &error) {
            why = error.what();
        } catch (...) {
            why = "unknown error";
        }
    }
    return why;
}

} // namespace

// Allocates nothing, so that also running out of memory leaves the lamp off.
OffGuard::~OffGuard() {
    for (OutputLine *line : lines_) {
        bool off = line == nullptr;
        for (int attempt = 0; attempt < kAttempts && !off; ++attempt) {
            try {
                line->set(false);
                off = true;
            } catch (...) { // nobody is left to hear it: drive_off() is the way that reports
            }
        }
    }
}

std::vector<Problem> OffGuard::drive_off() {
    std::vector<Problem> failed;
    for (OutputLine *&line : lines_) {
        if (!line)
            continue;
        const std::string why = try_off(*line);
        if (why.empty())
            line = nullptr;
        else
            failed.push_back({.what = "may still be on, could not be driven off (" + why + ")",
                              .where = line->name(),
                              .accepted = "switch it off by hand"});
    }
    return failed;
}

} // namespace tsuya::lab
