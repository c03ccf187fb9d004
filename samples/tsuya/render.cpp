// tsuya render: a scene file to light transport.

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "render_plan.h"
#include "same_file.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/channel_warnings.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/video.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSamples = 65536;

struct Render final : Command {
    fs::path scene{}, output{}, stats{};
    std::optional<int> samples{}, channels{}, threads{}, frames{};
    std::optional<double> error{}, seconds{}, tolerance_px{};
    std::optional<std::uint32_t> seed{};
    std::vector<int> crop{};
    std::vector<std::string> aovs{};
    int video_fps = 0;
    double checkpoint_seconds = RenderSettings{}.checkpoint_seconds;
    bool resume = false, explains = false, denoises = false, keeps_lobes = false, no_cache = false,
         json = false;
    bool alpha = false, floats = false;

    void options(Options &o) override {
        o.argument(&scene, "SCENE.toml", "scene file").required();
        const Option &out = o.option("-o,--output", &output, "OUT.exr",
                                     "spectral light transport; required unless --explain")
                                .result({".exr"});
        Option &spp = o.option("--spp", &samples, "N", "samples per pixel").range(1, kMostSamples);
        Option &mean =
            o.option("--error", &error, "E",
                     "render each part of the picture until the mean error of its pixels "
                     "is below this share of its value (dark parts: of a twentieth of a bright "
                     "part's)")
                .range(1e-6, 1);
        Option &time = o.option("--time", &seconds, "S", "render for S seconds").range(1e-3, 1e6);
        spp.excludes(mean).excludes(time);
        mean.excludes(time);
        o.option("--channels", &channels, "K", "number of spectral channels")
            .one_of({"8", "16", "32"});
        o.option("--threads", &threads, "N", "number of threads; 0 uses all processors")
            .range(0, 4096);
        o.option("--seed", &seed, "N", "random seed");
        o.option("--crop", &crop, "X0,Y0,X1,Y1",
                 "the pixels to render: columns X0 to X1 - 1, rows Y0 to Y1 - 1")
            .with_commas()
            .exactly(4)
            .range(0, 32768)
            .check([this] {
                if (!crop.empty() && (crop[0] >= crop[2] || crop[1] >= crop[3]))
                    throw Error(
                        Problem{"there is no pixel in it", "", "expected X0 < X1, Y0 < Y1"});
            });
        o.option("--aov", &aovs, "A,B,...", "AOVs to write beside the light transport")
            .with_commas()
            .one_of(aov_names());
        o.flag("--float", &floats,
               "write the light transport in floats: files of twice the size, for measurements");
        o.flag("--alpha", &alpha,
               "pictures with alpha: without the scene's backdrop, and without the environment "
               "behind what is shown");
        const Option &sequence =
            o.option("--frames", &frames, "N",
                     "number of frames of a scene that moves, each with results of its own: "
                     "OUT-0000.exr and on")
                .range(1, 9999);
        add_video(o, video_fps).needs(sequence);
        o.flag(
            "--denoise", &denoises,
            "filter the noise out of the finished picture, which is then one to look at, not one "
            "to measure");
        o.flag("--no-widening", &keeps_lobes,
               "let light that was scattered diffusely meet every lobe as narrow as it is, as for "
               "measurements; the picture may show specks");
        o.option("--tolerance-px", &tolerance_px, "PIXELS",
                 "largest distance of the triangles from the limit surface, in the picture")
            .range(1e-3, 1e3);
        o.option("--checkpoint-every", &checkpoint_seconds, "S",
                 "seconds between the checkpoints of a running render; 0: only at its end")
            .range(0, 1e6);
        add_cache(o, no_cache);
        o.flag("--resume", &resume, "go on from OUT.exr.checkpoint");
        const Option &plan_only = o.flag(
            "--explain", &explains,
            "print the plan with what each feature that is left out saves, and do not render");
        o.flag("--json", &json, "print the plan as JSON").needs(plan_only);
        o.option("--stats", &stats, "FILE.json", "file for time, rays and error")
            .needs(out)
            .result({".json"});
        o.example("tsuya render dress.scene.toml -o dress.exr --spp 128");
        o.notes("Options replace the values of the scene file. SIGINT, SIGTERM and SIGHUP leave "
                "what there is in OUT.exr, and OUT.exr.checkpoint for --resume; a render that is "
                "killed leaves its last checkpoint. SIGUSR1 writes the picture so far to OUT.exr, "
                "and the render goes on. The lamps of the scene's "
                "[output] give OUT-LAMP.png. With --frames, "
                "--resume keeps frames that are complete and of the same scene and settings.");
    }

