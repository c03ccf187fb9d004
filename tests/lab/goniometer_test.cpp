#include "tsuya/lab/goniometer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <functional>

#include "lab/filament_samples.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

GoniometerSettings few_photons(std::uint64_t batches = 20) {
    return {.photons = batches * kPhotonsPerBatch};
}

Directions two_lights() {
    Directions directions{.pairs = ViewGrid(30, 20, 20).pairs};
    for (const DirectionPair &p : ViewGrid(70, 100, 30).pairs)
        directions.pairs.push_back(p);
    return directions;
}

void expect_same(const Measurement &a, const Measurement &b) {
    ASSERT_EQ(a.table.rows.size(), b.table.rows.size());
    for (std::size_t i = 0; i < a.table.rows.size(); ++i) {
        EXPECT_EQ(a.table.rows[i].brdf_per_sr, b.table.rows[i].brdf_per_sr) << i;
        EXPECT_EQ(a.table.rows[i].sigma_per_sr, b.table.rows[i].sigma_per_sr) << i;
    }
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i)
        EXPECT_EQ(a.lights[i].reflected, b.lights[i].reflected);
}

TEST(Directions, OfTheQuadrantAndThePaper) {
    const Directions quadrant = normal_incidence_quadrant(5);
    EXPECT_EQ(quadrant.pairs.size(), 1u + 17 * 19);
    EXPECT_EQ(quadrant.symmetry, Symmetry::orthotropic);
    const Directions paper = paper_directions();
    EXPECT_EQ(paper.pairs.size(), 16u * (29 * 72 + 1));
    EXPECT_NEAR(paper.pairs.back().theta_i, 75 * kDegree, 1e-12);
    EXPECT_NEAR(paper.pairs.back().phi_r, 355 * kDegree, 1e-12);
    EXPECT_THROW(normal_incidence_quadrant(0), Error);
    EXPECT_THROW(paper_directions(3, 91), Error);
    ReflectanceTable table;
    table.symmetry = Symmetry::half_turn;
    table.rows = {{.theta_i = 0.1, .phi_i = 0.2, .theta_r = 0.3, .phi_r = 0.4}};
    const Directions again = directions_of(table);
    EXPECT_EQ(again.symmetry, Symmetry::half_turn);
    ASSERT_EQ(again.pairs.size(), 1u);
    EXPECT_EQ(again.pairs[0].phi_r, 0.4);
}

TEST(Goniometer, GivesTheRowsThatWereAskedWithTheirErrors) {
    const Directions asked = two_lights();
    const Measurement m = measure(close_layers({}), asked, few_photons());
    ASSERT_EQ(m.table.rows.size(), asked.pairs.size());
    for (std::size_t i = 0; i < asked.pairs.size(); ++i) {
        EXPECT_EQ(m.table.rows[i].theta_r, asked.pairs[i].theta_r);
        EXPECT_GE(m.table.rows[i].brdf_per_sr, 0);
    }
    EXPECT_TRUE(m.table.has_sigma());
    EXPECT_TRUE(m.table.keys.contains("provenance"));
    EXPECT_EQ(m.lights.size(), 2u);
    EXPECT_EQ(m.lights[0].photons, 20 * kPhotonsPerBatch);
    EXPECT_GT(m.rays, m.photons);
}

TEST(Goniometer, DoesNotDependOnTheNumberOfThreads) {
    GoniometerSettings settings = few_photons();
    settings.threads = 1;
    const Measurement one = measure(close_layers({}), two_lights(), settings);
    for (const int threads : {2, 7}) {
        settings.threads = threads;
        expect_same(one, measure(close_layers({}), two_lights(), settings));
    }
    settings.seed = 2;
    EXPECT_NE(one.lights[0].reflected,
              measure(close_layers({}), two_lights(), settings).lights[0].reflected);
}

TEST(Goniometer, StopEndsTheBuildingOfTheBvh) {
    std::atomic<bool> stop{false};
    bool traced = false;
    const Progress progress{.report =
                                [&](std::string_view stage, double) {
                                    traced = traced || stage != "prepare";
                                    stop = true;
                                },
                            .stop = &stop};
    EXPECT_THROW(measure(build_filaments(weave("polyester taffeta")), two_lights(), few_photons(40),
                         progress),
                 Interrupted);
    EXPECT_FALSE(traced);
}

// It comes before the first report, and takes over a second of silk charmeuse.
TEST(Goniometer, StopEndsTheLayingOutOfFilaments) {
    const std::atomic<bool> stop{true};
    int reports = 0;
    EXPECT_THROW(measure(build_filaments(weave("silk habotai")), two_lights(), few_photons(40),
                         {.report = [&](std::string_view, double) { ++reports; }, .stop = &stop}),
                 Interrupted);
    EXPECT_EQ(reports, 0);
}

// Nothing is known of it: 0 would be black cloth.
TEST(Goniometer, ALightWithoutPhotonsIsNotInTheTable) {
    GoniometerSettings settings = few_photons(1);
    settings.seconds = 1e-9;
    const Measurement m = measure(close_layers({}), two_lights(), settings);
    EXPECT_EQ(m.lights.size(), 2u);
    EXPECT_EQ(m.photons, 0u);
    EXPECT_TRUE(m.table.rows.empty());
}

