#include "tsuya/color/image_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <link.h>

#include "color_test.h"
#include "limited_disk.h"
#include "some_pictures.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/color/print_file.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/file.h"

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

TEST(ImageFile, TwoFilesOfOnePictureHaveTheSameBytes) {
    const test::Folder folder;
    const Image image = Image::make(40, 300, {"R", "G", "B"});
    for (const char *const ending : {".exr", ".png"}) {
        const auto bytes = [&](const std::string &name) {
            if (std::string(ending) == ".png")
                write_png(folder / (name + ending), image);
            else
                write_exr(folder / (name + ending), image);
            return read_file(folder / (name + ending));
        };
        const std::string first = bytes("a");
        std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // another second
        EXPECT_EQ(first, bytes("b")) << ending;
    }
}

// As PNG has it: colours are not multiplied by alpha, in the file and where it is read as artwork.
TEST(ImageFile, PngHasUnassociatedAlpha) {
    const test::Folder folder;
    Image image = Image::make(3, 1, {"R", "G", "B", "A"});
    image.data = {1, 0.6f, 0.2f, 0.4f, 0.8f, 0.8f, 0.8f, 0, 0.4f, 1, 0, 1};
    write_png(folder / "a.png", image);
    const Texture back = read_artwork(folder / "a.png");
    ASSERT_EQ(back.channels, 4);
    for (const std::size_t i : {0, 1, 2, 3, 7, 8, 9, 10, 11})
        EXPECT_NEAR(back.data[i], 255 * image.data[i], 0.51f) << i;
}

TEST(ImageFile, PngKeepsCodeValues) {
    const test::Folder folder;
    for (const auto &channels : {std::vector<std::string>{"Y"}, {"R", "G", "B"}}) {
        const Image image = ramp(31, 17, channels);
        for (const int bits : {8, 16}) {
            write_png(folder / "p.png", image, bits);
            const Image back = read_image(folder / "p.png");
            ASSERT_EQ(back.width, 31);
            ASSERT_EQ(back.height, 17);
            ASSERT_EQ(back.channels.size(), channels.size());
            for (std::size_t i = 0; i < image.data.size(); ++i)
                ASSERT_NEAR(back.data[i], image.data[i], 1e-6f) << i;
        }
    }
    EXPECT_EQ(folder.size(), 1);
}

/// The bytes of a chunk of a PNG, without its length and sum; empty where it has none.
std::string chunk_of(const std::string &png, const std::string &name) {
    for (std::size_t at = 8; at + 8 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(png[at + i]);
        if (png.substr(at + 4, 4) == name)
            return png.substr(at + 8, length);
        at += 12 + length;
    }
    return "";
}

TEST(ImageFile, WritesWhatTheEndingSays) {
    const test::Folder folder;
    const Image image = ramp(31, 17, {"R", "G", "B"});
    for (const char *name : {"a.png", "a.tif", "a.tiff"})
        for (const int bits : {8, 16}) {
            write_picture(folder / name, image, {.bits = bits});
            const Image back = read_image(folder / name);
            ASSERT_EQ(back.channels.size(), 3u) << name;
            for (std::size_t i = 0; i < image.data.size(); ++i)
                ASSERT_NEAR(back.data[i], image.data[i], 1e-6f) << name << i;
        }
    Image flat = Image::make(32, 16, {"R", "G", "B"});
    for (std::size_t i = 0; i < flat.data.size(); ++i)
        flat.data[i] = i % 3 == 0 ? 0.8f : 0.3f;
    for (const char *name : {"a.jpg", "a.jpeg"}) {
        write_picture(folder / name, flat);
        EXPECT_NEAR(read_image(folder / name).data[300], 0.8f, 0.02f) << name;
        EXPECT_NEAR(read_image(folder / name).data[301], 0.3f, 0.02f) << name;
    }
    const Image alpha = ramp(5, 4, {"R", "G", "B", "A"});
    write_picture(folder / "alpha.tif", alpha, {.bits = 16});
    EXPECT_EQ(read_image(folder / "alpha.tif").channels.size(), 4u);
}

