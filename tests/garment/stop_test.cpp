// Long work on meshes stops soon after it is asked to, and asks for memory before it takes any.

#include <atomic>
#include <fstream>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "expect_stops.h"
#include "test_meshes.h"
#include "tsuya/garment/animation.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/obj.h"
#include "tsuya/garment/ply.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

std::filesystem::path scratch_file(const char *name) {
    return std::filesystem::path(testing::TempDir()) / name;
}

/// A file of two panels with a T-junction.
std::filesystem::path write_mesh() {
    const auto path = scratch_file("stop.obj");
    write_file(path, "g a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                     "f 1/1 2/2 3/3 4/4\ng b\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 0.5 0\n"
                     "f 5/1 6/2 7/3 8/4 9/4\n");
    return path;
}

const std::vector<std::string> kLoading{
    "garment: read",       "garment: repair",  "garment: join seams", "garment: measure",
    "subdivide: topology", "subdivide: rates", "subdivide",           "garment: frames"};

TEST(Stop, LoadingStopsInEveryStage) {
    const auto path = write_mesh();
    tsuya::test::expect_stops_in_every_stage([&](const Progress &p) { load(path, {}, p); },
                                             kLoading);
    tsuya::test::expect_stops_in_every_stage(
        [&](const Progress &p) { load(path, {.subdivide = {.tolerance = 1e-3}}, p); }, kLoading);
}

TEST(Stop, CheckStopsInEveryStage) {
    tsuya::test::expect_stops_in_every_stage(
        [](const Progress &p) { check(test::panel(3, 3, 0.1), {}, p); },
        {"garment: repair", "garment: join seams", "garment: measure"});
}

TEST(Stop, AnimationsStopInEveryStage) {
    const MeshFile file = read_mesh(write_mesh());
    std::vector<std::string> stages(kLoading.begin() + 1, kLoading.end());
    stages.insert(stages.end(), {"subdivide: weights", "subdivide"});
    tsuya::test::expect_stops_in_every_stage(
        [&](const Progress &p) { AnimatedGarment(file, {}, "show", p); }, stages);
}

TEST(Stop, WritingLeavesWhatStoodThere) {
    const Surface surface = load(write_mesh()).surface;
    for (const char *name : {"stop_out.ply", "stop_out.obj"}) {
        const auto path = scratch_file(name);
        write_file(path, "before");
        tsuya::test::expect_stops_in_every_stage(
            [&](const Progress &p) {
                if (path.extension() == ".ply")
                    write_ply(path, surface, p);
                else
                    write_obj(path, surface, p);
                write_file(path, "before");
            },
            {"garment: write"});
        EXPECT_EQ(read_file(path), "before");
    }
}

/// Every reader looks at the flag by itself, also where nobody reports a stage.
TEST(Stop, ReadersStop) {
    const std::atomic<bool> stop = true;
    const Progress progress{.stop = &stop};
    EXPECT_THROW(read_obj(write_mesh(), progress), Interrupted);
    const auto ply = scratch_file("stop_in.ply");
    write_ply(ply, load(write_mesh()).surface);
    EXPECT_THROW(read_ply(ply, progress), Interrupted);
    EXPECT_THROW(subdivide(test::panel(2, 2, 0.1), {}, progress), Interrupted);
}

/// Sets the limit of the address space to what is used and `bytes` more.
class AddressLimit {
  public:
    explicit AddressLimit(std::uint64_t bytes) {
        getrlimit(RLIMIT_AS, &before_);
        std::uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        rlimit limit = before_;
        limit.rlim_cur = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
        setrlimit(RLIMIT_AS, &limit);
    }
    ~AddressLimit() { setrlimit(RLIMIT_AS, &before_); }
    AddressLimit(const AddressLimit &) = delete;
    AddressLimit &operator=(const AddressLimit &) = delete;

  private:
    rlimit before_{};
};

Problem problem_of(const PolygonMesh &mesh, const Options &options) {
    try {
        load(mesh, options, "dress.obj");
    } catch (const Error &error) {
        return error.problems().at(0);
    }
    return {"no error"};
}

TEST(Memory, SaysWhichLevelWouldFit) {
    // 400 faces of 65,536 points at level 8, 5.2 GB; level 6 takes 330 MB.
    const PolygonMesh mesh = test::panel(20, 20, 0.05);
    const AddressLimit limit(1000u << 20);
    const Problem problem = problem_of(mesh, {.subdivide = {.level = 8}});
    EXPECT_EQ(problem.where, "dress.obj: subdivide.level");
    EXPECT_EQ(problem.accepted, "expected at most level 6");
    EXPECT_NE(problem.what.find("26224641 points and 52428800 triangles of level 8 need 5.24 GB"),
              std::string::npos)
        << problem.what;
#ifndef __SANITIZE_ADDRESS__ // which takes address space of its own
    EXPECT_EQ(problem_of(mesh, {.subdivide = {.level = 6}}).what, "no error");
#endif
}

TEST(Memory, RefusesATolerance) {
    const AddressLimit limit(1000u << 20);
    const PolygonMesh torus = test::Torus().mesh(24);
    const Problem problem = problem_of(torus, {.subdivide = {.tolerance = 1e-12}});
    EXPECT_EQ(problem.where, "dress.obj: subdivide.tolerance");
    EXPECT_EQ(problem.accepted, "expected a larger tolerance");
}

TEST(Memory, RefusesMorePointsThanCanBeNumbered) {
    // 4,900,000,000 points
    const Problem problem = problem_of(test::panel(274, 274, 0.01), {.subdivide = {.level = 8}});
    EXPECT_EQ(problem.where, "dress.obj: subdivide.level");
    EXPECT_NE(problem.accepted.find("expected at most level"), std::string::npos);
}

} // namespace
} // namespace tsuya::garment
