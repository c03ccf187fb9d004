#pragma once
// Disks and files that end early.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace tsuya::test {

/// Files of this process and its children end at so many bytes while it lives.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &saved_);
        const rlimit limit{bytes, saved_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        previous_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &saved_);
        std::signal(SIGXFSZ, previous_);
    }
    FileSizeLimit(const FileSizeLimit &) = delete;
    FileSizeLimit &operator=(const FileSizeLimit &) = delete;

  private:
    rlimit saved_{};
    void (*previous_)(int) = nullptr;
};

/// Puts a disk of so many kilobytes over a folder, for this process alone: in a child that has no
/// threads yet. \return false where the system does not allow it
inline bool mount_small_disk(const std::filesystem::path &folder, int kilobytes) {
    const uid_t user = getuid();
    if (unshare(CLONE_NEWNS) != 0) {
        if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
            return false;
        std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    }
    const std::string options = "size=" + std::to_string(kilobytes) + "k";
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
}

/// Ends this process: with 77 if there can be no small disk, else with 0 if `is_good(folder)` is
/// true of a folder that is a disk of so many kilobytes.
template <class Check> [[noreturn]] void end_on_small_disk(int kilobytes, const Check &is_good) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("tsuya-small-disk-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    int status = 77;
    if (mount_small_disk(folder, kilobytes)) {
        status = is_good(folder) ? 0 : 1;
        umount2(folder.c_str(), MNT_DETACH);
    }
    std::filesystem::remove(folder);
    std::_Exit(status);
}

/// Expects `is_good(folder)` of a disk of so many kilobytes, in a process of its own. Skips the
/// test where the system allows no such disk.
template <class Check> void expect_on_small_disk(int kilobytes, const Check &is_good) {
    bool refused = false;
    EXPECT_EXIT(
        end_on_small_disk(kilobytes, is_good),
        [&](int status) {
            refused = WIFEXITED(status) && WEXITSTATUS(status) == 77;
            return refused || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
        },
        "");
    if (refused)
        GTEST_SKIP() << "tsuya: skipped: this system mounts no disk for a test";
}

} // namespace tsuya::test
