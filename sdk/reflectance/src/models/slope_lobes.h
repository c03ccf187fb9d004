#pragma once
// The distribution of normals of filaments at the slopes of YarnLobes: what is fitted, tabulated
// and compared with, in one place.

#include <vector>

#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

// Filaments of one roughness. A slope of YarnLobes stands for a hat over the slopes between its
// neighbours: it is divided into parts that are nearer than the roughness, and what the parts leave
// of the hat's width is in the width of each.
class SlopeLobes {
  public:
    explicit SlopeLobes(double roughness);

    // Density in 1/sr of the normals for a surface of 1 at the k-th slope.
    // along, up: components of a unit half vector along the yarn and along the cloth's normal
    double at(int k, double along, double up) const;
    // The sum over the slopes of one system.
    double of_system(const YarnLobes &lobes, std::size_t axis, double along, double up) const;

  private:
    struct Part {
        double cosine, sine, share;
    };

    double width_ = 0, farthest_ = 0;
    int parts_ = 0;            // of one slope
    std::vector<Part> part_{}; // [slope][part]
};

} // namespace tsuya