    Status run(Console &console) override {
        Status status = kDone;
        detail::run_with_threads(threads.value_or(0), [&] { status = render_scene(console); });
        return status;
    }

    Status render_scene(Console &console) {
        if (!explains)
            check_output();
        const PhaseClock of_load;
        scene::SceneFile file = scene::read_scene_file(scene, console.progress());
        file.output.alpha = file.output.alpha || alpha;
        for (std::vector<scene::MeshEntry> *entries : {&file.garments, &file.bodies})
            for (scene::MeshEntry &entry : *entries)
                if (tolerance_px)
                    entry.tolerance_px = tolerance_px;
        if (!explains)
            check_results(file);
        RenderSettings settings = settings_of(file);
        settings.snapshot_wanted = &watch_snapshot_signal();
        settings.snapshot = [&](const RenderResult &result) { write_snapshot(result, console); };
        scene::BuiltScene built = scene::build_scene(file, console.progress(),
                                                     static_cast<std::size_t>(frames.value_or(1)));
        for (const scene::MeshReport &mesh : built.reports)
            console.warnings(mesh.report, mesh.mesh.string());
        console.warnings(file.warnings);
        load_ = of_load.end("load");
        own_lamps_ = built.own_lamps;
        for (const Problem &warning : scene::channel_warnings(built.scene, settings))
            console.warning(warning);
        if (explains) {
            std::cout << plan_text(file, built, settings, json);
            return kDone;
        }
        tell_environment(file, console);
        for_each_place(file, [](const fs::path &place) { scene::prepare_output_file(place); });
        PreparedScene prepared(cache_unless(no_cache));
        const auto count = static_cast<std::size_t>(frames.value_or(1));
        for (frame_ = 0; frame_ < count; ++frame_) {
            if (frame_ > 0)
                built.frames.show(frame_, built.scene);
            if (is_done(file, built.scene, settings))
                continue;
            settings.checkpoint = checkpoint();
            const Status status = render_frame(file, built.scene, settings, prepared, console);
            if (status != kDone)
                return status;
        }
        if (frames && video_fps > 0)
            write_videos(file, console);
        return kDone;
    }

    /// Where three lamps make the colours of the environment badly.
    static void tell_environment(const scene::SceneFile &file, Console &console) {
        constexpr double kTold = 0.01;
        if (file.environment_error.value_or(0) >= kTold)
            console.warning(environment_text(*file.environment_error));
    }

    Status render_frame(const scene::SceneFile &file, const Scene &shown,
                        const RenderSettings &settings, PreparedScene &prepared, Console &console) {
        if (resume && !frames && !fs::exists(settings.checkpoint))
            console.warning("there is no " + settings.checkpoint.string() + "; starting anew");
        RenderResult result = render(shown, settings, console.progress(), &prepared);
        scene::note_own_lamps(result.image, own_lamps_);
        for (const Problem &warning : result.warnings)
            console.warning(warning);
        result.stats.phases.insert(result.stats.phases.begin(),
                                   std::exchange(load_, Phase{"load"}));
        write_results(file, shown, settings, result);
        if (!result.stats.interrupted)
            return kDone;
        console.error(fs::exists(settings.checkpoint)
                          ? "interrupted; --resume goes on from " + settings.checkpoint.string()
                          : "interrupted");
        return kInterrupted;
    }

