// tsuya tryon: the main job without a scene file.

#include <iostream>

#include "command.h"
#include "fabric_options.h"
#include "grain_option.h"
#include "look_options.h"
#include "same_file.h"
#include "tsuya/color/palette.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/studio_preset.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

struct TryOn final : Command {
    scene::TryOn job{};
    std::filesystem::path garment{};
    FabricOptions cloth{};
    std::string grain{}, up{};
    LookOptions look{};
    double error = *scene::kTryOnQuality.relative_error;
    std::optional<int> samples{};
    std::optional<double> f_number{};
    bool keeps_noise = false, keeps_lobes = false, no_backdrop = false, no_cache = false;
    bool floats = false;
    const Option *dye = nullptr, *channels = nullptr, *lamps = nullptr, *unit = nullptr;

    void options(Options &o) override {
        add_garment(o);
        add_cloth(o);
        o.option("-o,--output", &job.output, "DIR", "folder for the results").required();
        o.flag(
             "--html", &job.page,
             "also write page.html, which shows any lamp, and any dye where one render serves all; "
             "not for frames")
            .check([this] {
                if (job.page && (job.turntable > 0 || !job.frames.empty() || job.morph_targets))
                    throw Error(Problem{"there is no page of a sequence", "",
                                        "expected a try-on without frames or turntable"});
            });
        add_quality(o);
        look.add_to(o);
        o.flag("--no-backdrop", &no_backdrop,
               "nothing behind garment and body: pictures with alpha");
        cloth.add_data(o);
        o.example("tsuya tryon --garment dress.obj --fabric black_satin --dye white,indigo "
                  "--lamps D65,A -o out");
        o.notes("Without --garment: the sample dress on a dress form.\n" + FabricOptions::notes());
    }

    void add_garment(Options &o) {
        const Option &mesh =
            o.option("--garment", &garment, "MESH",
                     "mesh with the UV of its panels (OBJ, glTF, PLY, OFF, FBX, DAE, STL)");
        o.option("--frames", &job.frames, "MESH...",
                 "meshes with the garment's faces and other positions, each with pictures of its "
                 "own; without --garment the first of them is the garment")
            .with_words();
        o.flag("--morph-targets", &job.morph_targets,
               "take the garment's morph targets (glTF) as frames, too")
            .needs(mesh);
        o.option("--turntable", &job.turntable, "N",
                 "turn garment and body once before the camera and the lights, in N views, each "
                 "with pictures of its own: DYE-LAMP-0000.png and on")
            .range(2, 9999)
            .check([this] {
                if (job.turntable > 0 && (!job.frames.empty() || job.morph_targets))
                    throw Error(Problem{"a figure that turns and has frames", "",
                                        "expected one of --turntable and --frames"});
                if (job.turntable > 0 && job.tolerance_px)
                    throw Error(Problem{"triangles as fine as one side needs them", "",
                                        "expected --level or --tolerance"});
            });
        o.option("--body", &job.body, "MESH", "mesh that wears the garment").check([this] {
            if (garment.empty() && job.frames.empty() && !job.body.empty())
                throw Error(
                    Problem{"a body without a garment", "", "expected --garment or --frames"});
        });
        unit = &add_unit(o, job.unit, "length unit of the meshes");
        add_up(o, up);
        const Option &level =
            o.option("--level", &job.level, "N", "level of subdivision: each edge is cut into 2^N")
                .range(0, 8);
        o.option("--tolerance", &job.tolerance, "METRES",
                 "largest distance of the triangles from the limit surface")
            .positive()
            .excludes(level);
        o.option("--tolerance-px", &job.tolerance_px, "PIXELS",
                 "the same distance as it is seen in the picture")
            .range(1e-3, 1e3)
            .excludes(level);
        add_sewing_tolerance(o, job.seams.tolerance);
        add_uv_scale(o, job.metres_per_uv);
        add_grain(o, grain);
        o.option("--max-degenerate-area", &job.max_degenerate_area, "SHARE",
                 "share of the garment's area without a usable UV above which it is an error")
            .range(0, 1);
        o.flag("--strict", &job.strict, "refuse a garment with a warning");
    }

    void add_cloth(Options &o) {
        cloth.add_to(o);
        const Option &pattern = o.option("--pattern", &job.pattern, "IMAGE",
                                         "picture printed on the garment's fabric, over its dye");
        o.option("--pattern-width", &job.pattern_width, "METRES",
                 "width of that picture on the cloth; it is repeated")
            .positive()
            .needs(pattern);
        dye = &o.option("--dye", &job.dyes, "A,B,...",
                        "dyes, which share one render where no print or third colour stands beside "
                        "them: names of `tsuya list dyes`, #rrggbb, files of spectra, F.csv:* "
                        "for all that are in one; where none is given, a dyed fabric has its own")
                   .with_commas()
                   .check([this] { scene::check_dyes(job.dyes); });
        lamps = &o.option("--lamps", &job.lamps, "A,B,...",
                          "lamps, one picture each: names of `tsuya list lamps`, files of spectra, "
                          "or `own`: each light has the lamp of its studio, which is the default "
                          "of --studio")
                     .with_commas()
                     .check([this] { scene::check_picture_lamps(job.lamps); });
        add_column(o, job.column);
        o.option("--studio", &job.studio, "NAME",
                 "lights and backdrop, see `tsuya list studios`; under their own lamps the picture "
                 "is adapted by CAT02 unless --adapt says otherwise")
            .one_of(scene::studio_names());
        const Option &aperture =
            o.option("--f-number", &f_number, "N",
                     "f-number of a lens on 35 mm film, focused on the garment; everything is "
                     "sharp where none is given")
                .range(0.01, 1e6);
        o.flag("--orthographic", &job.orthographic, "camera of parallel rays").excludes(aperture);
        o.option("--azimuth", &job.azimuth_deg, "DEGREES",
                 "direction of the camera; 0 sees the front")
            .range(-360, 360);
    }

