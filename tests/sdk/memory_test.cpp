// How much memory a process may still take.

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

namespace fs = std::filesystem;

/// A file system with a proc and control groups of its own.
class Memory : public testing::Test {
  protected:
    Memory() {
        write("proc/meminfo", "MemTotal:  9000 kB\nMemAvailable:  8000 kB\nSwapFree:  2 kB\n");
    }
    ~Memory() override { fs::remove_all(root_); }
    void write(const fs::path &file, const std::string &text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }
    const fs::path root_ =
        fs::temp_directory_path() / ("tsuya-memory-test-" + std::to_string(getpid()));
};

TEST_F(Memory, OfTheMachineCountsSwap) { EXPECT_EQ(detail::available_memory(root_), 8002u * 1024); }

TEST_F(Memory, OfAControlGroupCountsItsFileCacheAsFree) {
    write("proc/self/cgroup", "0::/jobs/one\n");
    write("sys/fs/cgroup/jobs/one/memory.max", "max\n");
    write("sys/fs/cgroup/jobs/one/memory.current", "700\n");
    EXPECT_EQ(detail::available_memory(root_), 8002u * 1024);
    write("sys/fs/cgroup/jobs/memory.max", "5000\n"); // of the group that holds it
    write("sys/fs/cgroup/jobs/memory.current", "1000\n");
    write("sys/fs/cgroup/jobs/memory.stat", "anon 600\ninactive_file 400\n");
    EXPECT_EQ(detail::available_memory(root_), 4400u);
    write("sys/fs/cgroup/jobs/memory.current", "6000\n");
    EXPECT_EQ(detail::available_memory(root_), 0u);
}

TEST_F(Memory, OfAControlGroupOfTheFirstVersion) {
    write("proc/self/cgroup", "5:cpu:/\n4:memory:/docker/seen/from/the/host\n");
    write("sys/fs/cgroup/memory/memory.limit_in_bytes", "3000\n");
    write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000\n");
    EXPECT_EQ(detail::available_memory(root_), 2000u);
}

// In a process of its own, whose address space is limited.
TEST(NeedMemory, NamesTheBytesAndWhatFits) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer takes address space of its own";
#endif
    const auto limited = [] {
        const rlimit limit{1u << 20, 1u << 20}; // less than is in use
        setrlimit(RLIMIT_AS, &limit);
        try {
            detail::need_memory(2'000'000'000, "9 pixels", "camera", "expected 3 pixels");
        } catch (const Error &error) {
            const Problem &p = error.problems()[0];
            std::_Exit(p.what == "9 pixels need 2.00 GB of memory and 0 bytes are available" &&
                               p.where == "camera" && p.accepted == "expected 3 pixels"
                           ? 3
                           : 4);
        }
        std::_Exit(0);
    };
    EXPECT_EXIT(limited(), testing::ExitedWithCode(3), "");
    detail::need_memory(1, "few bytes", "", "");
}

TEST(ByteText, HasThreeDigits) {
    EXPECT_EQ(detail::byte_text(0), "0 bytes");
    EXPECT_EQ(detail::byte_text(999), "999 bytes");
    EXPECT_EQ(detail::byte_text(1500), "1.50 kB");
    EXPECT_EQ(detail::byte_text(999'999), "1.00 MB");
    EXPECT_EQ(detail::byte_text(34'359'738'368), "34.4 GB");
    EXPECT_EQ(detail::byte_text(~0ull), "18.4 EB");
}

} // namespace
} // namespace tsuya::test
