// tsuya render: a scene file to light transport.

#include <iostream>
#include <optional>

#include "command.h"
#include "json_file.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;

class RenderCommand final : public Command {
  public:
    explicit RenderCommand(CLI::App &program)
        : app_(*program.add_subcommand("render", "Render a scene file, lamp-free")) {
        app_.footer("Example:\n  tsuya render dress.scene.toml -o dress.exr --spp 128\n"
                    "Options take the place of the scene's values. An interrupted render leaves "
                    "what it has in OUT.exr,\nand OUT.exr.checkpoint for --resume. The lamps of "
                    "the scene's [output] give OUT-LAMP.png.");
        app_.add_option("scene", scene_, "SCENE.toml")->required();
        CLI::Option *output = app_.add_option("-o,--output", output_, "OUT.exr");
        auto *spp =
            app_.add_option("--spp", spp_, "Samples per pixel")->check(CLI::Range(1, 65536));
        auto *error = app_.add_option("--error", error_, "Until the mean relative error is below")
                          ->check(CLI::Range(1e-6, 1.0));
        auto *time = app_.add_option("--time", seconds_, "Seconds")->check(CLI::Range(1e-3, 1e6));
        spp->excludes(error)->excludes(time);
        error->excludes(time);
        app_.add_option("--channels", channels_, "8, 16 or 32")->check(CLI::IsMember({8, 16, 32}));
        app_.add_option("--threads", threads_, "0: all")->check(CLI::Range(0, 4096));
        app_.add_option("--seed", seed_, "Of the noise");
        app_.add_option("--crop", crop_, "X0,Y0,X1,Y1 in pixels, half open")
            ->delimiter(',')
            ->expected(4);
        app_.add_option("--aov", aovs_, "Further pictures: coverage,depth,normal,warp,object")
            ->delimiter(',')
            ->check(CLI::IsMember(aov_names()));
        app_.add_option("--tolerance-px", tolerance_px_,
                        "PIXELS that triangles may depart from the limit surface")
            ->check(CLI::Range(1e-3, 1e3));
        app_.add_flag("--resume", resume_, "Go on from OUT.exr.checkpoint");
        app_.add_flag("--explain", explain_, "Print what would be done, and do not render");
        app_.add_option("--stats", stats_, "FILE.json of what was done")->needs(output);
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        scene::SceneFile file = scene::read_scene_file(scene_);
        for (std::vector<scene::MeshEntry> *entries : {&file.garments, &file.bodies})
            for (scene::MeshEntry &entry : *entries)
                if (tolerance_px_)
                    entry.tolerance_px = tolerance_px_;
        const RenderSettings settings = settings_of(file);
        if (!explain_)
            check_places(file);
        const scene::BuiltScene built = scene::build_scene(file, console.progress());
        for (const scene::MeshReport &mesh : built.reports)
            console.warnings(mesh.report, mesh.mesh.string());
        if (explain_) {
            std::cout << explain(plan(built.scene, settings));
            for (const scene::MeshReport &mesh : built.reports)
                std::cout << mesh.report.limit_triangles << " triangles of " << mesh.report.faces
                          << " faces: " << mesh.mesh.string() << "\n";
            return kDone;
        }
        make_places(file);
        if (resume_ && !fs::exists(settings.checkpoint))
            console.warning("there is no " + settings.checkpoint.string() + "; starting anew");
        const RenderResult result = render(built.scene, settings, console.progress());
        write_results(file, result);
        if (result.stats.not_finite > 0)
            console.warning(std::to_string(result.stats.not_finite) +
                            " samples were not finite and are left out");
        if (!result.stats.interrupted)
            return kDone;
        console.error("interrupted; --resume goes on from " + settings.checkpoint.string());
        return kInterrupted;
    }

  private:
    RenderSettings settings_of(const scene::SceneFile &file) const {
        RenderSettings settings = file.render;
        if (spp_ || error_ || seconds_)
            settings.stop = {.samples_per_pixel = spp_.value_or(kMostSamples),
                             .relative_error = error_,
                             .seconds = seconds_};
        settings.channels = channels_.value_or(settings.channels);
        settings.threads = threads_.value_or(settings.threads);
        settings.seed = seed_.value_or(settings.seed);
        if (!aovs_.empty())
            settings.aovs = aovs_;
        if (!crop_.empty())
            settings.crop = crop_of(file);
        settings.checkpoint = output_;
        settings.checkpoint += ".checkpoint";
        settings.resume = resume_;
        return settings;
    }

    std::array<int, 4> crop_of(const scene::SceneFile &file) const {
        const int width = file.framing.width, height = file.framing.height;
        if (crop_[0] < 0 || crop_[1] < 0 || crop_[0] >= crop_[2] || crop_[1] >= crop_[3] ||
            crop_[2] > width || crop_[3] > height)
            throw Error({"the crop lies outside the picture or is empty", "crop",
                         "expected x0,y0,x1,y1 within " + std::to_string(width) + " x " +
                             std::to_string(height)});
        return {crop_[0], crop_[1], crop_[2], crop_[3]};
    }

    fs::path picture_of(const NamedLamp &lamp) const {
        fs::path path = output_;
        return path.replace_filename(output_.stem().string() + "-" + lamp.name + ".png");
    }

    /// Before the meshes are read.
    void check_places(const scene::SceneFile &file) const {
        if (output_.empty())
            throw Error({"no output is named", "-o", "expected -o OUT.exr, or --explain"});
        if (output_.extension() != ".exr")
            throw Error({"the name does not end in .exr", output_.string(), "expected OUT.exr"});
        for (const NamedLamp &lamp : file.output.lamps)
            if (fs::is_directory(picture_of(lamp)))
                throw Error({"it is a folder", picture_of(lamp).string(), "expected another name"});
    }

    void make_places(const scene::SceneFile &file) const {
        scene::prepare_output_file(output_, {".exr"});
        for (const NamedLamp &lamp : file.output.lamps)
            scene::prepare_output_file(picture_of(lamp));
        if (!stats_.empty())
            scene::prepare_output_file(stats_);
    }

    void write_results(const scene::SceneFile &file, const RenderResult &result) const {
        write_spectral_exr(output_, result.image);
        std::cout << output_.string() << "\n";
        if (!result.stats.interrupted)
            for (const NamedLamp &lamp : file.output.lamps) {
                const fs::path path = picture_of(lamp);
                write_png(path, scene::picture_under(result.image, {&lamp, 1}, file.output.look));
                std::cout << path.string() << "\n";
            }
        if (!stats_.empty())
            write_json(stats_, json_of(result.stats));
    }

    static constexpr int kMostSamples = 65536;

    CLI::App &app_;
    fs::path scene_{}, output_{}, stats_{};
    std::optional<int> spp_{}, channels_{}, threads_{};
    std::optional<double> error_{}, seconds_{}, tolerance_px_{};
    std::optional<std::uint32_t> seed_{};
    std::vector<int> crop_{};
    std::vector<std::string> aovs_{};
    bool resume_ = false, explain_ = false;
};

} // namespace

std::unique_ptr<Command> make_render(CLI::App &program) {
    return std::make_unique<RenderCommand>(program);
}

} // namespace tsuya::program
