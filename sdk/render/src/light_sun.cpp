#include "light_sun.h"

#include <cmath>
#include <limits>

#include "direction_cone.h"

namespace tsuya {

LightSun::LightSun(const SunLight &light)
    : axis_(glm::normalize(light.to_light)), radiance_(static_cast<float>(light.irradiance)),
      irradiance_(light.irradiance) {
    if (light.angular_radius < kSmallestSun)
        return;
    const double sine = std::sin(light.angular_radius);
    wide_ = one_minus_cosine(static_cast<float>(sine * sine));
    radiance_ = static_cast<float>(light.irradiance / (kPi * sine * sine));
    pdf_ = cone_pdf(wide_);
}

LightRay LightSun::sample(glm::vec2 u) const {
    return {wide_ > 0 ? sample_cone(axis_, wide_, u) : axis_,
            std::numeric_limits<float>::infinity(), radiance_, pdf_};
}

} // namespace tsuya
