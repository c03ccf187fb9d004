// Error of pictures against the processor time of their rendering, as CSV.
//   bench_render errors|asked|denoised|specks SCENES SAMPLES_OF_REFERENCES FOLDER [PART_OF_NAME]
//   bench_render growth
// errors: by the number of samples; asked: by the error asked for; denoised: before and after the
// denoiser; specks: with and without wider lobes and denoiser; FOLDER keeps references. growth:
// time by the number of lights. Times are of the whole process, user and system, without the
// loading of the scene's files.

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>

#include "bench/render_scenes.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;

double cpu_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval &t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// Of each pixel: all groups and channels together.
using Picture = std::vector<float>;

struct Timed {
    RenderResult result{};
    double seconds = 0;
};

Timed timed(const bench::RenderScene &s, const StopRule &stop, std::uint32_t seed,
            bool denoise = false, bool widen = false) {
    const double start = cpu_seconds();
    Timed t{.result = render(s.scene, {.stop = stop,
                                       .channels = 8,
                                       .max_bounces = s.max_bounces,
                                       .seed = seed,
                                       .denoise = denoise,
                                       .widen_after_diffuse = widen})};
    t.seconds = cpu_seconds() - start;
    return t;
}

Picture picture_of(const SpectralImage &image) {
    Picture sums;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            float sum = 0;
            for (std::size_t g = 0; g < image.groups.size(); ++g)
                for (int k = 0; k < image.basis.count; ++k)
                    sum += image.pixel(g, x, y)[k];
            sums.push_back(sum / static_cast<float>(image.basis.count));
        }
    return sums;
}

// Rendered with other random numbers than what it is held against, or read where it was before.
Picture reference(const bench::RenderScene &s, int samples, const std::filesystem::path &folder) {
    const std::filesystem::path file = folder / (s.name + "-" + std::to_string(samples) + ".bin");
    const auto pixels =
        static_cast<std::size_t>(s.scene.camera.width) * std::size_t(s.scene.camera.height);
    Picture picture(pixels);
    std::ifstream in(file, std::ios::binary);
    const auto bytes = static_cast<std::streamsize>(pixels * sizeof(float));
    if (in.read(reinterpret_cast<char *>(picture.data()), bytes))
        return picture;
    picture = picture_of(timed(s, {.samples_per_pixel = samples}, 77).result.image);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char *>(picture.data()), bytes);
    return picture;
}

// Mean of difference^2 / (reference^2 + 0.01).
double relative_mean_square(const Picture &picture, const Picture &reference) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double r = reference[i];
        sum += std::pow(picture[i] - r, 2) / (r * r + 0.01);
    }
    return sum / static_cast<double>(picture.size());
}

// Mean |difference| over mean value.
double relative_mean_absolute(const Picture &picture, const Picture &reference) {
    double differences = 0, values = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        differences += std::abs(picture[i] - reference[i]);
        values += reference[i];
    }
    return differences / values;
}

// Pixels above `factor` times the median of the 5 x 5 around them, which the reference has not so.
int specks(const Picture &picture, const Picture &reference, int width, double factor) {
    const int height = static_cast<int>(picture.size()) / width;
    const auto above_median = [&](const Picture &p, int x, int y) {
        std::array<float, 25> around{};
        for (int i = 0; i < 25; ++i)
            around[std::size_t(i)] = p[std::size_t((y + i / 5 - 2) * width + x + i % 5 - 2)];
        const float here = around[12];
        std::nth_element(around.begin(), around.begin() + 12, around.end());
        return here / around[12];
    };
    int count = 0;
    for (int y = 2; y < height - 2; ++y)
        for (int x = 2; x < width - 2; ++x)
            if (above_median(picture, x, y) > factor &&
                above_median(reference, x, y) < factor / 1.5)
                ++count;
    return count;
}

struct Measured {
    double seconds = 0, samples = 0, square = 0, absolute = 0, told = 0, above_2 = 0, above_3 = 0;
};

// Median of times, means of errors.
Measured measure(const bench::RenderScene &s, const StopRule &stop, int runs,
                 const Picture &exact) {
    Measured m;
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run) {
        const Timed t = timed(s, stop, static_cast<std::uint32_t>(run));
        const Picture picture = picture_of(t.result.image);
        seconds.push_back(t.seconds);
        m.samples += t.result.stats.samples_per_pixel / runs;
        m.square += relative_mean_square(picture, exact) / runs;
        m.absolute += relative_mean_absolute(picture, exact) / runs;
        m.told += t.result.stats.relative_error / runs;
        m.above_2 += double(specks(picture, exact, s.scene.camera.width, 2)) / runs;
        m.above_3 += double(specks(picture, exact, s.scene.camera.width, 3)) / runs;
    }
    std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
    m.seconds = seconds[std::size_t(runs / 2)];
    return m;
}

// For every scene and stop rule a line.
void errors(bool asked, const std::filesystem::path &scenes, int reference_samples,
            const std::filesystem::path &folder, const std::string &part) {
    std::cout << "scene,stop,cpu_seconds,samples,rel_mse,error,error_told,above_2,above_3\n";
    for (const bench::RenderScene &s : bench::render_scenes(scenes)) {
        if (s.name.find(part) == std::string::npos)
            continue;
        const Picture exact = reference(s, reference_samples, folder);
        for (const double rule : asked ? std::vector{0.05, 0.02} : std::vector{16.0, 64.0, 256.0}) {
            const StopRule stop = asked
                                      ? StopRule{.samples_per_pixel = 4096, .relative_error = rule}
                                      : StopRule{.samples_per_pixel = static_cast<int>(rule)};
            const Measured m = measure(s, stop, !asked && rule < 100 ? 4 : 1, exact);
            std::cout << s.name << "," << rule << "," << m.seconds << "," << m.samples << ","
                      << m.square << "," << m.absolute << "," << m.told << "," << m.above_2 << ","
                      << m.above_3 << std::endl;
        }
    }
}

