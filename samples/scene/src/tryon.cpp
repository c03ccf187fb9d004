#include "tsuya/scene/tryon.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "pixel_tolerance.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/sheet.h"
#include "tsuya/garment/garment.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/studio.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180;

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

void write_pictures(const SpectralImage &image, const std::string &name,
                    const std::vector<NamedLamp> &lamps, const TryOn &job, Sheet &sheet,
                    TryOnResult &result) {
    result.files.push_back(job.output / (name + ".exr"));
    write_spectral_exr(result.files.back(), image);
    for (const NamedLamp &lamp : lamps) {
        Image picture = picture_under(image, {&lamp, 1}, job.look);
        result.files.push_back(job.output / (name + "-" + lamp.name + ".png"));
        write_png(result.files.back(), picture);
        sheet.pictures.push_back({std::move(picture), caption_of(lamp)});
    }
    sheet.row_labels.push_back(name);
}

} // namespace

TryOn sample_try_on(const fs::path &data) {
    return {.garment = data / "dress" / "dress.obj",
            .body = data / "dress" / "mannequin.obj",
            .fabric = find_fabric("black_satin", data)};
}

TryOnScene make_try_on_scene(const TryOn &job, const Progress &progress) {
    TryOnScene made;
    Scene &scene = made.scene;
    Fabric fabric = read_fabric(job.fabric);
    garment::Options options{.metres_per_unit = garment::metres_per(job.unit),
                             .subdivide = {.level = job.tolerance_px ? kFramingLevel : job.level,
                                           .tolerance = job.tolerance},
                             .frames = {.invented_grain = job.invented_grain}};
    garment::Options body_options = options;
    body_options.want_frames = false;
    options.want_frames = fabric.bard.has_value();

    const garment::MeshFile garment = garment::read_mesh(job.garment);
    garment::MeshFile body;
    const auto load_garment = [&] {
        garment::LoadedGarment loaded =
            garment::load(garment, options, job.garment.string(), progress);
        made.report = std::move(loaded.report);
        return std::move(loaded.surface);
    };
    const auto load_body = [&] {
        return garment::load(body, body_options, job.body.string(), progress).surface;
    };
    add_object(scene, "garment", load_garment(), std::move(fabric));
    std::vector<glm::dvec3> points = scene.surfaces[0].position;
    if (!job.body.empty()) {
        body = garment::read_mesh(job.body);
        add_object(scene, "body", load_body(),
                   {.name = "body", .dye = Spectrum::constant(kBodyReflectance)});
        const std::vector<glm::dvec3> &more = scene.surfaces[1].position;
        points.insert(points.end(), more.begin(), more.end());
    }
    Bounds bounds;
    bounds.add(points);
    scene.camera = frame_points(points, {.azimuth = job.azimuth_deg * kDegree,
                                         .elevation = kElevation,
                                         .vertical_angle = kAngleOfView,
                                         .margin = 0.07,
                                         .width = job.width,
                                         .height = job.height});
    light(scene, bounds, job.azimuth_deg * kDegree);
    if (job.tolerance_px) {
        options.subdivide.view = view_of(scene, points, *job.tolerance_px, glm::dvec3(0.0));
        body_options.subdivide.view = options.subdivide.view;
        scene.surfaces[0] = load_garment();
        if (!job.body.empty())
            scene.surfaces[1] = load_body();
    }
    check_scene(scene);
    return made;
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
    TryOnScene made = make_try_on_scene(job, progress);
    prepare_output_folder(job.output);

    TryOnResult result{.report = std::move(made.report)};
    Sheet sheet{.columns = static_cast<int>(lamps.size())};
    for (std::size_t i = 0; i < dyes.size() && !result.interrupted; ++i) {
        Progress part{.stop = progress.stop};
        part.report = [&](std::string_view stage, double fraction) {
            progress(std::string(stage) + " " + dyes[i].name,
                     (static_cast<double>(i) + fraction) / static_cast<double>(dyes.size()));
        };
        if (dyes[i].spectrum)
            made.scene.fabrics[0].dye = *dyes[i].spectrum;
        const RenderResult rendered = render_try_on(made.scene, job.render, part);
        result.stats.push_back(rendered.stats);
        result.interrupted = rendered.stats.interrupted;
        write_pictures(rendered.image, dyes[i].name, lamps, job, sheet, result);
    }
    if (!result.interrupted) {
        result.files.push_back(job.output / "sheet.png");
        write_png(result.files.back(), draw_sheet(sheet));
    }
    return result;
}

} // namespace tsuya::scene
