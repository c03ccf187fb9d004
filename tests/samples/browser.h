#pragma once
// A headless Chromium that is driven over a pipe, by the DevTools protocol.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace tsuya::program {

/// The path of chromium, empty where there is none.
std::string find_chromium();

/// A browser with one page. It ends with the object. Failures throw std::runtime_error.
class Browser {
  public:
    /// \param profile an empty folder that the browser may fill
    Browser(const std::string &program, const std::filesystem::path &profile);
    ~Browser();
    Browser(const Browser &) = delete;
    Browser &operator=(const Browser &) = delete;

    /// Opens a file and waits until it is loaded.
    void open(const std::filesystem::path &file);
    /// The value of an expression, of a promise what it is fulfilled with.
    nlohmann::json evaluate(const std::string &expression);
    /// A window of so many pixels. \param touch as a phone's
    void resize(int width, int height, bool touch);
    /// A PNG of the window.
    void screenshot(const std::filesystem::path &file);
    /// Errors and warnings of the console and exceptions since the browser started.
    const std::vector<std::string> &complaints() const { return complaints_; }

  private:
    nlohmann::json call(const std::string &method, nlohmann::json parameters);
    nlohmann::json read_message();
    void note(const nlohmann::json &event);

    pid_t process_ = -1;
    int to_browser_ = -1, from_browser_ = -1;
    int calls_ = 0;
    bool loaded_ = false;
    std::string session_{}, waiting_{};
    std::vector<std::string> complaints_{};
};

} // namespace tsuya::program
