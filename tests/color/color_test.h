#pragma once
/// \file
/// What the tests of `color` share.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::test {

/// An empty folder that goes away with the object.
class Folder {
  public:
    Folder() {
        std::random_device random;
        path_ = std::filesystem::temp_directory_path() / ("tsuya-" + std::to_string(random()));
        std::filesystem::create_directory(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::filesystem::path operator/(const std::string &name) const { return path_ / name; }
    std::filesystem::path write(const std::string &name, const std::string &text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }
    /// Number of files in the folder, hidden ones too.
    std::ptrdiff_t size() const {
        return std::distance(std::filesystem::directory_iterator(path_), {});
    }

  private:
    std::filesystem::path path_;
};

/// The error that `action` throws; fails and gives an empty one if it throws none.
template <class Action> Error error_of(const Action &action) {
    try {
        action();
    } catch (const Error &error) {
        return error;
    }
    ADD_FAILURE() << "no tsuya::Error was thrown";
    return Error({"", "", ""});
}

/// Expects one problem at `where`, whose text contains `part`.
template <class Action>
void expect_problem(const Action &action, const std::string &where, const std::string &part) {
    const Error error = error_of(action);
    ASSERT_EQ(error.problems().size(), 1u) << error.what();
    EXPECT_EQ(error.problems()[0].where, where);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
}

/// The folder of outside data, or an empty path.
inline std::filesystem::path outside_data() {
    const char *folder = std::getenv("TSUYA_TEST_DATA");
    return folder ? folder : "";
}

/// The folder of small inputs that show a kind of fault, or an empty path.
inline std::filesystem::path outside_cases() {
    const char *folder = std::getenv("TSUYA_TEST_CASES");
    return folder ? folder : "";
}

} // namespace tsuya::test
