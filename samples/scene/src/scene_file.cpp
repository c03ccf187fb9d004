#include "tsuya/scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "dressing.h"
#include "file_opacity.h"
#include "index_of.h"
#include "patterns.h"
#include "scene_meshes.h"
#include "scene_reader.h"
#include "studio_stage.h"
#include "tsuya/scene/read_cloth.h"
#include "tsuya/sdk/detail/camera_check.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/plan.h"

namespace tsuya::scene {
namespace {

void add_object(Scene &scene, const std::string &name, Surface surface, Dressing dressing) {
    const auto index = static_cast<std::uint32_t>(scene.surfaces.size());
    scene.surfaces.push_back(std::move(surface));
    scene.objects.push_back(std::move(dressing).object(name, {index}));
}

/// Pictures with alpha have none behind what they show.
bool shows_backdrop(const SceneFile &file) { return file.backdrop && !file.output.alpha; }

/// Where the file has the parts of its scene: `a.scene.toml:9:1: lights.key` for `lights[0]`.
std::map<std::string, std::string> places_of(const SceneFile &file) {
    std::map<std::string, std::string> places;
    std::size_t objects = 0;
    const auto object = [&](const std::string &where, const std::string &key) {
        const std::string index = "[" + std::to_string(objects++) + "]";
        places["objects" + index] = places["surfaces" + index] = where + ": " + key;
    };
    for (const auto &[kind, entries] :
         {std::pair("garments.", &file.garments), std::pair("bodies.", &file.bodies)})
        for (const MeshEntry &entry : *entries)
            if (entry.visible)
                object(entry.where, kind + entry.name);
    if (shows_backdrop(file))
        object(file.backdrop->where, "backdrop");
    for (std::size_t i = 0; i < file.light_places.size(); ++i)
        places["lights[" + std::to_string(i) + "]"] =
            file.light_places[i] + ": lights." + name_of(file.lights[i]);
    for (const FabricEntry &fabric : file.fabrics) {
        const std::string key = "fabrics." + fabric.name;
        places[key] = fabric.where + ": " + key;
        if (fabric.open_dye)
            places.try_emplace("open_dyes", fabric.where + ": " + key + ".dye");
    }
    return places;
}

/// The problems of a scene with the places and names of the file.
Error in_words_of(const SceneFile &file, const Error &error) {
    const std::map<std::string, std::string> places = places_of(file);
    std::vector<Problem> problems = error.problems();
    for (Problem &problem : problems) {
        const std::string where = problem.where;
        for (const auto &[part, place] : places) { // of several that begin it, the last is longest
            const bool of_part = where.starts_with(part) &&
                                 (where.size() == part.size() || where[part.size()] == '.');
            if (of_part)
                problem.where = place + where.substr(part.size());
        }
    }
    return Error(std::move(problems)).within(file.path.string());
}

// Only models that carry views ask for f0; `ggx` and `lambert` do without.
bool looks_at_f0(const CarriedViews &views) {
    return views.model != ViewModel::ggx && views.model != ViewModel::lambert;
}

void set_f0(Fabric &fabric, double f0, const std::string &where) {
    CarriedViews *const views = std::get_if<CarriedViews>(&fabric.specular);
    if (!views || !looks_at_f0(*views))
        throw Error({"f0 has no meaning for this fabric: its specular part does not look at it",
                     where + ": fabrics." + fabric.name + ".f0",
                     "expected a fabric with [views] and a model that carries them: yarn, takeda, "
                     "takeda_printed or half_vector"});
    views->f0 = f0;
}

/// \param fabric as its file has it; without file empty
Fabric as_entered(Fabric fabric, const FabricEntry &entry) {
    if (entry.file.empty())
        fabric.colours.dye = Spectrum::constant(kPlainReflectance);
    fabric.name = entry.name;
    if (entry.dye)
        fabric.colours.dye_all(*entry.dye);
    else if (entry.open_dye && !fabric.colours.any_dye())
        fabric.colours.dye_all(Spectrum::constant(kPlainReflectance));
    if (entry.weft_dye)
        fabric.colours.weft_dye = entry.weft_dye;
    if (entry.warp_dye)
        fabric.colours.warp_dye = entry.warp_dye;
    fabric.colours.lustre = entry.lustre.value_or(fabric.colours.lustre);
    if (entry.delustre)
        fabric.colours.delustre = entry.delustre;
    if (entry.f0)
        set_f0(fabric, *entry.f0, entry.where);
    if (entry.transmittance)
        fabric.colours.transmittance = *entry.transmittance;
    if (entry.specular_tint)
        fabric.colours.specular_tint = *entry.specular_tint;
    if (entry.weft_tint)
        fabric.colours.weft_tint = entry.weft_tint;
    if (entry.warp_tint)
        fabric.colours.warp_tint = entry.warp_tint;
    return fabric;
}

/// A mesh with as many shapes as there are frames, if it moves.
SceneMesh read_entry(const MeshEntry &entry, std::size_t frames, const Progress &progress) {
    SceneMesh mesh{.where = entry.mesh.string(),
                   .options = entry.options,
                   .tolerance_px = entry.tolerance_px,
                   .turn = entry.turn,
                   .translate = entry.translate};
    const bool moves = frames > 1 && (entry.morph_targets || !entry.frames.empty());
    if (!moves) {
        mesh.file = garment::read_mesh(entry.mesh, progress);
        return mesh;
    }
    const std::size_t further = std::min(entry.frames.size(), frames - 1);
    garment::GarmentFrames read = garment::read_frames(
        entry.mesh,
        {entry.frames.begin(), entry.frames.begin() + static_cast<std::ptrdiff_t>(further)},
        entry.morph_targets, progress);
    if (read.further.size() + 1 < frames)
        throw Error({entry.name + " has " + detail::counted(read.further.size() + 1, "frame"),
                     entry.where, "expected " + std::to_string(frames) + " at least"});
    read.further.resize(frames - 1);
    mesh.file = std::move(read.first);
    mesh.further = std::move(read.further);
    return mesh;
}

} // namespace

SceneFile read_scene_file(const std::filesystem::path &path, const Progress &progress) {
    const Document document(path);
    SceneFile file{.path = path};
    SceneReader reader(document.root(), path.parent_path(), file, progress);
    reader.read();
    document.finish();
    return file;
}

struct SceneFrames::State {
    SceneMeshes meshes;
    std::vector<std::size_t> moving{}; ///< which of them
    std::vector<Camera> cameras{};     ///< of each frame; empty: it stands still
};

SceneFrames::SceneFrames() = default;
SceneFrames::~SceneFrames() = default;
SceneFrames::SceneFrames(SceneFrames &&) noexcept = default;
SceneFrames &SceneFrames::operator=(SceneFrames &&) noexcept = default;

void SceneFrames::show(std::size_t frame, Scene &scene) {
    if (!state_)
        return;
    for (const std::size_t m : state_->moving)
        state_->meshes.show(m, frame, scene.surfaces[m]);
    if (!state_->cameras.empty())
        scene.camera = state_->cameras[frame];
}

/// Puts the parts of a scene together, in this order.
struct SceneBuilder {
    const SceneFile &file;
    const Progress &progress;
    std::size_t frames;
    SceneMeshes meshes{progress};
    BuiltScene built{};
    std::vector<DressingFabric> fabrics{};

