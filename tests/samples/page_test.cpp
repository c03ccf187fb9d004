// The live page in a browser: its pixels beside the program's own, and what its script says.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

#include "samples/browser.h"
#include "samples/program_run.h"
#include "samples/scratch.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/live_page.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/color/upsample.h"

namespace tsuya::program {
namespace {

using nlohmann::json;

constexpr int kWidth = 160, kHeight = 200;

/// What a pixel of a dyed cloth sends on at a reflectance: a gloss, and light between its folds.
double sent_on(int x, int y, double reflectance) {
    const double u = x / double{kWidth}, v = y / double{kHeight};
    const double gloss = 0.03 + 0.8 * std::exp(-300 * std::pow(u - 0.3 - 0.1 * std::sin(9 * v), 2));
    const double folds = 0.25 + 0.2 * std::sin(20 * u + 3 * v), light = 0.15 + 0.75 * v;
    return light * (0.2 * gloss + reflectance * (1 - folds) / (1 - folds * reflectance));
}

/// Two light groups, a dye that is open, a backdrop of a grey; or 16 channels of wavelengths.
SpectralImage make_dress(bool open) {
    SpectralImage image =
        SpectralImage::make(kWidth, kHeight, {.count = open ? 8 : 16}, {"key", "fill"});
    if (open)
        image.depths = make_dye_depths(
            {{.name = "satin", .dye = dye("white"), .open = true, .lowest = 0, .highest = 0.98}},
            8);
    const std::vector<float> printed = project(dye("turquoise"), image.basis);
    Image coverage = Image::make(kWidth, kHeight, {"A"});
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool garment = std::abs(x - kWidth / 2) < 20 + y / 4;
            *coverage.pixel(x, y) = garment;
            for (int k = 0; k < image.basis.count; ++k) {
                const auto channel = static_cast<std::size_t>(k);
                const double r = !garment ? 0.2
                                 : open   ? image.depths->node[channel][0]
                                          : double{printed[channel]};
                image.pixel(0, x, y)[k] = static_cast<float>(sent_on(x, y, r));
                image.pixel(1, x, y)[k] = static_cast<float>(0.3 * sent_on(y, x, r));
            }
        }
    image.aovs.push_back(coverage);
    image.aov_names.push_back("coverage");
    return image;
}

PageOptions options_of(Adaptation adapt = Adaptation::none) {
    PageOptions options{.title = "Test & trial", .look = {.adapt = adapt, .view = "Soft"}};
    for (const char *name : {"D65", "A", "FL11", "HP1", "LED-B3"})
        options.lamps.push_back({name, lamp(name)});
    return options;
}

/// R, G, B of all pixels as the program writes them into a PNG.
std::vector<double> own_pixels(SpectralImage image, const std::vector<Spectrum> &lamps,
                               const Spectrum *dye, const DisplayOptions &look,
                               const RelightOptions &light = {}) {
    if (dye)
        set_dye(*image.depths, "", *dye);
    const Image rgb = display(relight(image, lamps, light), white_of(lamps[0]), look);
    std::vector<double> codes;
    for (const float v : rgb.data)
        codes.push_back(std::round(255 * v));
    return codes;
}

struct Distance {
    double mean = 0, most = 0; ///< in codes of 255
};

Distance distance(const std::vector<double> &a, const std::vector<double> &b) {
    Distance d;
    EXPECT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        d.mean += std::abs(a[i] - b[i]) / static_cast<double>(a.size());
        d.most = std::max(d.most, std::abs(a[i] - b[i]));
    }
    return d;
}

constexpr double kMostCodes = 1.5;

/// One browser for all tests.
class LivePageInBrowser : public testing::Test {
  protected:
    static void TearDownTestSuite() {
        browser_.reset();
        profile_.reset();
    }
    void SetUp() override {
        if (browser_)
            return;
        const std::string chromium = find_chromium();
        if (chromium.empty())
            GTEST_SKIP() << "no chromium (package chromium)";
        profile_ = std::make_unique<scene::Scratch>();
        browser_ = std::make_unique<Browser>(chromium, profile_->folder());
    }
    void TearDown() override {
        if (browser_) {
            EXPECT_EQ(browser_->complaints(), std::vector<std::string>{});
        }
    }