// For every scene and number of samples a line: as it was traced, and denoised.
void denoised(const std::filesystem::path &scenes, int reference_samples,
              const std::filesystem::path &folder, const std::string &part) {
    std::cout << "scene,samples,cpu_seconds,cpu_seconds_denoised,rel_mse,rel_mse_denoised,above_2,"
                 "above_2_denoised,above_3,above_3_denoised,change_of_mean\n";
    for (const bench::RenderScene &s : bench::denoised_scenes(scenes)) {
        if (s.name.find(part) == std::string::npos)
            continue;
        const Picture exact = reference(s, reference_samples, folder);
        const int width = s.scene.camera.width;
        for (const int samples : {16, 64, 256}) {
            // An error that is not reached: the same samples, whether denoised or not
            const StopRule stop{.samples_per_pixel = samples, .relative_error = 1e-9};
            const Timed plain = timed(s, stop, 0), filtered = timed(s, stop, 0, true);
            const Picture before = picture_of(plain.result.image);
            const Picture after = picture_of(filtered.result.image);
            std::cout << s.name << "," << samples << "," << plain.seconds << "," << filtered.seconds
                      << "," << relative_mean_square(before, exact) << ","
                      << relative_mean_square(after, exact) << ","
                      << specks(before, exact, width, 2) << "," << specks(after, exact, width, 2)
                      << "," << specks(before, exact, width, 3) << ","
                      << specks(after, exact, width, 3) << ","
                      << *filtered.result.stats.denoise_change << std::endl;
        }
    }
}

// For every sample scene at its default quality lines of how it is rendered, each of two renders.
void count_specks(const std::filesystem::path &scenes, int reference_samples,
                  const std::filesystem::path &folder, const std::string &part) {
    constexpr int kRuns = 2;
    std::cout << "scene,widened,denoised,cpu_seconds,samples,pixels,rel_mse,above_2,above_3,"
                 "widening_change\n";
    for (const bench::RenderScene &s : bench::speck_scenes(scenes)) {
        if (s.name.find(part) == std::string::npos)
            continue;
        const Picture exact = reference(s, reference_samples, folder);
        const int width = s.scene.camera.width;
        for (const auto &[widen, denoise] :
             {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
            double seconds = 0, samples = 0, square = 0, change = 0;
            int above_2 = 0, above_3 = 0;
            for (std::uint32_t run = 0; run < kRuns; ++run) {
                const Timed t = timed(s, s.stop, run, denoise, widen);
                const Picture picture = picture_of(t.result.image);
                seconds += t.seconds / kRuns;
                samples += t.result.stats.samples_per_pixel / kRuns;
                square += relative_mean_square(picture, exact) / kRuns;
                above_2 += specks(picture, exact, width, 2);
                above_3 += specks(picture, exact, width, 3);
                change += t.result.stats.widening_change.value_or(0) / kRuns;
            }
            std::cout << s.name << "," << widen << "," << denoise << "," << seconds << ","
                      << samples << "," << exact.size() * kRuns << "," << square << "," << above_2
                      << "," << above_3 << "," << change << std::endl;
        }
    }
}

void growth() {
    std::cout << "lights,cpu_seconds\n";
    for (const int lights : {1, 4, 16, 64, 256, 1024}) {
        const bench::RenderScene s{"", bench::skirt("yarn", lights, 128), 3};
        std::vector<double> seconds;
        for (std::uint32_t run = 0; run < 3; ++run)
            seconds.push_back(timed(s, {.samples_per_pixel = 16}, run).seconds);
        std::nth_element(seconds.begin(), seconds.begin() + 1, seconds.end());
        std::cout << lights << "," << seconds[1] << std::endl;
    }
}

} // namespace

int main(int count, char **arguments) {
    const std::vector<std::string> args(arguments + 1, arguments + count);
    try {
        if (args.size() >= 4 && (args[0] == "errors" || args[0] == "asked")) {
            errors(args[0] == "asked", args[1], std::stoi(args[2]), args[3],
                   args.size() > 4 ? args[4] : "");
            return EXIT_SUCCESS;
        }
        if (args.size() >= 4 && args[0] == "denoised") {
            denoised(args[1], std::stoi(args[2]), args[3], args.size() > 4 ? args[4] : "");
            return EXIT_SUCCESS;
        }
        if (args.size() >= 4 && args[0] == "specks") {
            count_specks(args[1], std::stoi(args[2]), args[3], args.size() > 4 ? args[4] : "");
            return EXIT_SUCCESS;
        }
        if (args.size() == 1 && args[0] == "growth") {
            growth();
            return EXIT_SUCCESS;
        }
        std::cerr
            << "bench_render errors|asked|denoised|specks SCENES SAMPLES FOLDER [PART_OF_NAME] | "
               "growth\n";
    } catch (const std::exception &error) {
        std::cerr << error.what() << "\n";
    }
    return EXIT_FAILURE;
}
