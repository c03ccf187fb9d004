// The libraries and the threads that pictures take.

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>
#include <link.h>

#include "color_test.h"
#include "some_pictures.h"
#include "tsuya/color/image_file.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya {
namespace {

using namespace tsuya::test;

// Of this process, those whose file has the text in its name.
int count_libraries(const char *text) {
    struct Search {
        const char *text;
        int found;
    } search{text, 0};
    dl_iterate_phdr(
        [](dl_phdr_info *library, std::size_t, void *data) {
            auto &of = *static_cast<Search *>(data);
            of.found += std::strstr(library->dlpi_name, of.text) ? 1 : 0;
            return 0;
        },
        &search);
    return search.found;
}

// In a process of its own, which has read no picture.
TEST(ImageFile, WritingLoadsNoReader) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            const test::Folder folder;
            Image image = Image::make(3, 2, {"R", "G", "B"});
            write_exr(folder / "a.exr", image);
            write_png(folder / "a.png", image);
            std::_Exit(count_libraries("OpenEXR") > 0 ? count_libraries("OpenImageIO") : 99);
        },
        testing::ExitedWithCode(0), "");
}

std::size_t threads_of_process() {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

// OpenEXR keeps the threads of the last picture.
TEST(ImageFile, ThreadsAreThoseOfTheCaller) {
    const test::Folder folder;
    const Image image = ramp(64, 64, {"Y"});
    const auto write = [&](int threads) {
        detail::run_with_threads(threads, [&] { write_exr(folder / "a.exr", image); });
        return threads_of_process();
    };
    const std::size_t one = write(1), nine = write(9);
    EXPECT_GE(nine, one + 9 - 2); // some may be ending
    std::size_t again = write(1);
    for (int wait = 0; wait < 500 && again > nine - 9; ++wait) { // threads take time to end
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        again = threads_of_process();
    }
    EXPECT_LE(again, nine - 9);
    detail::run_with_threads(9, [&] { read_image(folder / "a.exr"); });
    EXPECT_GE(threads_of_process(), one + 2 * 8 - 2);
}

} // namespace
} // namespace tsuya
