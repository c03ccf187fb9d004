// tsuya tryon: the main job without a scene file.

#include <iostream>

#include "command.h"
#include "grain_option.h"
#include "look_options.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

class TryOnCommand final : public Command {
  public:
    explicit TryOnCommand(CLI::App &program)
        : app_(*program.add_subcommand("tryon", "Show a garment in a fabric, dyed and lit")) {
        app_.footer("Example:\n  tsuya tryon --garment dress.obj --fabric black_satin --dye "
                    "white,indigo --lamps D65,A -o out\n"
                    "Without a garment: the sample dress on its mannequin.");
        CLI::Option *garment =
            app_.add_option("--garment", garment_, "Mesh (OBJ, glTF, PLY, OFF) with panel UVs");
        app_.add_option("--frames", job_.frames,
                        "MESHes with the garment's faces and other positions: pictures of each; "
                        "without --garment the first is the garment");
        app_.add_flag("--morph-targets", job_.morph_targets,
                      "Those of the garment (glTF) are frames too")
            ->needs(garment);
        app_.add_option("--body", job_.body, "Mesh that wears it");
        app_.add_option("--fabric", fabric_, "F.fabric.toml, or a name of `tsuya list fabrics`")
            ->capture_default_str();
        app_.add_option("--dye", job_.dyes, "Names of `tsuya list dyes`, #rrggbb, F.csv")
            ->delimiter(',')
            ->capture_default_str();
        app_.add_option("--lamps", job_.lamps, "Names of `tsuya list lamps`, or F.csv")
            ->delimiter(',')
            ->capture_default_str();
        app_.add_option("-o,--output", job_.output, "Folder for the results")->required();
        app_.add_option("--unit", job_.unit, "Of the meshes: m, dm, cm, mm, in")
            ->capture_default_str();
        app_.add_option("--level", job_.level, "Of subdivision")
            ->check(CLI::Range(0, 8))
            ->capture_default_str();
        app_.add_option("--tolerance", job_.tolerance,
                        "METRES that triangles may depart from the limit surface")
            ->check(CLI::PositiveNumber)
            ->excludes("--level");
        app_.add_option("--tolerance-px", job_.tolerance_px,
                        "PIXELS of the picture that they may depart")
            ->check(CLI::Range(1e-3, 1e3))
            ->excludes("--level");
        app_.add_option("--grain", grain_,
                        "Of a garment without UV: vertical, horizontal, or degrees from it");
        app_.add_option("--max-degenerate-area", job_.max_degenerate_area,
                        "Share of the garment without a usable UV above which it is an error")
            ->check(CLI::Range(0.0, 1.0))
            ->capture_default_str();
        app_.add_flag("--strict", job_.strict, "Refuse a garment with a warning");
        app_.add_option("--azimuth", job_.azimuth_deg, "Of the camera, degrees; 0 sees the front")
            ->check(CLI::Range(-360.0, 360.0))
            ->capture_default_str();
        add_quality();
        look_.add_to(app_);
        app_.add_option("--data", data_, "Folder of the sample data");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        if (garment_.empty() && !job_.frames.empty()) {
            garment_ = job_.frames.front();
            job_.frames.erase(job_.frames.begin());
        }
        if (garment_.empty() && !job_.body.empty())
            throw Error({"a body without a garment", "--body", "expected --garment or --frames"});
        if (garment_.empty()) {
            const scene::TryOn sample = scene::sample_try_on(data_folder());
            job_.garment = sample.garment;
            job_.body = sample.body;
        } else {
            job_.garment = garment_;
        }
        job_.fabric = scene::find_fabric(fabric_, data_folder());
        job_.invented_grain = parse_grain(grain_);
        job_.look = look_.look();
        job_.render.stop.relative_error = error_;
        if (samples_)
            job_.render.stop = {.samples_per_pixel = *samples_};
        const scene::TryOnResult result = scene::run(job_, console.progress());
        console.warnings(result.report, job_.garment.string());
        for (const RenderStats &stats : result.stats)
            if (stats.not_finite > 0)
                console.warning(std::to_string(stats.not_finite) +
                                " samples were not finite and are left out");
        for (const std::filesystem::path &file : result.files)
            std::cout << file.string() << "\n";
        if (!result.interrupted)
            return kDone;
        console.error("interrupted; the pictures so far are written");
        return kInterrupted;
    }

  private:
    void add_quality() {
        app_.add_option("--width", job_.width, "Pixels")
            ->check(CLI::Range(1, 32768))
            ->capture_default_str();
        app_.add_option("--height", job_.height, "Pixels")
            ->check(CLI::Range(1, 32768))
            ->capture_default_str();
        app_.add_option("--error", error_, "Standard error over value that each part may keep")
            ->check(CLI::PositiveNumber)
            ->capture_default_str();
        app_.add_option("--spp,--samples", samples_, "Samples per pixel, the same everywhere")
            ->check(CLI::Range(1, 65536))
            ->excludes("--error");
        app_.add_option("--channels", job_.render.channels, "Spectral channels")
            ->check(CLI::IsMember({8, 16, 32}))
            ->capture_default_str();
        app_.add_option("--threads", job_.render.threads, "0: all")
            ->check(CLI::Range(0, 4096))
            ->capture_default_str();
        app_.add_option("--seed", job_.render.seed, "Of the noise")->capture_default_str();
    }
    /// The sample data is needed by names and the sample dress only.
    std::filesystem::path data_folder() const {
        const bool named = garment_.empty() || !fabric_.ends_with(".toml");
        return named ? scene::data_folder(data_) : std::filesystem::path{};
    }

    CLI::App &app_;
    scene::TryOn job_{};
    std::filesystem::path garment_{}, data_{};
    std::string fabric_ = "black_satin", grain_{};
    LookOptions look_{};
    double error_ = *scene::kTryOnQuality.relative_error;
    std::optional<int> samples_{};
};

} // namespace

std::unique_ptr<Command> make_tryon(CLI::App &program) {
    return std::make_unique<TryOnCommand>(program);
}

} // namespace tsuya::program