TEST(ImageFile, CarriesTheProfileOfItsDisplay) {
    const test::Folder folder;
    const Image image = ramp(16, 16, {"R", "G", "B"});
    const auto written = [&](const char *name, const PictureFileOptions &options) {
        write_picture(folder / name, image, options);
        return read_file(folder / name);
    };
    EXPECT_FALSE(chunk_of(written("a.png", {}), "sRGB").empty());
    EXPECT_EQ(chunk_of(written("a.png", {}), "iCCP"), "");
    const std::string wide = written("wide.png", {.display = "Display P3"});
    EXPECT_FALSE(chunk_of(wide, "iCCP").empty());
    EXPECT_EQ(chunk_of(wide, "sRGB"), "");
    EXPECT_EQ(wide, written("again.png", {.display = "Display P3"})); // no date in it
    for (const char *name : {"wide.tif", "wide.jpg"})
        EXPECT_NE(written(name, {.display = "Display P3"}).find("acsp"), std::string::npos) << name;
    // Its name, in UTF-16
    EXPECT_NE(written("wide.tif", {.display = "Display P3"})
                  .find(std::string("\0P\0"
                                    "3",
                                    4)),
              std::string::npos);
    EXPECT_EQ(chunk_of(written("pq.png", {.bits = 16, .display = "Rec.2100-PQ"}), "cICP"),
              std::string("\x09\x10\x00\x01", 4));
    EXPECT_EQ(chunk_of(written("hlg.png", {.display = "Rec.2100-HLG"}), "cICP"),
              std::string("\x09\x12\x00\x01", 4));
    EXPECT_NEAR(read_image(folder / "pq.png").data[17], image.data[17], 1e-5f); // the sum is right
    EXPECT_EQ(chunk_of(written("none.png", {.display = ""}), "sRGB"), "");
}

TEST(ImageFile, ExrStatesItsPrimaries) {
    const test::Folder folder;
    const Image image = ramp(8, 8, {"R", "G", "B"});
    write_exr(folder / "a.exr", image, {.primaries = kRec709});
    const std::string bytes = read_file(folder / "a.exr");
    const std::size_t at = bytes.find(std::string("chromaticities\0chromaticities\0", 30));
    ASSERT_NE(at, std::string::npos);
    float red_x = 0;
    std::memcpy(&red_x, bytes.data() + at + 34, sizeof red_x);
    EXPECT_EQ(red_x, 0.64f);
    write_exr(folder / "b.exr", image);
    EXPECT_EQ(read_file(folder / "b.exr").find("chromaticities"), std::string::npos);
}

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

TEST(ImageFile, PngClampsAndRounds) {
    const test::Folder folder;
    write_png(folder / "p.png",
              Image{3, 1, {"Y"}, {-0.5f, std::numeric_limits<float>::infinity(), 100.4f / 255}});
    const Image back = read_image(folder / "p.png");
    EXPECT_EQ(back.data[0], 0.0f);
    EXPECT_EQ(back.data[1], 1.0f);
    EXPECT_NEAR(back.data[2], 100.0f / 255, 1e-6f);
}

TEST(ImageFile, ExrIsExactAndKeepsNames) {
    const test::Folder folder;
    Image image = ramp(40, 33, {"Z", "b", "X", "layer.q"});
    image.data[5] = std::numeric_limits<float>::infinity();
    image.data[6] = 1e-30f;
    write_exr(folder / "x.exr", image);
    const Image back = read_image(folder / "x.exr");
    ASSERT_EQ(back.channels.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c) {
        const auto at = static_cast<std::size_t>(
            std::find(back.channels.begin(), back.channels.end(), image.channels[c]) -
            back.channels.begin());
        ASSERT_LT(at, 4u) << image.channels[c];
        for (std::size_t p = 0; p < image.data.size(); p += 4)
            ASSERT_EQ(back.data[p + at], image.data[p + c]);
    }
    write_exr(folder / "half.exr", image, {.samples = SampleType::half});
    EXPECT_LT(std::filesystem::file_size(folder / "half.exr"),
              std::filesystem::file_size(folder / "x.exr"));
}

