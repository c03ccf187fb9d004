#include "tsuya/scene/tryon.h"

#include <algorithm>
#include <optional>

#include "dressing.h"
#include "file_opacity.h"
#include "patterns.h"
#include "scene_meshes.h"
#include "studio_stage.h"
#include "tryon_cloths.h"
#include "tryon_files.h"
#include "tryon_page.h"
#include "tryon_pictures.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/garment/animation.h"
#include "tsuya/garment/garment.h"
#include "tsuya/scene/channel_warnings.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/studio.h"
#include "tsuya/scene/video.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "turntable.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

constexpr double kBodyReflectance = 0.35;
constexpr double kElevation = 3 * kDegree;    // of the camera
constexpr double kAngleOfView = 24 * kDegree; // an 85 mm lens on 36 mm film

/// A dye by its label.
struct TryOnDye {
    std::string name;
    std::optional<Spectrum> spectrum; ///< empty: the fabric's own
    std::vector<std::string> warnings{};
};

std::vector<TryOnDye> parse_dyes(const TryOn &job) {
    check_dyes(job.dyes);
    std::vector<TryOnDye> dyes;
    for (const std::string &spec : job.dyes) {
        NamedDye dye = find_dye(spec);
        dyes.push_back({label_of(spec), std::move(dye.spectrum), std::move(dye.warnings)});
    }
    return dyes;
}

bool has_own_dye(const TryOn &job, const Fabric &fabric) {
    return job.dyes.empty() || (job.keeps_own_dye && fabric.colours.any_dye());
}

void add_object(Scene &scene, const char *name, Surface surface, Fabric fabric) {
    const auto index = static_cast<std::uint32_t>(scene.surfaces.size());
    const auto of_fabric = static_cast<std::uint32_t>(scene.fabrics.size());
    scene.surfaces.push_back(std::move(surface));
    scene.fabrics.push_back(std::move(fabric));
    scene.objects.push_back({name, {index}, {of_fabric}});
}

/// The camera that frames all points, and the light about them.
void add_studio(const TryOn &job, const std::vector<glm::dvec3> &points, Scene &scene,
                std::vector<std::string> &own_lamps) {
    scene.camera = frame_points(points, {.azimuth = job.azimuth_deg * kDegree,
                                         .elevation = kElevation,
                                         .vertical_angle = kAngleOfView,
                                         .margin = 0.07,
                                         .width = job.width,
                                         .height = job.height,
                                         .orthographic = job.orthographic,
                                         .lens = job.lens});
    scene.light_groups.clear();
    add_studio_to(scene, own_lamps, job.studio, points, job.azimuth_deg * kDegree, job.backdrop);
}

/// A try-on with what further frames of it need.
struct Stage {
    TryOnScene shown{};
    SceneMeshes meshes;           ///< the garment first
    glm::dvec3 axis{0};           ///< of a turntable
    std::vector<Surface> still{}; ///< surfaces of the figure, before they turn

    /// Brings the figure into a frame after the first: its shape, or its turn.
    void show(const TryOn &job, std::size_t frame) {
        Scene &scene = shown.scene;
        if (job.turntable == 0)
            return meshes.show(0, frame, scene.surfaces[0]);
        if (still.empty())
            still.assign(scene.surfaces.begin(),
                         scene.surfaces.begin() + static_cast<std::ptrdiff_t>(meshes.count()));
        for (std::size_t i = 0; i < still.size(); ++i)
            scene.surfaces[i] =
                turned(still[i], axis, turn_of(static_cast<int>(frame), job.turntable));
    }
};

/// What the fields say together.
void check_sequence(const TryOn &job) {
    const bool turns = job.turntable > 0;
    Problems problems;
    problems.need(job.turntable == 0 || (job.turntable >= 2 && job.turntable <= 9999),
                  std::to_string(job.turntable) + " views", "turntable", "expected 2 to 9999");
    problems.need(!turns || (job.frames.empty() && !job.morph_targets),
                  "a figure that turns and has frames", "turntable", "expected one of them");
    problems.need(!turns || !job.tolerance_px,
                  "triangles as fine as one side of a turning figure needs them", "tolerance_px",
                  "expected a level, or a tolerance in metres");
    problems.need(job.video_fps >= 0 && job.video_fps <= 240,
                  std::to_string(job.video_fps) + " frames per second", "video_fps",
                  "expected 1 to 240, or 0 for no video");
    problems.throw_if_any();
}