    void add_quality(Options &o) {
        o.option("--width", &job.width, "PIXELS", "width of the pictures").range(1, 32768);
        o.option("--height", &job.height, "PIXELS", "height of the pictures").range(1, 32768);
        const Option &relative =
            o.option("--error", &error, "E",
                     "render each part of the picture until the mean error of its pixels is below "
                     "this share of its value (dark parts: of a twentieth of a bright part's)")
                .positive();
        o.option("--spp,--samples", &samples, "N", "samples per pixel, the same everywhere")
            .range(1, 65536)
            .excludes(relative);
        channels =
            &o.option("--channels", &job.render.channels, "K",
                      "number of channels over wavelengths, and one render a dye; by default "
                      "channels are depths of the dye where they can be")
                 .one_of({"8", "16", "32"});
        o.flag("--no-denoise", &keeps_noise,
               "leave the noise in the pictures, as for measurements; pictures of one sample per "
               "pixel are never denoised");
        o.flag("--no-widening", &keeps_lobes,
               "let light that was scattered diffusely meet every lobe as narrow as it is, as for "
               "measurements");
        o.flag("--float", &floats,
               "write light transport in floats: files of twice the size, for measurements");
        add_threads(o, job.render.threads);
        o.option("--seed", &job.render.seed, "N", "random seed");
        add_cache(o, no_cache);
        o.flag("--resume", &job.resume,
               "keep renders in DIR that are complete and of the same scene and settings");
        add_video(o, job.video_fps).check([this] {
            if (job.video_fps > 0 && job.turntable == 0 && job.frames.empty() && !job.morph_targets)
                throw Error(Problem{"there is no sequence of pictures", "",
                                    "expected --turntable, --frames or --morph-targets"});
        });
    }

    Status run(Console &console) override {
        scene::check_output_folder(job.output);
        if (garment.empty() && !job.frames.empty()) {
            garment = job.frames.front();
            job.frames.erase(job.frames.begin());
        }
        if (garment.empty()) {
            const scene::TryOn sample = scene::sample_try_on(cloth.data_folder(true));
            job.garment = sample.garment;
            job.body = sample.body;
        } else {
            job.garment = garment;
        }
        cloth.fill(job);
        job.dyes = expand_palettes(job.dyes);
        if (!dye->given && !job.pattern.empty())
            job.dyes = {"white"};
        else
            job.keeps_own_dye = !dye->given;
        job.invented_grain = parse_grain(grain);
        job.unit_stated = unit->given;
        job.up = stated_up(up);
        check_results();
        look.check();
        job.look = look.look();
        if (job.studio != scene::kDefaultStudio && !lamps->given) {
            job.lamps = {scene::kOwnLamps};
            if (!look.adapt_given())
                job.look.adapt = Adaptation::cat02;
        }
        job.metered = look.metered();
        job.backdrop = !no_backdrop;
        job.samples = floats ? SampleType::float32 : SampleType::half;
        if (f_number)
            job.lens = Lens{.f_number = *f_number};
        job.render.stop.relative_error = error;
        if (samples)
            job.render.stop = {.samples_per_pixel = *samples};
        job.render.denoise = !keeps_noise;
        job.render.widen_after_diffuse = !keeps_lobes;
        job.wavelengths = channels->given;
        job.cache = cache_unless(no_cache);
        scene::TryOnResult result;
        detail::run_with_threads(job.render.threads,
                                 [&] { result = scene::run(job, console.progress()); });
        return report(result, console);
    }

    /// Throws WrongCall if a result would replace a file that is read.
    void check_results() const {
        std::vector<std::filesystem::path> read{job.garment, job.body, job.fabric, job.back,
                                                job.pattern};
        read.insert(read.end(), job.frames.begin(), job.frames.end());
        for (const std::vector<std::string> &specs : {job.dyes, job.lamps})
            for (const std::string &spec : specs)
                if (const auto file = parse_spectrum_file_spec(spec))
                    read.push_back(file->path);
        for (const scene::PanelCloth &panel : job.panels)
            read.insert(read.end(), {panel.fabric, panel.back});
        for (const std::filesystem::path &result : scene::replaced_files(job))
            for (const std::filesystem::path &file : read)
                if (!file.empty() && is_same_file(result, file))
                    throw WrongCall({"it would replace " + file.string() + ", which is read",
                                     result.string(), "expected another folder"});
    }

    Status report(const scene::TryOnResult &result, Console &console) const {
        console.warnings(result.report, job.garment.string());
        for (const Problem &warning : result.warnings)
            console.warning(warning);
        for (const std::filesystem::path &file : result.files)
            std::cout << file.string() << "\n";
        if (!result.interrupted)
            return kDone;
        console.error("interrupted; the pictures so far are written");
        return kInterrupted;
    }
};

} // namespace

std::unique_ptr<Command> make_tryon() { return std::make_unique<TryOn>(); }

} // namespace tsuya::program
