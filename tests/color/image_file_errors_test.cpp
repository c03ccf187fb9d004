// Pictures that cannot be read or written: what is told, and what is left.

#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "color_test.h"
#include "limited_disk.h"
#include "some_pictures.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/print_file.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

using namespace tsuya::test;

TEST(ImageFile, RefusesWhatAFormatHasNot) {
    const test::Folder folder;
    const Image image = ramp(4, 4, {"R", "G", "B"}), alpha = ramp(4, 4, {"R", "G", "B", "A"});
    const auto refused = [&](const char *name, const Image &shown,
                             const PictureFileOptions &options, const char *part) {
        const std::filesystem::path file = folder / name;
        test::expect_problem([&] { write_picture(file, shown, options); }, file.string(), part);
    };
    refused("a.gif", image, {}, "no picture has this ending");
    refused("a.jpg", image, {.bits = 16}, "no samples of 16 bits");
    refused("a.png", image, {.bits = 12}, "no samples of 12 bits");
    refused("a.jpg", alpha, {}, "a JPEG has no alpha");
    refused("a.tif", image, {.display = "Rec.2100-PQ"}, "expected a PNG");
    EXPECT_EQ(folder.size(), 0);
}

TEST(ImageFile, RefusesWrongFiles) {
    const test::Folder folder;
    const auto absent = folder / "absent.png";
    test::expect_problem([&] { read_image(absent); }, absent.string(), "no such file");
    test::expect_problem([&] { read_image(folder / ""); }, (folder / "").string(),
                         "no regular file");
    const auto empty = folder.write("empty.png", "");
    test::expect_problem([&] { read_image(empty); }, empty.string(), "cannot read");
}

TEST(ImageFile, FailedWriteLeavesNothing) {
    const test::Folder folder;
    const auto nowhere = folder / "no/where.exr";
    test::expect_problem([&] { write_exr(nowhere, ramp(4, 4, {"Y"})); }, nowhere.string(),
                         "folder");
    std::filesystem::create_directory(folder / "taken.png");
    test::expect_problem([&] { write_png(folder / "taken.png", ramp(4, 4, {"Y"})); },
                         (folder / "taken.png").string(), "cannot be written");
    test::expect_problem([&] { write_exr("/proc/full.exr", ramp(4, 4, {"Y"})); }, "/proc/full.exr",
                         "cannot be written");
    const auto bad = folder / "bad.exr";
    test::expect_problem(
        [&] {
            write_exr(bad, ramp(4, 4, {"Y", "Y"}));
        },
        bad.string(), "two channels have the name 'Y'");
    test::expect_problem([&] { write_exr(bad, ramp(4, 4, {""})); }, bad.string(), "no name");
    test::expect_problem([&] { write_exr(bad, Image{}); }, bad.string(), "0 x 0");
    test::expect_problem([&] { write_exr(folder / "bad.tif", ramp(4, 4, {"Y"})); },
                         (folder / "bad.tif").string(), "expected NAME.exr");
    EXPECT_EQ(folder.size(), 1); // the folder taken.png
}

bool names_missing_space(const std::filesystem::path &folder) {
    Image noise = Image::make(100, 80, {"R", "G", "B"});
    std::mt19937 random(5);
    for (float &v : noise.data)
        v = std::uniform_real_distribution<float>(0, 1)(random);
    const auto names_space = [&](const auto &write) {
        try {
            write();
        } catch (const Error &error) {
            return error.problems()[0].accepted == "expected space on the disk";
        }
        return false;
    };
    return names_space([&] { write_png(folder / "p.png", noise, 16); }) &&
           names_space([&] { write_exr(folder / "p.exr", noise); }) &&
           std::filesystem::is_empty(folder);
}

TEST(ImageFile, AFullDiskIsNamed) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    test::expect_on_small_disk(16, names_missing_space);
}

