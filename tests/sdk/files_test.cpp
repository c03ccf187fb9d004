// Errors, files, checkpoints and what else long work shares.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limited_disk.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/checkpoint.h"
#include "tsuya/sdk/detail/hasher.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::test {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
  protected:
    Files() { fs::create_directories(folder_); }
    ~Files() override { fs::remove_all(folder_); }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    const fs::path folder_ =
        fs::temp_directory_path() / ("tsuya-files-test-" + std::to_string(getpid()));
};

template <class Work> Problem problem_of(Work &&work) {
    try {
        work();
    } catch (const Error &error) {
        return error.problems().at(0);
    }
    ADD_FAILURE() << "expected an Error";
    return {};
}

TEST_F(Files, AFailedReplacementKeepsWhatStoodThere) {
    const fs::path file = folder_ / "a.txt";
    write_file(file, "old");
    {
        const FileSizeLimit limit(1000);
        const Problem p = problem_of([&] { write_file(file, std::string(100'000, 'x')); });
        EXPECT_EQ(p.where, file.string());
        EXPECT_NE(p.accepted.find("of this size"), std::string::npos) << p.accepted;
    }
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(entries(), 1u) << "no temporary file stays";
}

TEST_F(Files, AnAbandonedReplacementLeavesNothing) {
    const fs::path file = folder_ / "a.txt";
    {
        FileReplacement replacement(file);
        replacement.write("half");
    }
    EXPECT_EQ(entries(), 0u);
}

// A process that is killed while it writes leaves nothing beside the file.
TEST_F(Files, AKilledReplacementLeavesNothing) {
    const int unnamed = open(folder_.c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (unnamed < 0)
        GTEST_SKIP() << "the file system has no files without names";
    close(unnamed);
    const fs::path file = folder_ / "a.txt";
    write_file(file, "old");
    const pid_t child = fork();
    if (child == 0) {
        FileReplacement replacement(file);
        replacement.write(std::string(100'000, 'x'));
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(entries(), 1u);
    EXPECT_EQ(read_file(file), "old");
}

// One that had the number of this process before, on a file system without files without names
TEST_F(Files, AnOldTemporaryFileIsInNobodysWay) {
    const fs::path file = folder_ / "a.txt";
    std::ofstream(temporary_name(file)) << "half";
    write_file(file, "new");
    EXPECT_EQ(read_file(file), "new");
    EXPECT_EQ(entries(), 1u);
    const auto permissions = fs::status(file).permissions();
    const fs::path plain = folder_ / "plain.txt";
    std::ofstream(plain) << "x";
    EXPECT_EQ(permissions, fs::status(plain).permissions());
}

TEST(FileErrors, SayWhatWouldHelp) {
    EXPECT_EQ(accepted_for_writing(ENOSPC), "expected space on the disk");
    EXPECT_NE(accepted_for_writing(ENOENT).find("folder that exists"), std::string::npos);
    const Problem p = problem_of([] { write_file("/nonexistent/folder/a", ""); });
    EXPECT_NE(p.accepted.find("folder that exists"), std::string::npos) << p.accepted;
}

TEST(FileErrors, AFullDiskIsNamed) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "no /dev/full here";
    std::ofstream full("/dev/full", std::ios::binary);
    errno = 0;
    full << std::string(100'000, 'x') << std::flush;
    EXPECT_FALSE(full);
    EXPECT_EQ(accepted_for_writing(errno), "expected space on the disk");
}

TEST_F(Files, ACheckpointReadsBackAndRefusesOthers) {
    const fs::path file = folder_ / "a.checkpoint";
    const std::vector<float> sums{1, 2, 3};
    const detail::Fingerprint print{.input = 7, .settings = 9};
    detail::CheckpointWriter out(file, "test 1", print);
    out.value(42);
    out.array(std::span(sums));
    out.commit();

    detail::CheckpointReader in(file, "test 1", print);
    int value = 0;
    std::vector<float> found(3);
    in.value(value);
    in.array(std::span(found));
    in.finish();
    EXPECT_EQ(value, 42);
    EXPECT_EQ(found, sums);

    using Reader = detail::CheckpointReader;
    const auto refused = [&](const char *kind, const detail::Fingerprint &of) {
        return problem_of([&] { Reader(file, kind, of); }).what;
    };
    EXPECT_EQ(refused("test 1", {8, 9}), "the checkpoint is of other input");
    EXPECT_EQ(refused("test 1", {7, 8}), "the checkpoint is of other settings");
    EXPECT_EQ(refused("test 1", {8, 8}), "the checkpoint is of other input and other settings");
    EXPECT_EQ(refused("rest 1", print), "the file is no checkpoint of rest 1");
}

// Whichever byte is wrong: it is never taken for another scene, and never read as a number.
TEST_F(Files, ADamagedCheckpointIsCalledSo) {
    const fs::path file = folder_ / "a.checkpoint";
    const detail::Fingerprint print{.input = 7, .settings = 9};
    detail::CheckpointWriter out(file, "test 1", print);
    out.value(42);
    out.commit();
    const std::string good = read_file(file);
    const auto read = [&] {
        detail::CheckpointReader in(file, "test 1", print);
        int value = 0;
        in.value(value);
        in.finish();
    };
    read();
    const std::size_t head = std::string("tsuya-checkpoint test 1\n").size();
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 4);
        write_file(file, bad);
        EXPECT_EQ(problem_of(read).what.rfind(i < head ? "the file is no checkpoint of test 1"
                                                       : "the checkpoint is damaged: ",
                                              0),
                  0u)
            << i;
    }
    for (std::size_t size = head; size < good.size(); ++size) {
        write_file(file, good.substr(0, size));
        EXPECT_EQ(problem_of(read).what, "the checkpoint is damaged: it is cut off") << size;
    }
    write_file(file, good + "x");
    EXPECT_EQ(problem_of(read).what, "the checkpoint is damaged: it is longer than its content");
}

TEST(Hasher, TellsNeighboursApart) {
    const auto of = [](auto... texts) {
        detail::Hasher h;
        (h.text(texts), ...);
        return h.result();
    };
    EXPECT_EQ(of("ab", "c"), of("ab", "c"));
    EXPECT_NE(of("ab", "c"), of("a", "bc"));
    EXPECT_NE(of("ab"), of("ba"));
    // [FNV] 64 bits, of the byte 'a', from the published test vectors
    detail::Hasher h;
    h.value('a');
    EXPECT_EQ(h.result(), 0xaf63dc4c8601ec8cull);
}

TEST(Problems, AreCollectedUpToTheLimit) {
    Problems problems;
    problems.throw_if_any();
    EXPECT_TRUE(problems.need(true, "fine", "here", ""));
    for (int i = 0; i < 100; ++i)
        problems.need(false, "wrong", "place " + std::to_string(i), "right");
    EXPECT_TRUE(problems.full());
    try {
        problems.throw_if_any();
        ADD_FAILURE() << "expected an Error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().size(), kMaxProblems);
        EXPECT_EQ(error.at("there").problems()[3].where, "there");
        EXPECT_EQ(error.within("a.toml").problems()[3].where, "a.toml: place 3");
        EXPECT_EQ(error.within("place").problems()[3].where, "place 3");
    }
    EXPECT_EQ(accepted_names("x", {}), "there is none to choose from");
}

TEST(Angles, TheHorizonIsNotAboveIt) {
    for (const double theta : {90 * kDegree, kPi / 2, std::numbers::pi / 2})
        for (const double phi : {0.0, 1.0, -2.0})
            EXPECT_EQ(direction_of(theta, phi).z, 0.0);
    EXPECT_GT(direction_of(89.999999 * kDegree, 0).z, 0.0);
    EXPECT_NEAR(glm::length(direction_of(0.7, 2.1) - glm::dvec3(std::sin(0.7) * std::cos(2.1),
                                                                std::sin(0.7) * std::sin(2.1),
                                                                std::cos(0.7))),
                0, 1e-15);
}

} // namespace
} // namespace tsuya::test
