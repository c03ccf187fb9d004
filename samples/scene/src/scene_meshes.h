#pragma once
// The meshes of a scene, as fine as its camera needs them.

#include <optional>
#include <string>
#include <vector>

#include "tsuya/garment/animation.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// A mesh as its file has it, and how it stands in the scene.
struct SceneMesh {
    garment::MeshFile file{};
    std::string where{}; // names it in errors
    garment::Options options{};
    std::optional<double> tolerance_px{}; // of the scene's camera; in place of the level
    double turn = 0;           // radians about the vertical through its origin, from +z to +x
    glm::dvec3 translate{0.0}; // metres, after the turn
    std::vector<std::vector<glm::dvec3>> further{}; // shapes, in units of the file

    // A point of the mesh in the scene, and the other way round.
    glm::dvec3 in_scene(const glm::dvec3 &point) const;
    glm::dvec3 in_mesh(const glm::dvec3 &point) const;
    // Brings the surface of the mesh into the scene.
    void stand(Surface &surface) const;
};

// A mesh with further shapes is framed with all of them. Loads meshes twice where pixels say how
// fine they are: first for a camera to be framed by, then as that camera and the lights need them.
// The scene's first surfaces are these, in their order.
class SceneMeshes {
  public:
    explicit SceneMeshes(const Progress &progress) : progress_(progress) {}

    // Loads a mesh, with a tolerance in pixels as level 1 divides it. Throws as garment::load.
    Surface add(SceneMesh mesh);
    // Further points that the camera frames.
    void add_points(const std::vector<glm::dvec3> &points);
    // All points of the meshes as they were loaded first, in the scene.
    const std::vector<glm::dvec3> &points() const { return points_; }
    // Loads meshes with a tolerance again, for the camera and the lights of the scene.
    void refine(Scene &scene);

    // Shapes of mesh `m` with the one it was loaded in, which is frame 0.
    std::size_t frame_count(std::size_t m) const { return 1 + meshes_[m].further.size(); }
    // Gives the surface of a mesh that has several another shape. Throws as AnimatedGarment::frame.
    void show(std::size_t m, std::size_t frame, Surface &surface);

    std::size_t count() const { return meshes_.size(); }
    // Options and report of mesh `m`, as it was loaded last.
    const garment::Options &options(std::size_t m) const { return meshes_[m].options; }
    const garment::Report &report(std::size_t m) const { return reports_[m]; }
    const garment::MeshFile &file(std::size_t m) const { return meshes_[m].file; }

  private:
    // As it is needed last, with what its frames need.
    garment::LoadedGarment load(std::size_t m);
    void add_further_points(const SceneMesh &mesh);

    Progress progress_;
    std::vector<SceneMesh> meshes_;
    std::vector<garment::Report> reports_;
    std::vector<std::optional<garment::AnimatedGarment>> moving_; // as loaded last
    std::vector<glm::dvec3> points_;
};

} // namespace tsuya::scene
