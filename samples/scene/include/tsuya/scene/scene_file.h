#pragma once
/// \file
/// Scene files: TOML in, Scene out. samples/README.md has every key.
///
///     const SceneFile file = read_scene_file("dress.scene.toml");
///     const BuiltScene built = build_scene(file);
///     const RenderResult result = render(built.scene, file.render);

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/config.h"
#include "tsuya/garment/garment.h"
#include "tsuya/scene/camera_path.h"
#include "tsuya/scene/panel_entry.h"
#include "tsuya/scene/pattern_entry.h"
#include "tsuya/scene/picture.h"
#include "tsuya/scene/studio.h"
#include "tsuya/sdk/render.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

/// `[fabrics.NAME]`
struct FabricEntry {
    std::string name{};
    std::string where{};           ///< file:line:column
    std::filesystem::path file{};  ///< empty: a plain diffuser
    std::optional<Spectrum> dye{}; ///< empty: the file's own, or 0.5 for a plain diffuser
    bool open_dye = false;         ///< see Scene::open_dyes
    /// Empty: the file's own
    std::optional<double> f0{};
    std::optional<Spectrum> transmittance{}, specular_tint{}, weft_tint{}, warp_tint{};
    std::optional<Spectrum> weft_dye{}, warp_dye{};
    std::optional<Lustre> lustre{};
    std::optional<double> delustre{};
    std::optional<std::size_t> pattern{}; ///< into SceneFile::patterns
    std::optional<std::size_t> opacity{}; ///< into SceneFile::opacities
};

/// `[garments.NAME]` or `[bodies.NAME]`. Bodies have no yarn directions.
struct MeshEntry {
    std::string name{};
    std::string where{}; ///< file:line:column
    std::filesystem::path mesh{};
    std::size_t fabric = 0;               ///< into SceneFile::fabrics
    std::optional<std::size_t> back{};    ///< the same; see Object::back
    std::optional<std::size_t> pattern{}; ///< into SceneFile::patterns, in place of the fabric's
    std::optional<std::size_t> opacity{}; ///< into SceneFile::opacities, in place of the fabric's
    std::vector<PanelEntry> panels{};     ///< `[garments.NAME.panels."PATTERN"]`
    bool morph_targets = false;           ///< of the mesh (glTF): frames before `frames`
    std::vector<std::filesystem::path> frames{}; ///< see garment::read_frames; the mesh is frame 0
    garment::Options options{};
    std::optional<double> tolerance_px{}; ///< of the scene's camera; in place of the level
    double turn = 0;               ///< radians about the vertical through its origin, from +z to +x
    glm::dvec3 translate{0, 0, 0}; ///< metres, after the turn
    bool visible = true;
};

/// `[backdrop]`
struct BackdropEntry {
    std::string where{}; ///< file:line:column
    Cyclorama shape{};
    Spectrum reflectance = Spectrum::constant(0.18);
};

/// `[output]`: the pictures that are made from the light transport.
struct OutputEntry {
    std::vector<NamedLamp> lamps{}; ///< none: no picture
    DisplayOptions look = default_look();
    bool metered = false; ///< the exposure is an ExposureMeter's
    bool alpha = false;   ///< see RenderSettings::alpha; the backdrop is left out of the scene
};

/// A scene as its author describes it, with every value in range. Paths are relative to the working
/// directory.
struct SceneFile {
    std::filesystem::path path{};
    std::optional<Camera> camera{};       ///< empty: framed, see below
    std::vector<CameraKey> camera_path{}; ///< the camera is at its first key in frame 0
    Framing framing{};                    ///< of all visible garments and bodies
    std::optional<glm::dvec3> focus{};    ///< a point that is sharp, of a camera with a lens
    std::vector<FabricEntry> fabrics{};
    std::vector<PatternEntry> patterns{};
    std::vector<OpacityEntry> opacities{};
    std::vector<MeshEntry> garments{};
    std::vector<MeshEntry> bodies{};
    std::optional<BackdropEntry> backdrop{};
    std::string studio{}; ///< see make_studio; empty: none
    std::vector<std::string> light_groups{};
    std::vector<std::string> own_lamps{}; ///< of each light group: what parse_lamp takes, or empty
    /// Of a coloured environment, see EnvironmentColours::error.
    std::optional<double> environment_error{};
    std::vector<Light> lights{};
    std::vector<std::string> light_places{}; ///< file:line:column of each light
    std::optional<Environment> environment{};
    RenderSettings render{.widen_after_diffuse = true};
    OutputEntry output{};
    std::vector<std::string> warnings{};        ///< of files of spectra, a sentence each
    std::vector<std::filesystem::path> files{}; ///< all meshes, fabrics and pictures that it names
};

/// Reads a scene file with what it names, but for the meshes. Throws Error with up to 20 problems
/// at file:line:column: unknown keys, values of a wrong type or out of range, unknown names, files
/// that are missing or wrong. Interrupted where `progress` says stop.
SceneFile read_scene_file(const std::filesystem::path &path, const Progress &progress = {});

/// What a mesh file is like.
struct MeshReport {
    std::filesystem::path mesh{};
    garment::Report report{};
};

/// What moves in a scene: shapes, and the camera on its path. Repairs, seams, tessellation and
/// dressing are those of frame 0, and what stands still is not touched.
class SceneFrames {
  public:
    SceneFrames();
    ~SceneFrames();
    SceneFrames(SceneFrames &&) noexcept; ///< the frames moved from may only be assigned to
    SceneFrames &operator=(SceneFrames &&) noexcept; ///< as the move constructor

    /// Number of frames, 1 or more.
    std::size_t count() const { return count_; }
    /// Gives the scene's moving surfaces the shapes of a frame, and the scene its camera. Throws
    /// Error as garment::AnimatedGarment::frame.
    void show(std::size_t frame, Scene &scene);

  private:
    friend struct SceneBuilder;
    struct State;
    std::unique_ptr<State> state_;
    std::size_t count_ = 1;
};

/// A scene file with its meshes and fabrics loaded.
struct BuiltScene {
    Scene scene{};
    std::vector<MeshReport> reports{};    ///< one a visible mesh
    SceneFrames frames{};                 ///< the scene is in frame 0
    std::vector<std::string> own_lamps{}; ///< of the scene's light groups, see note_own_lamps
};

/// Loads the meshes and puts the scene together. A camera that frames by itself frames meshes with
/// `tolerance_px` as level 1 divides them. Throws Error as garment::load, read_fabric and
/// check_scene, whose objects and lights are named as in the file, and where the scene has fewer
/// frames; Interrupted where `progress` says stop.
/// \param frames that are wanted, 1 or more: with 2 or more the camera frames all of them, and
/// every mesh that states frames has as many
BuiltScene build_scene(const SceneFile &file, const Progress &progress = {},
                       std::size_t frames = 1);

} // namespace tsuya::scene