    void show(const std::string &html) {
        browser_->resize(1280, 900, false);
        browser_->open(scratch_.write("page.html", html));
        browser_->evaluate("tsuya.ready");
    }
    /// R, G, B of the pixels of a picture, after `change` of the state.
    std::vector<double> pixels(const std::string &change, int dress = 0) {
        const json values = browser_->evaluate(
            "(() => {const {app, page} = tsuya, {looks, view} = app;" + change +
            ";tsuya.draw(); const dress = page.dresses[" + std::to_string(dress) +
            "]; const {data} = dress.context.getImageData(0, 0, dress.width, dress.height);"
            "return Array.from(data).filter((_, i) => i % 4 < 3);})()");
        return values.get<std::vector<double>>();
    }
    Browser &browser() { return *browser_; }

  private:
    scene::Scratch scratch_{};
    static inline std::unique_ptr<scene::Scratch> profile_{};
    static inline std::unique_ptr<Browser> browser_{};
};

std::string lamps_set(const std::string &name) {
    return "for (const group in looks.left.lamps) looks.left.lamps[group] = {name: '" + name +
           "'};";
}

TEST_F(LivePageInBrowser, PixelsAreThoseOfTheProgramForLampsAndDyes) {
    const SpectralImage image = make_dress(true);
    const PageOptions options = options_of();
    const std::array<PageDress, 1> dresses{{{"dress", image}}};
    show(live_page(dresses, options).html);
    const std::array<std::string, 3> dyes{"white", "crimson", "#3a6ea5"};
    Distance worst;
    for (const NamedLamp &lamp : options.lamps)
        for (const std::string &name : dyes) {
            const Spectrum reflectance = parse_dye(name);
            const std::string change =
                lamps_set(lamp.name) + "looks.left.dyes.satin = {label: 'x', reflectance: " +
                (name[0] == '#'
                     ? "tsuya.reflectanceOfHex('" + name + "')}"
                     : "page.dyes.find(dye => dye.name === '" + name + "').reflectance}");
            const Distance d = distance(
                pixels(change), own_pixels(image, {lamp.spectrum}, &reflectance, options.look));
            EXPECT_LE(d.most, kMostCodes) << lamp.name << ", " << name;
            worst = {std::max(worst.mean, d.mean), std::max(worst.most, d.most)};
        }
    std::cout << "codes of 255: " << worst.mean << " in the mean, " << worst.most
              << " at most, of 5 lamps x 3 dyes\n";
    // Negative control: the picture under another lamp is no match.
    const Spectrum crimson = dye("crimson");
    EXPECT_GT(
        distance(pixels(lamps_set("A")), own_pixels(image, {lamp("D65")}, &crimson, options.look))
            .most,
        10 * kMostCodes);
}

TEST_F(LivePageInBrowser, AdaptationViewsExposureAndLightGroupsAreTheProgramsOwn) {
    const SpectralImage image = make_dress(true);
    const std::array<PageDress, 1> dresses{{{"dress", image}}};
    show(live_page(dresses, options_of(Adaptation::bradford)).html);
    const Spectrum white = dye("white");
    for (const std::string &view : view_names())
        EXPECT_LE(
            distance(pixels(lamps_set("A") + "view.exposure = 1; view.display = '" + view + "'"),
                     own_pixels(image, {lamp("A")}, &white,
                                {.adapt = Adaptation::bradford, .view = view, .exposure_stops = 1}))
                .most,
            kMostCodes)
            << view;
    // A lamp and a power for each light group, seen by a camera
    EXPECT_LE(distance(pixels("view.degree = 0; view.exposure = 0; view.display = 'Soft';"
                              "looks.left.lamps.key = {name: 'HP1'};"
                              "looks.left.lamps.fill = {name: 'D65'}; looks.left.powers.fill = 2"),
                       own_pixels(image, {lamp("HP1"), lamp("D65")}, &white, {.view = "Soft"},
                                  {.group_scale = {1, 2}}))
                  .most,
              kMostCodes);
    // Half adapted lies between.
    const std::vector<double> none = pixels("view.degree = 0"), half = pixels("view.degree = 0.5"),
                              full = pixels("view.degree = 1");
    EXPECT_GT(distance(none, half).mean, 1);
    EXPECT_GT(distance(half, full).mean, 1);
    EXPECT_LT(distance(none, half).mean, distance(none, full).mean);
}