TEST(Goniometer, GoesOnWhereItWasStopped) {
    GoniometerSettings settings = few_photons(40);
    const Measurement whole = measure(close_layers({}), two_lights(), settings);
    settings.checkpoint =
        std::filesystem::temp_directory_path() /
        ("goniometer_test." + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
         std::to_string(reinterpret_cast<std::uintptr_t>(&settings)));
    settings.resume = true;
    std::atomic<bool> stop{false};
    int rounds = 0;
    const Progress progress{.report = [&](std::string_view stage,
                                          double) { stop = stage != "prepare" && ++rounds == 2; },
                            .stop = &stop};
    const Measurement part = measure(close_layers({}), two_lights(), settings, progress);
    EXPECT_TRUE(part.interrupted);
    EXPECT_LT(part.photons, whole.photons);
    ASSERT_TRUE(std::filesystem::exists(settings.checkpoint));

    GoniometerSettings other = settings;
    other.seed = 7;
    EXPECT_THROW(measure(close_layers({}), two_lights(), other), Error);

    const Measurement rest = measure(close_layers({}), two_lights(), settings);
    EXPECT_EQ(rest.photons + part.photons, whole.photons);
    expect_same(whole, rest);
    EXPECT_TRUE(std::filesystem::remove(settings.checkpoint)) << "the caller removes it";
}

TEST(Goniometer, StopsWhenTheErrorIsReached) {
    GoniometerSettings settings = few_photons(4000);
    settings.error = 0.05;
    const Measurement m = measure(close_layers({}), two_lights(), settings);
    for (const LightReport &light : m.lights) {
        EXPECT_LE(light.relative_error, 0.05);
        EXPECT_LT(light.photons, settings.photons);
    }
}

TEST(Goniometer, NeitherMakesNorLosesLight) {
    // What enters comes out again: every photon ends above or below with all its energy
    for (const FilamentSection section :
         {FilamentSection::round, FilamentSection::triangular, FilamentSection::trilobal}) {
        const FilamentOptics clear{.section = section, .transmission = 1.0};
        const Measurement m = measure(close_layers(clear), two_lights(), few_photons(4));
        for (const LightReport &light : m.lights) {
            EXPECT_NEAR(light.reflected + light.transmitted, 1, 1e-12);
            EXPECT_GT(light.reflected, 0.1);
        }
        // Control: a filament that keeps a thousandth
        const FilamentOptics dim{.section = section, .transmission = 0.999};
        for (const LightReport &light :
             measure(close_layers(dim), two_lights(), few_photons(4)).lights)
            EXPECT_LT(light.reflected + light.transmitted, 1 - 1e-4);
        const FilamentOptics black{.section = section};
        for (const LightReport &light :
             measure(close_layers(black), two_lights(), few_photons(4)).lights)
            EXPECT_LT(light.reflected + light.transmitted, 0.9);
    }
}

/// Where an error says that it is, or an empty string where there is none.
std::string where_of(const std::function<void()> &action) {
    try {
        action();
    } catch (const Error &error) {
        return error.problems().front().where;
    }
    return "";
}

TEST(Goniometer, RefusesWhatItCannotMeasure) {
    const FilamentRepeat good = close_layers({});
    const auto where = [](const FilamentRepeat &repeat, const Directions &directions,
                          const GoniometerSettings &settings) {
        return where_of([&] { measure(repeat, directions, settings); });
    };
    EXPECT_EQ(where(good, {}, few_photons()), "directions");
    EXPECT_EQ(where(good, {.pairs = {{0, 0, 90 * kDegree, 0}}}, few_photons()),
              "directions.pairs[0]");
    // By rounding below 90 degrees, but on the horizon: its values would be divided by nearly 0
    EXPECT_EQ(where(good, {.pairs = {{0, 0, 90 * kDegree - 1e-13, 0}}}, few_photons()),
              "directions.pairs[0]");
    EXPECT_EQ(where(good, {.pairs = {{-0.1, 0, 0, 0}}}, few_photons()), "directions.pairs[0]");
    EXPECT_EQ(where(good, two_lights(), {.photons = 0}), "settings.photons");
    EXPECT_EQ(where(good, two_lights(), {.error = -1}), "settings.error");
    EXPECT_EQ(where(good, two_lights(), {.seconds = -1}), "settings.seconds");
    EXPECT_EQ(where(good, two_lights(), {.threads = -1}), "settings.threads");
    EXPECT_EQ(where(good, two_lights(), {.energy_bound = 0}), "settings.energy_bound");
    EXPECT_EQ(where(good, two_lights(), {.section_points = 3}), "settings.section_points");
    FilamentRepeat bad = good;
    bad.filaments.clear();
    EXPECT_EQ(where(bad, two_lights(), few_photons()), "repeat");
    bad = good;
    bad.optics[1].surface_roughness = 0;
    EXPECT_EQ(where(bad, two_lights(), few_photons()), "repeat.optics[1].surface_roughness");
    bad = good;
    bad.optics[0].transmission = 1.5;
    EXPECT_EQ(where(bad, two_lights(), few_photons()), "repeat.optics[0].transmission");
}

} // namespace
} // namespace tsuya::lab
