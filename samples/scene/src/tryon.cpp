#include "tsuya/scene/tryon.h"

#include <algorithm>
#include <optional>

#include "pixel_tolerance.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/sheet.h"
#include "tsuya/garment/animation.h"
#include "tsuya/garment/garment.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/studio.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

// The studio, found by looking at the sample dress.
constexpr double kBodyReflectance = 0.25;
constexpr double kBackdropReflectance = 0.26;
constexpr double kElevation = 3 * kDegree;    // of the camera
constexpr double kAngleOfView = 24 * kDegree; // an 85 mm lens on 36 mm film
constexpr double kKeyAzimuth = -66 * kDegree; // from the camera to the left
constexpr double kKeyElevation = 28 * kDegree;
constexpr double kKeyStrength = 0.8;
constexpr double kFillRadiance = 0.09;

/// A dye with the name that its files bear.
struct NamedDye {
    std::string name;
    std::optional<Spectrum> spectrum; ///< empty: the fabric's own
};

std::vector<NamedDye> parse_dyes(const TryOn &job) {
    if (job.dyes.empty())
        return {{job.fabric.stem().stem().string(), std::nullopt}};
    std::vector<NamedDye> dyes;
    for (const std::string &spec : job.dyes) {
        NamedDye dye{file_stem_of(spec), parse_dye(spec)};
        if (std::any_of(dyes.begin(), dyes.end(),
                        [&](const NamedDye &other) { return other.name == dye.name; }))
            throw Error({"dye '" + dye.name + "' is named twice", "dye", "expected each dye once"});
        dyes.push_back(std::move(dye));
    }
    return dyes;
}

struct Bounds {
    glm::dvec3 lower{std::numeric_limits<double>::max()}, upper{-lower};

    void add(const std::vector<glm::dvec3> &points) {
        for (const glm::dvec3 &p : points) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
    }
};

void add_object(Scene &scene, const char *name, Surface surface, Fabric fabric) {
    const auto index = static_cast<std::uint32_t>(scene.surfaces.size());
    scene.surfaces.push_back(std::move(surface));
    scene.fabrics.push_back(std::move(fabric));
    scene.objects.push_back({name, {index}, {index}});
}

/// Key light, fill light and backdrop about what the camera frames.
void light(Scene &scene, const Bounds &bounds, double azimuth) {
    const glm::dvec3 middle = 0.5 * (bounds.lower + bounds.upper);
    const double size = std::max(glm::length(bounds.upper - bounds.lower), 1e-3);
    scene.light_groups = {"key", "fill"};
    scene.rectangles = {make_light(
        {.centre = middle + 1.5 * size * direction_of(azimuth + kKeyAzimuth, kKeyElevation),
         .target = middle,
         .width = 0.1 * size, // a larger one would blur the satin's lobe
         .height = 0.3 * size,
         .strength = kKeyStrength,
         .group = {0}})};
    scene.environment = Environment{.radiance = kFillRadiance, .group = {1}, .visible = true};
    add_object(scene, "backdrop",
               make_cyclorama({.centre = {middle.x, bounds.lower.y, middle.z},
                               .azimuth = azimuth,
                               .width = 8 * size,
                               .front = 3 * size,
                               .back = 1.6 * size,
                               .height = 4 * size,
                               .radius = 0.8 * size}),
               {.name = "backdrop", .dye = Spectrum::constant(kBackdropReflectance)});
}

/// The camera that frames all points, and the light about them.
void add_studio(const TryOn &job, const std::vector<glm::dvec3> &points, Scene &scene) {
    scene.camera = frame_points(points, {.azimuth = job.azimuth_deg * kDegree,
                                         .elevation = kElevation,
                                         .vertical_angle = kAngleOfView,
                                         .margin = 0.07,
                                         .width = job.width,
                                         .height = job.height});
    Bounds bounds;
    bounds.add(points);
    light(scene, bounds, job.azimuth_deg * kDegree);
}

/// Turns the picture `object`, where the garment is 1, into the garment's coverage: 1 where every
/// sample met it, else 0.
void keep_coverage(SpectralImage &image) {
    for (std::size_t i = 0; i < image.aovs.size(); ++i)
        if (image.aov_names[i] == "object") {
            image.aov_names[i] = "coverage";
            image.aovs[i].channels = {"A"};
            for (float &v : image.aovs[i].data)
                v = v == 1.0f ? 1.0f : 0.0f;
        }
}