TEST_F(LivePageInBrowser, ShowsWavelengthsAndSeveralDresses) {
    const SpectralImage printed = make_dress(false), open = make_dress(true);
    const std::array<PageDress, 2> dresses{{{"printed", printed}, {"open", open}}};
    show(live_page(dresses, options_of()).html);
    const Spectrum white = dye("white");
    for (const char *name : {"D65", "FL11"}) {
        EXPECT_LE(distance(pixels(lamps_set(name)),
                           own_pixels(printed, {lamp(name)}, nullptr, {.view = "Soft"}))
                      .most,
                  kMostCodes)
            << name;
        EXPECT_LE(
            distance(pixels("", 1), own_pixels(open, {lamp(name)}, &white, {.view = "Soft"})).most,
            kMostCodes)
            << name;
    }
}

TEST_F(LivePageInBrowser, SplitsAndMapsDifferences) {
    const SpectralImage image = make_dress(true);
    const std::array<PageDress, 1> dresses{{{"dress", image}}};
    show(live_page(dresses, options_of(Adaptation::cat02)).html);
    const std::vector<double> left = pixels(""), right = pixels("looks.left = looks.right");
    std::vector<double> split =
        pixels("looks.left = {...looks.right, lamps: {key: {name: 'D65'}, "
               "fill: {name: 'D65'}}}; view.mode = 'split'; view.split = 0.25");
    for (std::size_t i = 0; i < split.size(); ++i)
        ASSERT_EQ(split[i], (i / 3 % kWidth < kWidth / 4 ? left : right)[i]) << i;
    // The map at a pixel is the legend at what the script finds, and that is C++'s difference.
    const int x = 80, y = 120;
    const json found = browser().evaluate(
        "(() => {const {app, page} = tsuya, dress = page.dresses[0], p = 120 * dress.width + 80;"
        "app.view.mode = 'difference'; app.view.largest = 20; tsuya.draw();"
        "const labs = ['left', 'right'].map(side => "
        "tsuya.labOf(tsuya.pixelColour(dress, app.looks[side], p)));"
        "return {labs, difference: tsuya.ciede2000(...labs), "
        "shown: Array.from(dress.context.getImageData(80, 120, 1, 1).data), "
        "legend: tsuya.legend};})()");
    std::array<glm::dvec3, 2> labs;
    for (std::size_t side = 0; side < 2; ++side) {
        const Spectrum spectrum = lamp(side ? "A" : "D65");
        const Image xyz = relight(image, spectrum);
        const glm::dmat3 adapt =
            adaptation_matrix(Adaptation::cat02, white_of(spectrum), srgb_white());
        const float *v = xyz.pixel(x, y);
        labs[side] = lab_of(adapt * glm::dvec3(v[0], v[1], v[2]), srgb_white());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found["labs"][side][static_cast<std::size_t>(c)].get<double>(),
                        labs[side][c], 0.5);
    }
    EXPECT_NEAR(found["difference"].get<double>(), ciede2000(labs[0], labs[1]), 0.3);
    const json &legend = found["legend"];
    const double place =
        found["difference"].get<double>() / 20 * (static_cast<double>(legend.size()) - 1);
    const auto cell = static_cast<std::size_t>(place);
    ASSERT_LT(cell + 1, legend.size());
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found["shown"][c].get<double>(),
                    255 * std::lerp(legend[cell][c].get<double>(),
                                    legend[cell + 1][c].get<double>(),
                                    place - static_cast<double>(cell)),
                    1.5);
}