TEST(ImageFile, ALimitOfFileSizesKeepsTheOldFile) {
    const test::Folder folder;
    const Image small = ramp(4, 4, {"R", "G", "B"});
    Image large = Image::make(50, 40, {"R", "G", "B"});
    std::mt19937 random(5);
    for (float &v : large.data) // noise does not shrink
        v = std::uniform_real_distribution<float>(0, 1)(random);
    for (const char *name : {"p.png", "p.exr"}) {
        const auto path = folder / name;
        const bool png = path.extension() == ".png";
        const auto write = [&](const Image &image) {
            png ? write_png(path, image, 16) : write_exr(path, image);
        };
        write(small);
        {
            const test::FileSizeLimit limit(1000);
            test::expect_problem([&] { write(large); }, path.string(), "of this size");
        }
        EXPECT_EQ(read_image(path).width, 4);
    }
    EXPECT_EQ(folder.size(), 2);
}

/// The process has at most so many bytes more than now while it lives.
class MemoryLimit {
  public:
    explicit MemoryLimit(rlim_t bytes) {
        getrlimit(RLIMIT_AS, &saved_);
        rlim_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes,
                           saved_.rlim_max};
        setrlimit(RLIMIT_AS, &limit);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &saved_); }
    MemoryLimit(const MemoryLimit &) = delete;
    MemoryLimit &operator=(const MemoryLimit &) = delete;

  private:
    rlimit saved_{};
};

// A header may declare any size.
TEST(ImageFile, APictureThatDoesNotFitIntoTheMemoryIsNamed) {
    const test::Folder folder;
    write_png(folder / "loads_the_module.png", ramp(4, 4, {"Y"}));
    const auto picture = folder.write("p.pnm", "P6\n60000 60000\n65535\n");
    const std::string says = "60000 x 60000 pixels of 3 channels need ";
    const MemoryLimit limit(1'000'000'000);
    test::expect_problem([&] { read_image(picture); }, picture.string(), says);
    test::expect_problem([&] { read_artwork(picture); }, picture.string(), says);
    test::expect_problem([&] { read_frame(picture, {}); }, picture.string(), says);
}

TEST(ImageFile, ACauseIsToldOnce) {
    const test::Folder folder;
    write_png(folder / "p.png", ramp(64, 64, {"R", "G", "B"}));
    std::filesystem::resize_file(folder / "p.png", 100);
    const std::string text = test::error_of([&] { read_image(folder / "p.png"); }).what();
    const std::size_t cause = text.find("Read error: hit end of file");
    ASSERT_NE(cause, std::string::npos) << text;
    EXPECT_EQ(text.find("Read error: hit end of file", cause + 1), std::string::npos) << text;
}

// libpng has a habit of writing to stderr by itself.
TEST(ImageFile, NothingIsWrittenBesideTheError) {
    const test::Folder folder;
    write_png(folder / "p.png", ramp(64, 64, {"R", "G", "B"}));
    std::string bytes = read_file(folder / "p.png");
    const auto short_one = folder.write("short.png", bytes.substr(0, bytes.size() / 2));
    bytes[bytes.find("IDAT") + 5] = '\xff'; // of the compressed data's header
    const auto damaged = folder.write("damaged.png", bytes);
    testing::internal::CaptureStderr();
    for (const auto &path : {short_one, damaged})
        for (int again = 0; again < 2; ++again)
            test::expect_problem([&, p = path] { read_artwork(p); }, path.string(),
                                 "PNG read error");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFile, RefusesWrongPictures) {
    const test::Folder folder;
    const auto png = folder / "p.png";
    test::expect_problem(
        [&] {
            write_png(png, ramp(4, 4, {"a", "b"}));
        },
        png.string(), "2 channels");
    test::expect_problem([&] { write_png(png, ramp(4, 4, {"Y"}), 10); }, png.string(),
                         "expected 8 or 16");
    Image nan = ramp(4, 4, {"R", "G", "B"});
    nan.pixel(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
    test::expect_problem([&] { write_png(png, nan); }, png.string(), "column 2, row 1");
    EXPECT_EQ(folder.size(), 0);
}

} // namespace
} // namespace tsuya