TEST(ImageFile, TallPictureIsExact) {
    // More rows than are written at once.
    const test::Folder folder;
    Image image = Image::make(3, 333, {"Y"});
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<float>(i);
    write_exr(folder / "tall.exr", image);
    EXPECT_EQ(read_image(folder / "tall.exr").data, image.data);
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

TEST(ImageFile, RefusesWrongFiles) {
    const test::Folder folder;
    const auto absent = folder / "absent.exr";
    test::expect_problem([&] { read_spectral_exr(absent); }, absent.string(), "no such file");
    test::expect_problem([&] { read_image(folder / ""); }, (folder / "").string(),
                         "no regular file");
    const auto text = folder.write("text.exr", "silk");
    test::expect_problem([&] { read_spectral_exr(text); }, text.string(), "cannot read");
    const auto empty = folder.write("empty.png", "");
    test::expect_problem([&] { read_image(empty); }, empty.string(), "cannot read");
    const auto png = folder / "p.png";
    write_png(png, ramp(8, 8, {"R", "G", "B"}));
    test::expect_problem([&] { read_spectral_exr(png); }, png.string(), "no spectral picture");
    const auto plain = folder / "plain.exr";
    write_exr(plain, ramp(8, 8, {"R", "G", "B"}));
    test::expect_problem([&] { read_spectral_exr(plain); }, plain.string(), "no spectral picture");
}

TEST(ImageFile, RefusesDamagedSpectralFiles) {
    const test::Folder folder;
    const auto whole = folder / "whole.exr";
    write_spectral_exr(whole, some_transport());
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    for (const double part : {0.02, 0.3, 0.6, 0.99}) {
        const auto cut = folder.write(
            "cut.exr",
            bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
        test::expect_problem([&] { read_spectral_exr(cut); }, cut.string(), "cannot read");
    }
    const auto replaced = [&](const std::string &from, const std::string &to) {
        std::string changed = bytes;
        for (std::size_t at = 0; (at = changed.find(from, at)) != std::string::npos;
             at += to.size())
            changed.replace(at, from.size(), to);
        return folder.write("changed.exr", changed);
    };
    auto path = replaced("T.420,000nm", "T.421,000nm");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(),
                         "the channel 'T.420,000nm' is missing");
    path = replaced("transport.key", "transport.kei");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(),
                         "the part 'transport.key' is missing");
    path = replaced("tsuya-spectral-2", "tsuya-spectral-9");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya-spectral-9");
    path = replaced("hat 16 ", "hat -1 ");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya:basis");
    path = replaced("tsuya:group.0", "tsuya:grove.0");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya:group.0");
}

TEST(ImageFile, FailedWriteLeavesNothing) {
    const test::Folder folder;
    const auto nowhere = folder / "no/where.exr";
    test::expect_problem([&] { write_spectral_exr(nowhere, some_transport()); }, nowhere.string(),
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

    const auto exr = folder / "t.exr";
    SpectralImage image = some_transport();
    image.transport.pop_back();
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "values");
    image = some_transport();
    image.aovs[0].width = 36;
    EXPECT_THROW(write_spectral_exr(exr, image), Error);
    image = some_transport();
    image.aov_names.pop_back();
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "given with");
    image = some_transport();
    image.groups[1] = "key";
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "two light groups");
    image.groups[1] = "";
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "no name");
    image = some_transport();
    image.alpha = ramp(37, 28, {"A"});
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "alpha");
    image = some_transport();
    for (const std::array<int, 4> &window :
         {std::array{0, 0, 38, 29}, {-1, 0, 37, 29}, {5, 5, 5, 9}, {0, 9, 37, 3}}) {
        image.data_window = window;
        test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "data window");
    }
    EXPECT_EQ(folder.size(), 0);
}

} // namespace
} // namespace tsuya
