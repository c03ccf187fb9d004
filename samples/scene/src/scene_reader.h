#pragma once
// From the sections of a scene file to a SceneFile. Problems are noted in the document.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/studio_preset.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {

// Of a fabric without a file and a dye.
inline constexpr double kPlainReflectance = 0.5;

inline constexpr double kLargest = 1e6;   // metres, radiance, ...
inline constexpr double kSmallest = 1e-6; // of what has to be above 0

// Member functions stand in scene_reader.cpp, the camera in camera_section.cpp, fabrics and
// pictures in cloth_sections.cpp, meshes in mesh_sections.cpp, lights in light_sections.cpp.

class SceneReader {
  public:
    // `progress` must outlive this.
    SceneReader(Section root, std::filesystem::path folder, SceneFile &file,
                const Progress &progress)
        : root_(root), folder_(std::move(folder)), file_(file), progress_(progress) {}

    void read();

  private:
    void read_camera();
    void read_framing(const Section &camera);
    // Keys of a camera that moves.
    void read_path(const Section &camera);
    CameraKey read_key(const Section &section, const glm::dvec3 &up, double vertical_angle);
    void read_projection(const Section &camera);
    void read_lens(const Section &camera);
    void read_fabrics();
    void read_meshes(const char *kind, bool yarn, std::vector<MeshEntry> &entries);
    // Further shapes of a mesh.
    void read_frames(const Section &section, MeshEntry &entry);
    void read_panels(const Section &panels, bool yarn, MeshEntry &entry);
    // Index of the fabric that a key names; empty where it names none.
    std::optional<std::size_t> fabric_named(const Section &section, const char *key);
    void read_cloth(const Section &section, MeshEntry &entry);
    void read_grain(const Section &grain, MeshEntry &entry);
    void read_backdrop();
    void read_units();
    void read_studio();
    void read_lights();
    void read_light(const std::string &name, const Section &section);
    RectangleLight read_rectangle(const Section &section, const glm::dvec3 &target);
    DiskLight read_disk(const Section &section, const glm::dvec3 &target);
    SphereLight read_sphere(const Section &section);
    PointLight read_point(const Section &section);
    PointLight read_spot(const Section &section, const glm::dvec3 &target);
    PointLight read_luminaire(const Section &section, const glm::dvec3 &target);
    SunLight read_sun(const Section &section);
    LightBehaviour read_behaviour(const Section &section);
    // What a section says of the strength of its light, in one of several units.
    struct GivenStrength {
        std::string_view unit{};
        double value = 1;
        std::optional<glm::dvec3> at{}; // the point of it; empty: the target
    };
    GivenStrength read_strength(const Section &section, const std::string &kind);
    // Scales a light to its strength.
    void give_strength(const Section &section, const GivenStrength &given, const glm::dvec3 &target,
                       Light &light);
    glm::dvec3 centre_of(const Section &section);
    // From the centre of a light to its target.
    static glm::dvec3 facing(const glm::dvec3 &centre, const glm::dvec3 &target);
    void read_environment();
    // The picture of an environment, from one of several sources.
    void read_environment_picture(const Section &section, Environment &environment);
    void read_sky(const Section &sky, Environment &environment);
    void read_colours(const Section &section, Environment &environment);
    // The lamp of a group of its own.
    void read_own_lamp(const Section &section, LightGroupIndex group);
    // The lamp that the studio's lights in a group of this name have; empty: there are none.
    std::string lamp_of_studio(const std::string &group) const;
    // Pictures under the lights' own lamps need one for every group.
    void check_own_lamps();
    void read_render();
    void read_output();

    // Index of a light group by name, made where it is new.
    LightGroupIndex group(const Section &section, const std::string &otherwise);
    // `dye` or `reflectance`.
    std::optional<Spectrum> reflectance(const Section &section);
    std::optional<Spectrum> dyed(const Section &section, const char *key);
    // A print or holes lie on the mesh, so its UVs are needed.
    bool has_pictures(const MeshEntry &entry) const;
    // Where a picture lies on the cloth.
    static Placement placement(const Section &section);
    // Index of the opacity of a fabric, a garment or panels; empty where it has none.
    std::optional<std::size_t> opacity(const Section &of);
    // Index of the pattern of a fabric, a garment or panels; empty where it has none.
    std::optional<std::size_t> pattern(const Section &of, const std::string &owner);
    void add_warnings(const std::vector<std::string> &warnings) {
        file_.warnings.insert(file_.warnings.end(), warnings.begin(), warnings.end());
    }
    // A number from 0 to 1, or a text as `dye` has it.
    std::optional<Spectrum> colour(const Section &section, const char *key);
    std::filesystem::path existing_file(const Section &section, std::string_view key,
                                        bool required);
    static bool is_file(const std::filesystem::path &path) {
        std::error_code code;
        return std::filesystem::is_regular_file(path, code);
    }
    // Runs `work`; an Error becomes a problem at the key.
    template <class Work> void note(const Section &section, std::string_view key, Work &&work) {
        try {
            work();
        } catch (const Error &error) {
            section.problem(key, error);
        }
    }

    Section root_;
    std::filesystem::path folder_;
    SceneFile &file_;
    const Progress &progress_;
    std::vector<StudioGroup> studio_groups_{};
    bool names_light_ = false;
    double white_lux_ = 1000;
};

} // namespace tsuya::scene
