#pragma once
// Files of one test, and the problems of reading them.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"

namespace tsuya::test {

// A folder of its own for every test, gone afterwards.
class FilesTest : public testing::Test {
  protected:
    FilesTest()
        : folder_(std::filesystem::temp_directory_path() /
                  ("tsuya_files_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~FilesTest() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const std::string &name) const { return folder_ / name; }
    std::filesystem::path file(const std::string &name, const std::string &text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }
    bool is_empty() const { return std::filesystem::is_empty(folder_); }

    // The problems that `read` throws, with the file's name cut off their places.
    template <class Read>
    std::vector<Problem> problems_of(const Read &read, const std::filesystem::path &name) const {
        try {
            read(name);
        } catch (const Error &error) {
            std::vector<Problem> problems = error.problems();
            for (Problem &p : problems) {
                EXPECT_EQ(p.where.substr(0, name.string().size()), name.string());
                p.where.erase(0, name.string().size());
            }
            return problems;
        }
        ADD_FAILURE() << "expected an Error";
        return {{}};
    }

  private:
    std::filesystem::path folder_;
};

} // namespace tsuya::test