Stage make_stage(const TryOn &job, const Progress &progress) {
    check_sequence(job);
    Stage stage{.meshes = SceneMeshes(progress)};
    Scene &scene = stage.shown.scene;
    const Cloths cloths(job, progress);
    garment::Options options{.metres_per_unit = garment::metres_per(job.unit),
                             .unit_stated = job.unit_stated,
                             .up = job.up,
                             .seams = job.seams,
                             .subdivide = {.level = job.level, .tolerance = job.tolerance},
                             .frames = {.invented_grain = job.invented_grain,
                                        .max_degenerate_area = job.max_degenerate_area}};
    garment::Options body_options = options;
    body_options.want_frames = false;
    options.metres_per_uv = job.metres_per_uv;
    options.strict = job.strict;
    options.want_frames = cloths.need_frames() || !job.pattern.empty();

    garment::GarmentFrames frames =
        garment::read_frames(job.garment, job.frames, job.morph_targets, progress);
    if (options.want_frames && !job.invented_grain && frames.first.mesh.uv.empty())
        throw Error(
            {"the mesh has no UV, and '" + cloths.fabrics.front().name + "' has a warp direction",
             job.garment.string(),
             "expected the UVs of the panels, or a stated direction of the warp (--grain)"});
    std::optional<PrintIndex> print;
    if (!job.pattern.empty()) {
        add_pictures({{.name = "pattern",
                       .screens = {{job.pattern, {}}},
                       .placement = {.width = job.pattern_width}}},
                     {}, scene);
        print = PrintIndex{0};
    }
    Dressing dressing = dress({.fabric = {0}, .back = cloths.back, .print = print}, cloths.entries,
                              cloths.dressing(), frames.first, options);
    scene.fabrics = cloths.fabrics;
    scene.surfaces.push_back(stage.meshes.add({.file = std::move(frames.first),
                                               .where = job.garment.string(),
                                               .options = options,
                                               .tolerance_px = job.tolerance_px,
                                               .further = std::move(frames.further)}));
    add_file_opacities(stage.meshes.file(0), stage.meshes.options(0),
                       stage.meshes.report(0).metres_per_uv, dressing, scene);
    scene.objects.push_back(std::move(dressing).object("garment", {0}));
    scene.objects.back().garment = true;
    if (!job.body.empty())
        add_object(scene, "body",
                   stage.meshes.add({.file = garment::read_mesh(job.body, progress),
                                     .where = job.body.string(),
                                     .options = body_options,
                                     .tolerance_px = job.tolerance_px}),
                   {.name = "body", .colours = {.dye = Spectrum::constant(kBodyReflectance)}});
    const std::vector<glm::dvec3> &points = stage.meshes.points();
    if (job.turntable > 0) {
        glm::dvec3 lower = points.front(), upper = lower;
        for (const glm::dvec3 &p : points) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
        stage.axis = 0.5 * (lower + upper);
        add_studio(job, all_turns(points, stage.axis, job.turntable), scene, stage.shown.own_lamps);
    } else {
        add_studio(job, points, scene, stage.shown.own_lamps);
    }
    stage.meshes.refine(scene);
    stage.shown.report = stage.meshes.report(0);
    check_scene(scene);
    return stage;
}

/// Leaves the garment's dye open, so that one render shows all dyes; false where other colours of
/// the scene do not let it.
bool leave_dye_open(const TryOn &job, Scene &scene) {
    if (job.wavelengths)
        return false;
    scene.open_dyes = {FabricIndex{0}};
    try {
        dye_variables(scene);
        return true;
    } catch (const Error &) {
        scene.open_dyes.clear();
        return false;
    }
}

RenderSettings settings_of(RenderSettings settings) {
    if (std::find(settings.aovs.begin(), settings.aovs.end(), "garment") == settings.aovs.end())
        settings.aovs.emplace_back("garment");
    // One sample does not tell its noise
    settings.denoise = settings.denoise && settings.stop.samples_per_pixel > 1;
    return settings;
}

/// A video that cannot be made is a warning: its pictures are there.
void write_videos(const std::vector<TryOnDye> &dyes, const std::vector<NamedLamp> &lamps,
                  const TryOn &job, TryOnResult &result) {
    for (const TryOnDye &dye : dyes)
        for (const NamedLamp &lamp : lamps)
            try {
                const fs::path file = job.output / video_name(dye.name, lamp.name);
                write_video(file, fs::path(file).replace_extension(), job.video_fps);
                result.files.push_back(file);
            } catch (const Error &error) {
                const std::vector<Problem> &problems = error.problems();
                result.warnings.insert(result.warnings.end(), problems.begin(), problems.end());
            }
}

// Those of the fabrics are the same in every render.
void add_warnings(const std::vector<Problem> &warnings, TryOnResult &result) {
    for (const Problem &warning : warnings)
        if (std::none_of(result.warnings.begin(), result.warnings.end(), [&](const Problem &known) {
                return known.what == warning.what && known.where == warning.where;
            }))
            result.warnings.push_back(warning);
}

