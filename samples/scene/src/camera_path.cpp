#include "tsuya/scene/camera_path.h"

#include <algorithm>
#include <cstddef>

namespace tsuya::scene {
namespace {

/// A value that moves through those of the keys; of any type that adds and scales.
template <class Value> class Curve {
  public:
    /// \param of the value of a key
    template <class Of> Curve(const std::vector<CameraKey> &keys, const Of &of) {
        for (const CameraKey &key : keys) {
            at_.push_back(key.at);
            value_.push_back(of(key));
        }
        slope_.resize(keys.size(), Value(0)); // at rest
        for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
            const double before = at_[i] - at_[i - 1], after = at_[i + 1] - at_[i];
            slope_[i] = (after * rise(i - 1) + before * rise(i)) / (before + after);
        }
    }

    Value operator()(double at) const {
        const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, at);
        const auto i = static_cast<std::size_t>(next - at_.begin()) - 1;
        const double length = at_[i + 1] - at_[i], t = (at - at_[i]) / length;
        // Cubic Hermite polynomials
        return (1 + 2 * t) * (1 - t) * (1 - t) * value_[i] + t * t * (3 - 2 * t) * value_[i + 1] +
               t * (1 - t) * length * ((1 - t) * slope_[i] - t * slope_[i + 1]);
    }

  private:
    /// Mean slope of the interval after key `i`.
    Value rise(std::size_t i) const { return (value_[i + 1] - value_[i]) / (at_[i + 1] - at_[i]); }

    std::vector<double> at_{};
    std::vector<Value> value_{}, slope_{};
};

} // namespace

Camera camera_between(const std::vector<CameraKey> &keys, Camera camera, double at) {
    camera.eye = Curve<glm::dvec3>(keys, [](const CameraKey &k) { return k.eye; })(at);
    camera.target = Curve<glm::dvec3>(keys, [](const CameraKey &k) { return k.target; })(at);
    camera.vertical_angle =
        Curve<double>(keys, [](const CameraKey &k) { return k.vertical_angle; })(at);
    return camera;
}

double share_of_frame(std::size_t frame, std::size_t frames) {
    return frames > 1 ? static_cast<double>(frame) / static_cast<double>(frames - 1) : 0;
}

} // namespace tsuya::scene
