#include "tsuya/scene/scene_file.h"

#include "pixel_tolerance.h"
#include "scene_reader.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

void add_object(Scene &scene, const std::string &name, Surface surface, std::size_t fabric) {
    const auto index = static_cast<std::uint32_t>(scene.surfaces.size());
    scene.surfaces.push_back(std::move(surface));
    scene.objects.push_back({name, {index}, {static_cast<std::uint32_t>(fabric)}});
}

Fabric load_fabric(const FabricEntry &entry) {
    Fabric fabric;
    if (entry.file.empty())
        fabric.dye = Spectrum::constant(kPlainReflectance);
    else
        fabric = read_fabric(entry.file);
    fabric.name = entry.name;
    if (entry.dye)
        fabric.dye = *entry.dye;
    if (entry.f0)
        fabric.f0 = entry.f0;
    if (entry.transmittance)
        fabric.transmittance = *entry.transmittance;
    if (entry.specular_tint)
        fabric.specular_tint = *entry.specular_tint;
    if (entry.weft_tint)
        fabric.weft_tint = entry.weft_tint;
    if (entry.warp_tint)
        fabric.warp_tint = entry.warp_tint;
    return fabric;
}

/// A visible mesh as its file has it.
struct ShownMesh {
    const MeshEntry *entry;
    garment::MeshFile file;

    /// With its positions in the scene.
    garment::LoadedGarment load(const garment::Options &options, const Progress &progress) const {
        garment::LoadedGarment loaded =
            garment::load(file, options, entry->mesh.string(), progress);
        for (glm::dvec3 &p : loaded.surface.position)
            p += entry->translate;
        return loaded;
    }
};

} // namespace

SceneFile read_scene_file(const std::filesystem::path &path) {
    const Document document(path);
    SceneFile file{.path = path};
    SceneReader reader(document.root(), path.parent_path(), file);
    reader.read();
    document.finish();
    return file;
}

BuiltScene build_scene(const SceneFile &file, const Progress &progress) {
    BuiltScene built;
    Scene &scene = built.scene;
    for (const FabricEntry &entry : file.fabrics)
        scene.fabrics.push_back(load_fabric(entry));
    std::vector<ShownMesh> meshes;
    std::vector<glm::dvec3> framed;
    for (const std::vector<MeshEntry> *entries : {&file.garments, &file.bodies})
        for (const MeshEntry &entry : *entries) {
            if (!entry.visible)
                continue;
            meshes.push_back({&entry, garment::read_mesh(entry.mesh)});
            garment::Options options = entry.options;
            if (entry.tolerance_px)
                options.subdivide.level = kFramingLevel;
            garment::LoadedGarment loaded = meshes.back().load(options, progress);
            framed.insert(framed.end(), loaded.surface.position.begin(),
                          loaded.surface.position.end());
            built.reports.push_back({entry.mesh, std::move(loaded.report)});
            add_object(scene, entry.name, std::move(loaded.surface), entry.fabric);
        }
    if (file.backdrop) {
        add_object(scene, "backdrop", make_cyclorama(file.backdrop->shape), scene.fabrics.size());
        scene.fabrics.push_back({.name = "backdrop", .dye = file.backdrop->reflectance});
    }
    scene.light_groups = file.light_groups;
    scene.rectangles = file.lights;
    scene.environment = file.environment;
    scene.camera = file.camera ? *file.camera : frame_points(framed, file.framing);
    try {
        check_scene(scene);
    } catch (const Error &error) {
        std::vector<Problem> problems = error.problems();
        for (Problem &problem : problems)
            problem.where = file.path.string() + ": " + problem.where;
        throw Error(std::move(problems));
    }
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const MeshEntry &entry = *meshes[m].entry;
        if (!entry.tolerance_px)
            continue;
        garment::Options options = entry.options;
        options.subdivide.view = view_of(scene, framed, *entry.tolerance_px, entry.translate);
        garment::LoadedGarment loaded = meshes[m].load(options, progress);
        scene.surfaces[m] = std::move(loaded.surface);
        built.reports[m].report = std::move(loaded.report);
    }
    return built;
}

} // namespace tsuya::scene