void add_spectrum_warnings(const std::vector<TryOnDye> &dyes, const std::vector<NamedLamp> &lamps,
                           TryOnResult &result) {
    const auto add = [&](const auto &spectra) {
        for (const auto &named : spectra)
            for (const std::string &warning : named.warnings)
                result.warnings.push_back({.what = warning});
    };
    add(dyes);
    add(lamps);
}

} // namespace

void check_dyes(const std::vector<std::string> &specs) {
    for (const std::string &spec : specs)
        check_dye_spec(spec);
    check_distinct(specs, "dye");
}

TryOn sample_try_on(const fs::path &data) {
    return {.garment = data / "dress" / "dress.obj",
            .body = data / "dress" / "dress_form.obj",
            .fabric = find_fabric("black_satin", data)};
}

TryOnScene make_try_on_scene(const TryOn &job, const Progress &progress) {
    return make_stage(job, progress).shown;
}

RenderResult render_try_on(const Scene &scene, const RenderSettings &settings,
                           const Progress &progress, PreparedScene *prepared) {
    return render(scene, settings_of(settings), progress, prepared);
}

TryOnResult run(const TryOn &job, const Progress &progress) {
    check_pictures();
    std::vector<TryOnDye> dyes = parse_dyes(job);
    const std::vector<NamedLamp> lamps = parse_picture_lamps(job.lamps, {}, job.column);
    studio_description(job.studio);
    view_description(job.look.view);
    Stage stage = make_stage(job, progress);
    Scene &scene = stage.shown.scene;
    if (has_own_dye(job, scene.fabrics.front()))
        dyes = {{own_dye_name(job), std::nullopt}};
    const std::size_t frames =
        job.turntable > 0 ? static_cast<std::size_t>(job.turntable) : stage.meshes.frame_count(0);
    const OutputFolder folder(job.output);

    TryOnResult result{.report = std::move(stage.shown.report)};
    add_spectrum_warnings(dyes, lamps, result);
    TryOnPictures pictures(job, lamps, result);
    std::vector<PageDress> dresses;
    RenderSettings settings = settings_of(job.render);
    settings.alpha = settings.alpha || !job.backdrop;
    PreparedScene prepared(job.cache);
    const bool open = dyes.front().spectrum && leave_dye_open(job, scene);
    const std::size_t at_once = open ? dyes.size() : 1; // dyes of one render
    const std::size_t count = frames * dyes.size();
    for (std::size_t i = 0; i < count && !result.interrupted; i += at_once) {
        const std::size_t frame = i / dyes.size(), first = i % dyes.size();
        Progress part{.stop = progress.stop};
        part.report = [&](std::string_view stage_name, double fraction) {
            progress(std::string(stage_name) + (at_once > 1 ? "" : " " + dyes[first].name),
                     (static_cast<double>(i) + fraction * static_cast<double>(at_once)) /
                         static_cast<double>(count));
        };
        if (frame > 0 && first == 0)
            stage.show(job, frame);
        if (dyes[first].spectrum)
            scene.fabrics[0].colours.dye_all(*dyes[first].spectrum);
        add_warnings(channel_warnings(scene, settings), result);
        const std::string number = frames > 1 ? frame_suffix(frame) : "";
        const std::string key = frames > 1 || job.resume ? render_key(scene, settings) : "";
        SpectralImage image;
        if (job.resume)
            image = finished(job.output / transport_name(dyes[first].name, number), key);
        if (image.transport.empty()) {
            RenderResult rendered = render_try_on(scene, settings, part, &prepared);
            result.stats.push_back(rendered.stats);
            result.interrupted = rendered.stats.interrupted;
            add_warnings(rendered.warnings, result);
            note_own_lamps(rendered.image, stage.shown.own_lamps);
            image = std::move(rendered.image);
            if (!result.interrupted && !key.empty())
                image.metadata["render_key"] = key;
        }
        round_as_written(image, job.samples);
        if (job.page && frames == 1)
            dresses.push_back({open ? job.garment.stem().string() : dyes[first].name, image});
        for (std::size_t d = first; d < first + at_once; ++d) {
            if (open)
                set_dye(*image.depths, scene.fabrics[0].name, *dyes[d].spectrum);
            pictures.add(image, dyes[d].name, number);
        }
    }
    pictures.finish();
    if (!result.interrupted && frames == 1) {
        pictures.write_sheet();
        if (job.page)
            write_try_on_page(dresses, lamps, job, result);
    }
    if (!result.interrupted && frames > 1 && job.video_fps > 0)
        write_videos(dyes, lamps, job, result);
    return result;
}

} // namespace tsuya::scene
