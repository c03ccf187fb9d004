#include "tsuya/scene/scene_file.h"

#include <map>

#include "dressing.h"
#include "file_opacity.h"
#include "index_of.h"
#include "patterns.h"
#include "scene_meshes.h"
#include "scene_reader.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

void add_object(Scene &scene, const std::string &name, Surface surface, Dressing dressing) {
    const auto index = static_cast<std::uint32_t>(scene.surfaces.size());
    scene.surfaces.push_back(std::move(surface));
    scene.objects.push_back(std::move(dressing).object(name, {index}));
}

/// Where the file has the parts of its scene: `a.scene.toml:9:1: lights.key` for `rectangles[0]`.
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
    if (file.backdrop)
        object(file.backdrop->where, "backdrop");
    for (std::size_t i = 0; i < file.light_places.size(); ++i)
        places["rectangles[" + std::to_string(i) + "]"] =
            file.light_places[i] + ": lights." + file.lights[i].name;
    return places;
}

/// The problems of check_scene with the places and names of the file.
Error in_words_of(const SceneFile &file, const Error &error) {
    const std::map<std::string, std::string> places = places_of(file);
    std::vector<Problem> problems = error.problems();
    for (Problem &problem : problems) {
        const std::size_t end = problem.where.find(']') + 1; // 0: none
        const auto place = places.find(problem.where.substr(0, end));
        if (place != places.end())
            problem.where = place->second + problem.where.substr(end);
    }
    return Error(std::move(problems)).within(file.path.string());
}

// Only models that carry views ask for f0; `ggx` and `lambert` do without.
bool looks_at_f0(const CarriedViews &views) {
    return views.model != ViewModel::ggx && views.model != ViewModel::lambert;
}

void set_f0(Fabric &fabric, double f0, const std::string &scene_file) {
    CarriedViews *const views = std::get_if<CarriedViews>(&fabric.specular);
    if (!views || !looks_at_f0(*views))
        throw Error({"f0 has no meaning for this fabric: its specular part does not look at it",
                     scene_file + ": fabrics." + fabric.name + ".f0",
                     "expected a fabric with [views] and a model that carries them: yarn, takeda, "
                     "takeda_printed or half_vector"});
    views->f0 = f0;
}

Fabric load_fabric(const FabricEntry &entry, const std::string &scene_file) {
    Fabric fabric;
    if (entry.file.empty())
        fabric.colours.dye = Spectrum::constant(kPlainReflectance);
    else
        fabric = read_fabric(entry.file);
    fabric.name = entry.name;
    if (entry.dye)
        fabric.colours.dye_all(*entry.dye);
    if (entry.weft_dye)
        fabric.colours.weft_dye = entry.weft_dye;
    if (entry.warp_dye)
        fabric.colours.warp_dye = entry.warp_dye;
    fabric.colours.lustre = entry.lustre.value_or(fabric.colours.lustre);
    if (entry.delustre)
        fabric.colours.delustre = entry.delustre;
    if (entry.f0)
        set_f0(fabric, *entry.f0, scene_file);
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

} // namespace

SceneFile read_scene_file(const std::filesystem::path &path, const Progress &progress) {
    const Document document(path);
    SceneFile file{.path = path};
    SceneReader reader(document.root(), path.parent_path(), file, progress);
    reader.read();
    document.finish();
    return file;
}

BuiltScene build_scene(const SceneFile &file, const Progress &progress) {
    BuiltScene built;
    Scene &scene = built.scene;
    for (const FabricEntry &entry : file.fabrics)
        scene.fabrics.push_back(load_fabric(entry, file.path.string()));
    add_pictures(file.patterns, file.opacities, scene);
    std::vector<DressingFabric> fabrics;
    for (std::size_t i = 0; i < file.fabrics.size(); ++i)
        fabrics.push_back({.needs_frames = needs_frames(scene.fabrics[i]),
                           .print = index_of<PrintTag>(file.fabrics[i].pattern),
                           .opacity = index_of<OpacityTag>(file.fabrics[i].opacity)});
    SceneMeshes meshes(progress);
    for (const std::vector<MeshEntry> *entries : {&file.garments, &file.bodies})
        for (const MeshEntry &entry : *entries) {
            if (!entry.visible)
                continue;
            built.reports.push_back({entry.mesh});
            SceneMesh mesh{.file = garment::read_mesh(entry.mesh, progress),
                           .where = entry.mesh.string(),
                           .options = entry.options,
                           .tolerance_px = entry.tolerance_px,
                           .translate = entry.translate};
            const FabricEntry &fabric = file.fabrics[entry.fabric];
            const auto pattern = entry.pattern ? entry.pattern : fabric.pattern;
            const auto opacity = entry.opacity ? entry.opacity : fabric.opacity;
            Dressing dressing =
                dress({.fabric = index_of<FabricTag>(entry.fabric),
                       .back = index_of<FabricTag>(entry.back),
                       .print = index_of<PrintTag>(pattern),
                       .back_print = entry.back ? fabrics[*entry.back].print : std::nullopt,
                       .opacity = index_of<OpacityTag>(opacity)},
                      entry.panels, fabrics, mesh.file, mesh.options);
            Surface surface = meshes.add(std::move(mesh));
            const std::size_t m = built.reports.size() - 1;
            add_file_opacities(meshes.file(m), meshes.options(m), meshes.report(m).metres_per_uv,
                               dressing, scene);
            add_object(scene, entry.name, std::move(surface), std::move(dressing));
        }
    if (file.backdrop) {
        add_object(scene, "backdrop", make_cyclorama(file.backdrop->shape),
                   {.fabric = index_of<FabricTag>(scene.fabrics.size())});
        scene.fabrics.push_back(
            {.name = "backdrop", .colours = {.dye = file.backdrop->reflectance}});
    }
    scene.light_groups = file.light_groups;
    scene.rectangles = file.lights;
    scene.environment = file.environment;
    scene.camera = file.camera ? *file.camera : frame_points(meshes.points(), file.framing);
    try {
        check_scene(scene);
    } catch (const Error &error) {
        throw in_words_of(file, error);
    }
    meshes.refine(scene);
    for (std::size_t m = 0; m < built.reports.size(); ++m)
        built.reports[m].report = meshes.report(m);
    return built;
}

} // namespace tsuya::scene