    /// A frame of a sequence that is to be resumed and was finished: its render is there, complete
    /// and of the same scene and settings, and its other results are no older than it and the
    /// scene.
    bool is_done(const scene::SceneFile &file, const Scene &shown,
                 const RenderSettings &settings) const {
        if (!resume || !frames || fs::exists(checkpoint()))
            return false;
        std::error_code code;
        const fs::path exr = transport(frame_);
        const fs::file_time_type newest =
            std::max(fs::last_write_time(scene, code), fs::last_write_time(exr, code));
        bool done = true;
        for_each_place_of(file, frame_, [&](const fs::path &place) {
            done = done && fs::exists(place) &&
                   (place == exr || fs::last_write_time(place, code) >= newest);
        });
        return done && key_of(exr) == render_key(shown, settings);
    }

    /// Of a render in a file; empty where there is none.
    static std::string key_of(const fs::path &exr) {
        try {
            const SpectralImage image = read_spectral_exr(exr);
            const auto key = image.metadata.find("render_key");
            return key == image.metadata.end() ? "" : key->second;
        } catch (const Error &) {
            return "";
        }
    }

    RenderSettings settings_of(const scene::SceneFile &file) const {
        RenderSettings settings = file.render;
        if (samples || error || seconds)
            settings.stop = {.samples_per_pixel = samples.value_or(kMostSamples),
                             .relative_error = error,
                             .seconds = seconds};
        settings.channels = channels.value_or(settings.channels);
        settings.threads = threads.value_or(settings.threads);
        settings.seed = seed.value_or(settings.seed);
        settings.denoise = denoises || settings.denoise;
        settings.widen_after_diffuse = !keeps_lobes && settings.widen_after_diffuse;
        settings.alpha = file.output.alpha;
        if (!aovs.empty())
            settings.aovs = aovs;
        if (file.output.metered && !file.output.lamps.empty() &&
            std::find(settings.aovs.begin(), settings.aovs.end(), "garment") == settings.aovs.end())
            settings.aovs.emplace_back("garment");
        if (!crop.empty())
            settings.crop = crop_of(file);
        settings.checkpoint = checkpoint();
        settings.checkpoint_seconds = checkpoint_seconds;
        settings.resume = resume;
        return settings;
    }

    std::array<int, 4> crop_of(const scene::SceneFile &file) const {
        const int width = file.framing.width, height = file.framing.height;
        if (crop[2] > width || crop[3] > height)
            throw Error({"the crop reaches out of the picture", "--crop",
                         "expected X0,Y0,X1,Y1 within " + std::to_string(width) + " x " +
                             std::to_string(height)});
        return {crop[0], crop[1], crop[2], crop[3]};
    }

    /// A name with the number of a frame, where there are frames.
    fs::path of_frame(fs::path path, std::size_t frame) const {
        return frames ? path.replace_filename(path.stem().string() + scene::frame_suffix(frame) +
                                              path.extension().string())
                      : path;
    }

    SampleType samples_of_file() const { return floats ? SampleType::float32 : SampleType::half; }
    fs::path transport(std::size_t frame) const { return of_frame(output, frame); }
    fs::path checkpoint() const { return transport(frame_) += ".checkpoint"; }

    fs::path picture_of(const NamedLamp &lamp, std::size_t frame) const {
        fs::path path = output;
        return of_frame(path.replace_filename(output.stem().string() + "-" +
                                              scene::file_stem_of(lamp.name) + ".png"),
                        frame);
    }

    /// Of a lamp's pictures.
    fs::path video_of(const NamedLamp &lamp) const {
        fs::path path = output;
        return path.replace_filename(output.stem().string() + "-" + scene::file_stem_of(lamp.name) +
                                     ".mp4");
    }

