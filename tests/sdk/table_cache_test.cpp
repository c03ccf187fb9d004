// Tables of models that are kept on disk.

#include "tsuya/sdk/table_cache.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "limited_disk.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/kept_materials.h"
#include "tsuya/sdk/model.h"

namespace tsuya::test {
namespace {

namespace fs = std::filesystem;

Fabric cloth_of(Specular specular) {
    return {.name = "cloth",
            .specular = std::move(specular),
            .colours = {.dye = Spectrum::constant(0.4)}};
}
Fabric plain_facets(double alpha) { return cloth_of(GgxFacets{.alpha_weft = alpha}); }
Fabric yarns() { return cloth_of(fit_yarn_lobes(bard_of(satin_cloth()), 0.05)); }

class Tables : public testing::Test {
  protected:
    ~Tables() override { fs::remove_all(folder_); }
    // Of a program that starts with what is on disk.
    TableUse use_of(const Fabric &fabric) const {
        KeptMaterials kept(cache_);
        kept.resolve(fabric, "cloth");
        return kept.use();
    }
    const fs::path folder_ =
        fs::temp_directory_path() / ("tsuya-table-cache-test-" + std::to_string(getpid()));
    const TableCache cache_{.folder = folder_ / "a" / "b"};
    fs::path only_file() const {
        const fs::directory_iterator first(cache_.folder);
        return first->path();
    }
};

template <class Model> std::vector<float> numbers_of(const Model &model) {
    std::vector<float> all;
    const auto add_sample = [&](const std::optional<SampledDirection> &s) {
        if (s)
            all.insert(all.end(), {s->direction.x, s->direction.y, s->weight, s->pdf_per_sr});
    };
    for (int i = 0; i < 300; ++i) {
        const auto u = [&](double step) {
            return static_cast<float>(std::fmod(0.5 + step * i, 1.0));
        };
        const glm::vec3 light = direction(89.0 * u(0.618), 360.0 * u(0.7549));
        const glm::vec3 viewer = direction(89.0 * u(0.5698), 360.0 * u(0.8191));
        const WeighedLight weighed = model.weigh(light, viewer);
        all.insert(all.end(), {weighed.f_cos, weighed.pdf_per_sr, weighed.weft,
                               model.albedo_of_light(light), model.albedo_of_view(viewer)});
        add_sample(model.sample(viewer, {u(0.671), u(0.5497), u(0.35)}));
        add_sample(model.sample_adjoint(light, {u(0.35), u(0.671), u(0.5497)}));
    }
    return all;
}

// The place of the first number that is another; -1 where there is none.
int first_difference(const std::vector<float> &a, const std::vector<float> &b) {
    const auto is_same = [](float x, float y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    const auto [at, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), is_same);
    return at == a.end() && other == b.end() ? -1 : static_cast<int>(at - a.begin());
}

// Every model in the closed set, to the last bit.
TEST_F(Tables, AreReadAsTheyWereMade) {
    const Bard bard = bard_of(satin_cloth()), leaning = bard_of(leaning_cloth());
    std::vector<Fabric> cloths{
        plain_facets(0.2), yarns(),
        cloth_of(TabulatedSpecular{.table = paper_table(satin_cloth(), 15, 45)})};
    for (const ViewModel model : view_models())
        cloths.push_back(cloth_of(CarriedViews{.bard = bard, .model = model}));
    for (const ViewModel model : {ViewModel::yarn, ViewModel::takeda})
        cloths.push_back(cloth_of(CarriedViews{.bard = leaning, .model = model}));
    std::set<std::size_t> models;
    for (const Fabric &cloth : cloths) {
        KeptMaterials makes(cache_), reads(cache_);
        const Material made = makes.resolve(cloth, "cloth");
        const Material read = reads.resolve(cloth, "cloth");
        ASSERT_TRUE(made.specular && read.specular);
        EXPECT_EQ(makes.use().made, 1u);
        EXPECT_EQ(reads.use().made, 0u) << model_of(cloth);
        EXPECT_EQ(reads.use().read, 1u) << model_of(cloth);
        models.insert(made.specular->index());
        EXPECT_EQ(first_difference(numbers_of(*made.specular), numbers_of(*read.specular)), -1)
            << model_of(cloth);
        ASSERT_EQ(made.body != nullptr, read.body != nullptr);
        if (made.body) {
            EXPECT_EQ(first_difference(numbers_of(*made.body), numbers_of(*read.body)), -1)
                << model_of(cloth);
        }
        EXPECT_EQ(made.dye, read.dye);
        EXPECT_EQ(made.of_dye, read.of_dye);
    }
    EXPECT_EQ(models.size(), std::variant_size_v<Brdf::Models>) << "a model was not tried";
}

// What a later dye needs is added to the file.
TEST_F(Tables, OfTheBodyAreAddedWhenADyeComes) {
    Fabric black = yarns();
    black.colours.dye = Spectrum::constant(0);
    EXPECT_EQ(use_of(black).made, 1u);
    EXPECT_EQ(use_of(black).made, 0u);
    EXPECT_EQ(use_of(yarns()).made, 1u);
    EXPECT_EQ(use_of(yarns()).made, 0u);
    Fabric shade = yarns();
    shade.colours.dye = Spectrum::constant(0.1);
    EXPECT_EQ(use_of(shade).made, 0u);
}

TEST_F(Tables, ThatAreDamagedAreMadeAgain) {
    const Fabric cloth = plain_facets(0.2);
    EXPECT_EQ(use_of(cloth).made, 1u);
    const std::string whole = read_file(only_file());
    const auto expect_replaced = [&](const std::string &bytes, const std::string &what) {
        write_file(only_file(), bytes);
        const TableUse use = use_of(cloth);
        EXPECT_EQ(use.made, 1u) << what;
        EXPECT_EQ(use.read, 0u) << what;
        EXPECT_EQ(use.cache_problem, "") << what;
        EXPECT_EQ(read_file(only_file()), whole) << what;
    };
    for (std::size_t i = 0; i < whole.size(); i += whole.size() / 12) {
        std::string bytes = whole;
        bytes[i] = static_cast<char>(bytes[i] ^ 4);
        expect_replaced(bytes, "byte " + std::to_string(i));
        expect_replaced(whole.substr(0, i), "cut at " + std::to_string(i));
    }
    expect_replaced(whole + "more", "longer");
    expect_replaced("tsuya-tables of another build\n" + whole, "another build");
    EXPECT_EQ(use_of(cloth).read, 1u);
}

TEST_F(Tables, ThatWereNotUsedForLongestAreRemoved) {
    EXPECT_EQ(use_of(plain_facets(0.2)).made, 1u);
    const std::uintmax_t size = fs::file_size(only_file());
    const TableCache small{.folder = cache_.folder, .most_bytes = 2 * size + size / 2};
    const auto use = [&](double alpha) {
        KeptMaterials kept(small);
        kept.resolve(plain_facets(alpha), "cloth");
        return kept.use().made;
    };
    const auto age = [&] {
        for (const auto &entry : fs::directory_iterator(cache_.folder))
            fs::last_write_time(entry, entry.last_write_time() - std::chrono::hours(1));
    };
    age();
    EXPECT_EQ(use(0.3), 1u);
    age();
    EXPECT_EQ(use(0.2), 0u) << "used again";
    age();
    EXPECT_EQ(use(0.4), 1u);
    EXPECT_EQ(std::distance(fs::directory_iterator(cache_.folder), {}), 2);
    EXPECT_EQ(use(0.2), 0u);
    EXPECT_EQ(use(0.4), 0u);
    EXPECT_EQ(use(0.3), 1u) << "was not used for longest";
    const TableCache none{.folder = cache_.folder, .most_bytes = size - 1};
    KeptMaterials kept(none);
    kept.resolve(plain_facets(0.5), "cloth");
    EXPECT_EQ(kept.use().cache_problem, "");
}

TEST_F(Tables, CostTimeAloneWhereTheFolderCannotBeWritten) {
    fs::create_directories(folder_);
    write_file(folder_ / "a", "a file in the place of a folder");
    const TableUse use = use_of(plain_facets(0.2));
    EXPECT_EQ(use.made, 1u);
    EXPECT_NE(use.cache_problem.find((folder_ / "a").string()), std::string::npos)
        << use.cache_problem;
    KeptMaterials kept;
    kept.resolve(plain_facets(0.2), "cloth");
    EXPECT_EQ(kept.use().cache_problem, "") << "no folder was given";
}

TEST_F(Tables, CostTimeAloneWhereTheDiskIsFull) {
    const FileSizeLimit limit(1000);
    const TableUse use = use_of(plain_facets(0.2));
    EXPECT_EQ(use.made, 1u);
    EXPECT_NE(use.cache_problem, "");
    EXPECT_TRUE(fs::is_empty(cache_.folder)) << "a part of a file was left";
}

TEST_F(Tables, ServeSeveralProgramsAtOnce) {
    std::vector<std::thread> programs;
    std::atomic<int> wrong{0};
    const std::vector<float> right =
        numbers_of(*KeptMaterials().resolve(plain_facets(0.2), "c").specular);
    for (int program = 0; program < 4; ++program)
        programs.emplace_back([&] {
            for (int i = 0; i < 5; ++i) {
                KeptMaterials kept({.folder = cache_.folder, .most_bytes = 1 << 16});
                for (const double alpha : {0.3, 0.2})
                    if (numbers_of(*kept.resolve(plain_facets(alpha), "c").specular) != right &&
                        alpha == 0.2)
                        ++wrong;
            }
        });
    for (std::thread &program : programs)
        program.join();
    EXPECT_EQ(wrong, 0);
}

TEST(UserCacheFolder, FollowsTheEnvironment) {
    EXPECT_EXIT(
        {
            setenv("HOME", "/people/someone", 1);
            setenv("XDG_CACHE_HOME", "/caches", 1);
            const bool first = user_cache_folder() == "/caches/tsuya";
            setenv("XDG_CACHE_HOME", "relative", 1);
            const bool second = user_cache_folder() == "/people/someone/.cache/tsuya";
            unsetenv("XDG_CACHE_HOME");
            unsetenv("HOME");
            std::_Exit(first && second && user_cache_folder().empty() ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace tsuya::test
