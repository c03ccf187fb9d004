#pragma once
// A scene made ready for one render: BVH, lights, materials, camera.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "accelerator.h"
#include "camera_rays.h"
#include "channels.h"
#include "dye_channels.h"
#include "lights.h"
#include "prepared_print.h"
#include "shading.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/frame.h"
#include "tsuya/sdk/phase.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/prepared_scene.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/scene.h"
#include "tsuya/sdk/spectral_basis.h"

namespace tsuya {

// A point on a surface as it is shaded: both normals on the viewer's side.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 geometric_normal; // of the triangle
    float error;                // bound of the position's along that normal, of rounding
    Frame frame;                // its normal is the shading normal
    // From here to the smooth surface that the triangle stands for, where that bulges; else 0
    glm::vec3 bulge;
    glm::vec3 warp; // of the cloth: also where the frame has the weft in its place
    std::uint32_t cloth;
    std::uint32_t colours; // into TracedScene::colours
    glm::vec2 uv;          // of printed cloth, metres

    // False where the triangle is too small for float numbers to have its normal.
    bool is_finite() const { return glm::dot(geometric_normal, geometric_normal) > 0.5f; }
};

// Colours of the parts of a fabric's response, one value a channel of the render.
struct Colours {
    ChannelValues dye{}, transmittance{}, weft{}, warp{}, weft_body{}, warp_body{};
};

struct TracedScene {
    // \param prepared gives what it has, gets what is made, and must outlive this
    // \param keep for further renders with it
    // Throws Error as resolve, and Interrupted where progress.stop becomes true.
    TracedScene(const Scene &scene, const Plan &plan, const SpectralBasis &basis,
                PreparedScene &prepared, bool keep, const Progress &progress);

    const Scene &scene;
    Plan plan;
    glm::dvec3 centre; // of the scene; the origin of all that is traced
    const Accelerator &accelerator;
    Lights lights;
    std::vector<Phase> phases{}; // of the making
    // What the cloths can show of each dye of the plan at most
    std::array<double, kMostDyes> most_dye{1, 1};
    std::vector<Problem> warnings{}; // of the cloths
    CameraRays camera;
    std::vector<Shading> shading{}; // per cloth
    // The same where light was scattered diffusely before; empty where the plan does not widen, or
    // where nothing becomes wider
    std::vector<std::optional<Shading>> wide_shading{};
    std::vector<Colours> colours{}; // per cloth, then of its own back

    // Some cloth has holes.
    bool has_holes() const { return !opacities_.empty(); }
    // The share of the place that is cloth. \param footprint what one sample stands for, metres
    float opacity(const Hit &hit, float footprint) const;
    // Where a ray goes on that went through a hole.
    glm::vec3 behind(const glm::vec3 &direction, const Hit &hit) const;
    // \param wide of light that was scattered diffusely before
    const Shading &shading_of(std::uint32_t cloth, bool wide) const {
        return wide && wide_shading[cloth] ? *wide_shading[cloth] : shading[cloth];
    }
    const Surface &surface_of(const Hit &hit) const {
        return scene.surfaces[scene.objects[hit.object].surface.value];
    }
    // The point that a ray of this direction hit.
    SurfacePoint point(const glm::vec3 &direction, const Hit &hit) const;
    // Of the cloth, metres; 0 where the surface has none.
    glm::vec2 uv_at(const Hit &hit) const;
    // Along the weft, unit; 0 where the surface has no yarns.
    glm::vec3 weft_at(const Hit &hit, const SurfacePoint &point) const;
    // Index of the fabric of the side that is seen, and of a panel of the object's surface.
    std::uint32_t fabric_of(const SurfacePoint &point) const { return cloths_[point.cloth].fabric; }
    std::uint32_t panel_of(const Hit &hit) const;
    bool is_printed(const SurfacePoint &point) const {
        return cloths_[point.cloth].print.has_value();
    }
    // The colours of a printed point. \param distance to the path's vertex before
    Colours printed(const SurfacePoint &point, float distance, bool seen_by_camera) const;

  private:
    // A fabric, and what is printed on it. The first are the fabrics of the scene, in their order.
    struct Cloth {
        std::uint32_t fabric;
        std::optional<std::uint32_t> print;
        bool operator==(const Cloth &) const = default;
    };
    // The cloths of the two sides of a panel.
    struct Sides {
        std::uint32_t face, back;
        bool own_back; // the face's, with the yarn systems exchanged
        std::optional<std::uint32_t> opacity;
    };
    const Sides &sides_at(const Hit &hit) const;
    // A map with its place.
    struct PreparedOpacity {
        const MipTexture *picture;
        ClothPlace place;
        Repeat repeat;
    };
    void prepare_sides();
    void prepare_fabrics(const SpectralBasis &basis, KeptMaterials &materials,
                         const Progress &progress);
    void prepare_prints(const SpectralBasis &basis);
    void find_most_dye(const std::vector<VaryingColours> &varying, KeptMaterials &materials,
                       const Progress &progress);
    std::uint32_t cloth_of(const Cloth &cloth);
    Fabric as_printed(const Cloth &cloth, const SpectralBasis &basis) const;

    std::vector<Cloth> cloths_{};
    std::vector<std::vector<Sides>> sides_{};  // per object, per panel; one where all are alike
    std::vector<MipTexture> textures_{};       // of the scene, where there are prints
    std::vector<PreparedOpacity> opacities_{}; // of the scene
    std::vector<PreparedPrint> prints_{};      // of the scene
    struct Dyes {
        ChannelValues weft{}, warp{};
    };
    std::vector<Dyes> dyes_{}; // of the fabrics, below prints
    // Of each cloth, see Material
    std::vector<std::vector<glm::vec2>> of_dye_{};
    std::vector<float> weft_share_{};
    int channels_ = 0;
};

} // namespace tsuya