    /// A video that cannot be made is a warning: its pictures are there.
    void write_videos(const scene::SceneFile &file, Console &console) const {
        for (const NamedLamp &lamp : file.output.lamps)
            try {
                const fs::path video = video_of(lamp);
                scene::write_video(video, fs::path(video).replace_extension(), video_fps);
                std::cout << video.string() << "\n";
            } catch (const Error &problems) {
                console.warnings(problems);
            }
    }

    /// Before the scene is read.
    void check_output() const {
        if (output.empty())
            throw WrongCall({"it is missing", "--output", "expected -o OUT.exr, or --explain"});
        scene::check_output_file(output);
        check_pictures();
    }

    /// What the scene names adds results, and files that they must not replace.
    void check_results(const scene::SceneFile &file) const {
        for_each_place(file, [](const fs::path &place) { scene::check_output_file(place); });
        for_each_place(file, [&](const fs::path &place) {
            for (const fs::path &read : file.files)
                if (is_same_file(place, read))
                    throw WrongCall({"it would replace a file of the scene", place.string(),
                                     "expected another name"});
        });
    }

    template <class Act> void for_each_place(const scene::SceneFile &file, Act &&act) const {
        if (frames && video_fps > 0)
            for (const NamedLamp &lamp : file.output.lamps)
                act(video_of(lamp));
        for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames.value_or(1)); ++frame)
            for_each_place_of(file, frame, act);
    }

    template <class Act>
    void for_each_place_of(const scene::SceneFile &file, std::size_t frame, Act &&act) const {
        act(transport(frame));
        for (const NamedLamp &lamp : file.output.lamps)
            act(picture_of(lamp, frame));
        if (!stats.empty())
            act(of_frame(stats, frame));
    }

    /// A picture that cannot be written does not end the render.
    void write_snapshot(const RenderResult &result, Console &console) const {
        try {
            scene::write_transport(transport(frame_), result.image, samples_of_file());
        } catch (const Error &problems) {
            console.warnings(problems);
        }
    }

    /// Metered on the first frame, for all.
    DisplayOptions look_of(const scene::SceneFile &file, const SpectralImage &image) {
        DisplayOptions look = file.output.look;
        if (!file.output.metered)
            return look;
        if (!metered_stops_) {
            scene::ExposureMeter meter(look);
            const SpectralImage first =
                frame_ == 0 ? SpectralImage{} : read_spectral_exr(transport(0));
            for (const NamedLamp &lamp : file.output.lamps)
                meter.add(frame_ == 0 ? image : first, {&lamp, 1});
            metered_stops_ = meter.stops();
        }
        look.exposure_stops = *metered_stops_;
        return look;
    }

    void write_results(const scene::SceneFile &file, const Scene &shown,
                       const RenderSettings &settings, RenderResult &result) {
        const PhaseClock of_write;
        // Stopped before the first sample: what stands under the name is not replaced by nothing
        if (result.stats.interrupted && result.stats.samples_per_pixel == 0)
            return;
        round_as_written(result.image, samples_of_file());
        scene::write_transport(transport(frame_), result.image, samples_of_file());
        std::cout << transport(frame_).string() << "\n";
        // Only now is the checkpoint of no more use
        if (!result.stats.interrupted)
            fs::remove(checkpoint());
        if (!result.stats.interrupted)
            for (const NamedLamp &lamp : file.output.lamps) {
                const fs::path path = picture_of(lamp, frame_);
                write_png(path, scene::picture_under(result.image, {&lamp, 1},
                                                     look_of(file, result.image)));
                std::cout << path.string() << "\n";
            }
        result.stats.phases.push_back(of_write.end("write"));
        if (!stats.empty())
            write_json(of_frame(stats, frame_), json_of(result.stats, plan(shown, settings)));
    }

  private:
    std::size_t frame_ = 0; ///< that is rendered
    Phase load_{};          ///< of the first frame that is rendered
    std::vector<std::string> own_lamps_{};
    std::optional<double> metered_stops_{};
};

} // namespace

std::unique_ptr<Command> make_render() { return std::make_unique<Render>(); }

} // namespace tsuya::program