TEST_F(LivePageInBrowser, ColoursSpectraAndFilesAreRight) {
    const std::array<PageDress, 1> dresses{{{"dress", make_dress(true)}}};
    show(live_page(dresses, options_of()).html);
    const auto check_difference = [&](const glm::dvec3 &a, const glm::dvec3 &b) {
        const auto list = [](const glm::dvec3 &v) { return json{v.x, v.y, v.z}.dump(); };
        EXPECT_NEAR(
            browser().evaluate("tsuya.ciede2000(" + list(a) + "," + list(b) + ")").get<double>(),
            ciede2000(a, b), 1e-9)
            << list(a) << list(b);
    };
    check_difference({50, 2.6772, -79.7751}, {50, 0, -82.7485}); // [Sharma] table 1
    check_difference({50, 0, 0}, {50, -1, 2});
    check_difference({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387});
    check_difference({2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514});
    // Daylight of 6504 K is D65, which tables have.
    const Spectrum d65 = lamp("D65");
    const json daylight = browser().evaluate("tsuya.daylight(6504)");
    for (int nm = 400; nm <= 700; nm += 10)
        EXPECT_NEAR(daylight[static_cast<std::size_t>(nm - 360)].get<double>() / d65.at(nm), 1,
                    0.005)
            << nm;
    const auto refusal = [&](const std::string &text) {
        return browser()
            .evaluate("(() => {try {tsuya.spectrumOfText(" + json(text).dump() +
                      "); return '';} catch (error) {return error.message;}})()")
            .get<std::string>();
    };
    EXPECT_EQ(refusal("nm,value\n400,0.5\n700,0.6\n"), "");
    EXPECT_NE(refusal("400,0.5\nred,1\n").find("line 2"), std::string::npos);
    EXPECT_NE(refusal("400,0.5\n390,1\n").find("do not increase"), std::string::npos);
    EXPECT_NE(refusal("0.4,0.5\n0.7,1\n").find("nanometres"), std::string::npos);
    // A line that no whole nanometre meets keeps its power.
    const json line = browser().evaluate(
        "(() => {const lines = []; for (let nm = 400; nm <= 700; nm += 0.25) "
        "lines.push(`${nm},${nm === 550.25 ? 1 : 0}`);"
        "return tsuya.spectrumOfText(lines.join('\\n')).reduce((sum, v) => sum + v, 0);})()");
    EXPECT_NEAR(line.get<double>(), 0.25, 1e-9);
    // A file that is dropped is shown.
    browser().evaluate("tsuya.takeSpectrum('mine', tsuya.spectrumOfText('400,0.9\\n700,0.1\\n'))");
    EXPECT_EQ(browser().evaluate("tsuya.app.looks.left.dyes.satin.label").get<std::string>(),
              "mine");
}

// Reports; gates nothing.
TEST_F(LivePageInBrowser, TellsItsFramesPerSecond) {
    const std::array<PageDress, 1> dresses{{{"dress", make_dress(true)}}};
    show(live_page(dresses, options_of()).html);
    const json ms =
        browser().evaluate("(() => {const {app} = tsuya, start = performance.now();"
                           "for (let i = 0; i < 20; ++i) {app.view.exposure = i / 20; tsuya.draw();"
                           "tsuya.page.dresses[0].context.getImageData(0, 0, 1, 1);}"
                           "return (performance.now() - start) / 20;})()");
    std::cout << ms.get<double>() << " ms a frame of " << kWidth << " x " << kHeight << "\n";
    EXPECT_GT(ms.get<double>(), 0);
}

} // namespace
} // namespace tsuya::program
