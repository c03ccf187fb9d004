#pragma once
// The rays of a camera.

#include <glm/glm.hpp>

#include "sampler.h"
#include "tsuya/sdk/camera.h"

namespace tsuya {

struct CameraRay {
    glm::vec3 origin, direction;
};

class CameraRays {
  public:
    // \param centre the origin of what is traced
    CameraRays(const Camera &camera, const glm::dvec3 &centre);

    // Through a place of the picture, in pixels. \param sampler at the path's first vertex
    CameraRay through(float x, float y, const Sampler &sampler) const;
    // What a pixel sees at a distance, metres.
    float pixel_width(float distance) const { return pixel_angle_ * distance + pixel_size_; }

  private:
    glm::vec2 on_aperture(glm::vec2 u) const;

    // right and up reach from the middle to the edges of the picture: at distance 1 of a
    // perspective
    glm::vec3 eye_, forward_, right_, up_;
    float width_, height_;                   // pixels
    float pixel_angle_ = 0, pixel_size_ = 0; // of a perspective; of parallel rays
    bool parallel_, has_lens_;
    float focus_ = 0;                        // metres along the view
    glm::vec3 aperture_right_, aperture_up_; // half its width and height
    int blades_ = 0;
};

} // namespace tsuya