    void add_fabrics() {
        Scene &scene = built.scene;
        std::map<std::filesystem::path, Fabric> files{{{}, {}}};
        for (const FabricEntry &entry : file.fabrics) {
            if (!files.contains(entry.file))
                files[entry.file] = read_cloth(entry.file, progress);
            scene.fabrics.push_back(as_entered(files[entry.file], entry));
        }
        add_pictures(file.patterns, file.opacities, scene);
        for (std::uint32_t i = 0; i < file.fabrics.size(); ++i)
            if (file.fabrics[i].open_dye)
                scene.open_dyes.push_back({i});
        for (std::size_t i = 0; i < file.fabrics.size(); ++i)
            fabrics.push_back({.needs_frames = needs_frames(scene.fabrics[i]),
                               .print = index_of<PrintTag>(file.fabrics[i].pattern),
                               .opacity = index_of<OpacityTag>(file.fabrics[i].opacity)});
    }

    void add_mesh(const MeshEntry &entry) {
        built.reports.push_back({entry.mesh});
        SceneMesh mesh = read_entry(entry, frames, progress);
        const FabricEntry &fabric = file.fabrics[entry.fabric];
        Dressing dressing =
            dress({.fabric = index_of<FabricTag>(entry.fabric),
                   .back = index_of<FabricTag>(entry.back),
                   .print = index_of<PrintTag>(entry.pattern ? entry.pattern : fabric.pattern),
                   .back_print = entry.back ? fabrics[*entry.back].print : std::nullopt,
                   .opacity = index_of<OpacityTag>(entry.opacity ? entry.opacity : fabric.opacity)},
                  entry.panels, fabrics, mesh.file, mesh.options);
        Surface surface = meshes.add(std::move(mesh));
        const std::size_t m = meshes.count() - 1;
        add_file_opacities(meshes.file(m), meshes.options(m), meshes.report(m).metres_per_uv,
                           dressing, built.scene);
        add_object(built.scene, entry.name, std::move(surface), std::move(dressing));
    }