std::string number_of(std::size_t frame) {
    const std::string digits = std::to_string(frame);
    return "-" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

/// \param number of the frame, `-0000`, or empty
void write_pictures(const SpectralImage &image, const std::string &name, const std::string &number,
                    const std::vector<NamedLamp> &lamps, const TryOn &job, Sheet &sheet,
                    TryOnResult &result) {
    result.files.push_back(job.output / (name + number + ".exr"));
    write_spectral_exr(result.files.back(), image);
    for (const NamedLamp &lamp : lamps) {
        Image picture = picture_under(image, {&lamp, 1}, job.look);
        result.files.push_back(job.output / (name + "-" + lamp.name + number + ".png"));
        write_png(result.files.back(), picture);
        if (number.empty())
            sheet.pictures.push_back({std::move(picture), caption_of(lamp)});
    }
    if (number.empty())
        sheet.row_labels.push_back(name);
}

/// A try-on with what further frames of it need.
struct Stage {
    TryOnScene shown;
    garment::GarmentFrames frames;
    garment::Options options; ///< of the garment, as they were used
};

/// Places of all vertices of faces in all further frames, metres.
void add_frame_points(const garment::GarmentFrames &frames, double metres_per_unit,
                      std::vector<glm::dvec3> &points) {
    std::vector<bool> used(frames.first.mesh.position.size());
    for (const std::uint32_t v : frames.first.mesh.corner_position)
        used[v] = true;
    for (const std::vector<glm::dvec3> &shape : frames.further)
        for (std::size_t v = 0; v < shape.size(); ++v)
            if (used[v])
                points.push_back(metres_per_unit * shape[v]);
}

Stage make_stage(const TryOn &job, const Progress &progress) {
    Stage stage;
    Scene &scene = stage.shown.scene;
    Fabric fabric = read_fabric(job.fabric);
    garment::Options &options = stage.options;
    options = {.metres_per_unit = garment::metres_per(job.unit),
               .subdivide = {.level = job.tolerance_px ? kFramingLevel : job.level,
                             .tolerance = job.tolerance},
               .frames = {.invented_grain = job.invented_grain,
                          .max_degenerate_area = job.max_degenerate_area}};
    garment::Options body_options = options;
    body_options.want_frames = false;
    options.strict = job.strict;
    options.want_frames = fabric.bard.has_value();

    stage.frames = garment::read_frames(job.garment, job.frames, job.morph_targets);
    const auto load_garment = [&] {
        garment::LoadedGarment loaded =
            garment::load(stage.frames.first, options, job.garment.string(), progress);
        stage.shown.report = std::move(loaded.report);
        return std::move(loaded.surface);
    };
    garment::MeshFile body;
    const auto load_body = [&] {
        return garment::load(body, body_options, job.body.string(), progress).surface;
    };
    add_object(scene, "garment", load_garment(), std::move(fabric));
    std::vector<glm::dvec3> points = scene.surfaces[0].position;
    add_frame_points(stage.frames, options.metres_per_unit, points);
    if (!job.body.empty()) {
        body = garment::read_mesh(job.body);
        add_object(scene, "body", load_body(),
                   {.name = "body", .dye = Spectrum::constant(kBodyReflectance)});
        const std::vector<glm::dvec3> &more = scene.surfaces[1].position;
        points.insert(points.end(), more.begin(), more.end());
    }
    add_studio(job, points, scene);
    if (job.tolerance_px) {
        options.subdivide.view = view_of(scene, points, *job.tolerance_px, glm::dvec3(0.0));
        body_options.subdivide.view = options.subdivide.view;
        scene.surfaces[0] = load_garment();
        if (!job.body.empty())
            scene.surfaces[1] = load_body();
    }
    check_scene(scene);
    return stage;
}

} // namespace

TryOn sample_try_on(const fs::path &data) {
    return {.garment = data / "dress" / "dress.obj",
            .body = data / "dress" / "mannequin.obj",
            .fabric = find_fabric("black_satin", data)};
}

TryOnScene make_try_on_scene(const TryOn &job, const Progress &progress) {
    return make_stage(job, progress).shown;
}

RenderResult render_try_on(const Scene &scene, RenderSettings settings, const Progress &progress) {
    settings.aovs = {"object"};
    RenderResult rendered = render(scene, settings, progress);
    keep_coverage(rendered.image);
    return rendered;
}

TryOnResult run(const TryOn &job, const Progress &progress) {
    const std::vector<NamedDye> dyes = parse_dyes(job);
    const std::vector<NamedLamp> lamps = parse_lamps(job.lamps);
    view_description(job.look.view);
    Stage stage = make_stage(job, progress);
    Scene &scene = stage.shown.scene;
    std::optional<garment::AnimatedGarment> show;
    if (!stage.frames.further.empty())
        show.emplace(stage.frames.first, stage.options, job.garment.string());
    prepare_output_folder(job.output);

    TryOnResult result{.report = std::move(stage.shown.report)};
    Sheet sheet{.columns = static_cast<int>(lamps.size())};
    const std::size_t shapes = 1 + stage.frames.further.size(), count = shapes * dyes.size();
    for (std::size_t i = 0; i < count && !result.interrupted; ++i) {
        const std::size_t frame = i / dyes.size();
        const NamedDye &dye = dyes[i % dyes.size()];
        Progress part{.stop = progress.stop};
        part.report = [&](std::string_view stage_name, double fraction) {
            progress(std::string(stage_name) + " " + dye.name,
                     (static_cast<double>(i) + fraction) / static_cast<double>(count));
        };
        if (frame > 0 && i % dyes.size() == 0)
            scene.surfaces[0] = show->frame(stage.frames.further[frame - 1]);
        if (dye.spectrum)
            scene.fabrics[0].dye = *dye.spectrum;
        const RenderResult rendered = render_try_on(scene, job.render, part);
        result.stats.push_back(rendered.stats);
        result.interrupted = rendered.stats.interrupted;
        write_pictures(rendered.image, dye.name, show ? number_of(frame) : "", lamps, job, sheet,
                       result);
    }
    if (!result.interrupted && !show) {
        result.files.push_back(job.output / "sheet.png");
        write_png(result.files.back(), draw_sheet(sheet));
    }
    return result;
}

} // namespace tsuya::scene
