#pragma once
// A folder for one test, and small files to put in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "tsuya/sdk/file.h"

namespace tsuya::scene {

/// An empty folder of the running test, another one for each object; removed at the end.
class Scratch {
  public:
    Scratch() {
        const auto *test = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string("tsuya-") + test->test_suite_name() + "-" + test->name() +
                           "-" + std::to_string(getpid()) + "-" + std::to_string(++count_);
        std::replace(name.begin(), name.end(), '/', '-'); // of parameterised tests
        folder_ = std::filesystem::temp_directory_path() / name;
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~Scratch() { std::filesystem::remove_all(folder_); }
    Scratch(const Scratch &) = delete;
    Scratch &operator=(const Scratch &) = delete;

    const std::filesystem::path &folder() const { return folder_; }
    std::filesystem::path operator/(const std::string &name) const { return folder_ / name; }
    std::filesystem::path write(const std::string &name, const std::string &text) const {
        write_file(folder_ / name, text);
        return folder_ / name;
    }
    std::size_t file_count() const {
        std::size_t count = 0;
        for (const auto &entry : std::filesystem::recursive_directory_iterator(folder_))
            count += entry.is_regular_file() ? 1 : 0;
        return count;
    }

  private:
    inline static int count_ = 0;
    std::filesystem::path folder_;
};

/// A piece of cloth, 0.4 x 0.6 m upright at z = 0 with a pattern of the same size.
inline const char *cloth_obj() {
    return "g panel\nv -0.2 0 0\nv 0.2 0 0\nv 0.2 0.6 0\nv -0.2 0.6 0\n"
           "vt 0 0\nvt 0.4 0\nvt 0.4 0.6\nvt 0 0.6\nf 1/1 2/2 3/3 4/4\n";
}

/// A complete scene of that cloth in `cloth.obj`, 16 x 20 pixels; what is in `more` comes last.
inline std::string small_scene(const std::string &more = "") {
    return "[camera]\nwidth = 16\nheight = 20\n"
           "[fabrics.silk]\ndye = \"crimson\"\n"
           "[garments.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n"
           "[lights.key]\ncentre = [-1, 1, 2]\ntarget = [0, 0.3, 0]\n"
           "[environment]\nradiance = 0.2\ngroup = \"fill\"\n"
           "[render]\nsamples_per_pixel = 4\n" +
           more;
}

} // namespace tsuya::scene