    void add_backdrop() {
        if (!shows_backdrop(file))
            return;
        Scene &scene = built.scene;
        add_object(scene, "backdrop", make_cyclorama(file.backdrop->shape),
                   {.fabric = index_of<FabricTag>(scene.fabrics.size())});
        scene.fabrics.push_back(
            {.name = "backdrop", .colours = {.dye = file.backdrop->reflectance}});
    }

    void add_camera_and_lights() {
        Scene &scene = built.scene;
        scene.light_groups = file.light_groups;
        built.own_lamps = file.own_lamps;
        scene.lights = file.lights;
        scene.environment = file.environment;
        scene.camera =
            focused(file.camera ? *file.camera : frame_points(meshes.points(), file.framing));
        if (!file.studio.empty()) {
            const glm::dvec3 back = scene.camera.eye - scene.camera.target;
            add_studio_to(scene, built.own_lamps, file.studio, meshes.points(),
                          std::atan2(back.x, back.z), !file.backdrop && !file.output.alpha);
        }
    }

    Camera focused(Camera camera) const {
        if (file.focus && camera.lens)
            camera.lens->focus_distance = distance_along_view(camera, *file.focus);
        return camera;
    }

    void check_and_refine() {
        try {
            check_scene(built.scene);
            if (!built.scene.open_dyes.empty())
                dye_variables(built.scene);
        } catch (const Error &error) {
            throw in_words_of(file, error);
        }
        meshes.refine(built.scene);
        for (std::size_t m = 0; m < built.reports.size(); ++m)
            built.reports[m].report = meshes.report(m);
    }

    void keep_frames() {
        std::vector<std::size_t> moving;
        for (std::size_t m = 0; m < meshes.count(); ++m)
            if (meshes.frame_count(m) > 1)
                moving.push_back(m);
        if (frames > 1 && moving.empty() && file.camera_path.empty())
            throw Error({"nothing moves in the scene", file.path.string(),
                         "expected [[camera.path]], or frames or morph_targets of a garment or "
                         "body"});
        std::vector<Camera> cameras = cameras_of_frames();
        built.frames.count_ = frames;
        built.frames.state_ = std::make_unique<SceneFrames::State>(
            SceneFrames::State{std::move(meshes), std::move(moving), std::move(cameras)});
    }

    /// On the path of the camera. Throws Error where one of them sees nothing.
    std::vector<Camera> cameras_of_frames() const {
        std::vector<Camera> cameras;
        for (std::size_t frame = 0; frame < frames && !file.camera_path.empty(); ++frame) {
            cameras.push_back(focused(
                camera_between(file.camera_path, *file.camera, share_of_frame(frame, frames))));
            try {
                detail::check_camera(cameras.back());
            } catch (const Error &error) {
                throw error.at(file.path.string() + ": camera.path, frame " +
                               std::to_string(frame));
            }
        }
        return cameras;
    }

    /// Triangles as fine as one place of the camera needs them are too coarse for others.
    void refuse_pixels_on_a_path() const {
        for (const std::vector<MeshEntry> *entries : {&file.garments, &file.bodies})
            for (const MeshEntry &entry : *entries)
                if (entry.tolerance_px && !file.camera_path.empty())
                    throw Error({"the camera moves, and tolerance_px is of one place of it",
                                 entry.where, "expected level or tolerance_mm"});
    }
};

BuiltScene build_scene(const SceneFile &file, const Progress &progress, std::size_t frames) {
    SceneBuilder builder{file, progress, frames};
    builder.refuse_pixels_on_a_path();
    builder.add_fabrics();
    for (const std::vector<MeshEntry> *entries : {&file.garments, &file.bodies})
        for (const MeshEntry &entry : *entries)
            if (entry.visible) {
                builder.add_mesh(entry);
                builder.built.scene.objects.back().garment = entries == &file.garments;
            }
    builder.add_backdrop();
    builder.add_camera_and_lights();
    builder.check_and_refine();
    if (frames > 1)
        builder.keep_frames();
    return std::move(builder.built);
}

} // namespace tsuya::scene
