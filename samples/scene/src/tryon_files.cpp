#include "tryon_files.h"

#include <algorithm>

#include "tryon_page.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

/// The number of a frame at the end of a file's name, as frame_suffix writes it; empty where there
/// is none.
std::string number_in(const fs::path &file) {
    const std::string stem = file.stem().string();
    const std::size_t dash = stem.find_last_not_of("0123456789");
    const bool numbered = dash != std::string::npos && stem[dash] == '-' && stem.size() - dash > 4;
    return numbered ? stem.substr(dash) : "";
}

} // namespace

std::string own_dye_name(const TryOn &job) { return job.fabric.stem().stem().string(); }

std::string transport_name(const std::string &dye, const std::string &number) {
    return file_stem_of(dye) + number + ".exr";
}

std::string picture_name(const std::string &dye, const std::string &lamp,
                         const std::string &number) {
    return file_stem_of(dye) + "-" + file_stem_of(lamp) + number + ".png";
}

std::string video_name(const std::string &dye, const std::string &lamp) {
    return file_stem_of(dye) + "-" + file_stem_of(lamp) + ".mp4";
}

SpectralImage finished(const fs::path &exr, const std::string &key) {
    try {
        SpectralImage image = read_spectral_exr(exr);
        const auto found = image.metadata.find("render_key");
        return found != image.metadata.end() && found->second == key ? std::move(image)
                                                                     : SpectralImage{};
    } catch (const Error &) {
        return {};
    }
}

std::vector<fs::path> replaced_files(const TryOn &job) {
    const bool one_shape = job.frames.empty() && job.turntable == 0;
    const bool numbered = !one_shape || job.morph_targets;
    const std::vector<std::string> lamps = expand_lamp_sets(job.lamps);
    std::vector<std::string> dyes = job.dyes;
    if (dyes.empty() || job.keeps_own_dye)
        dyes.push_back(own_dye_name(job));
    const auto is_result = [&](const std::string &name, const std::string &number) {
        return std::any_of(dyes.begin(), dyes.end(), [&](const std::string &dye) {
            return name == transport_name(dye, number) ||
                   std::any_of(lamps.begin(), lamps.end(), [&](const std::string &lamp) {
                       return name == picture_name(dye, lamp, number);
                   });
        });
    };
    const auto is_video = [&](const std::string &name) {
        return std::any_of(dyes.begin(), dyes.end(), [&](const std::string &dye) {
            return std::any_of(lamps.begin(), lamps.end(), [&](const std::string &lamp) {
                return name == video_name(dye, lamp);
            });
        });
    };
    std::vector<fs::path> replaced;
    std::error_code code;
    for (fs::directory_iterator at(job.output, code), end; !code && at != end; at.increment(code)) {
        const std::string name = at->path().filename().string(), number = number_in(name);
        if ((one_shape &&
             (name == kSheet || (job.page && name == kTryOnPage) || is_result(name, ""))) ||
            (numbered && !number.empty() && is_result(name, number)) ||
            (job.video_fps > 0 && is_video(name)))
            replaced.push_back(at->path());
    }
    return replaced;
}

} // namespace tsuya::scene
