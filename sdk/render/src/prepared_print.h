#pragma once
// A print made ready for tracing.

#include <vector>

#include <glm/glm.hpp>

#include "channels.h"
#include "cloth_place.h"
#include "mip_texture.h"
#include "tsuya/sdk/print.h"
#include "tsuya/sdk/spectral_basis.h"

namespace tsuya {

// The reflectances of inks in the channels of a render.
struct PreparedLayer {
    const MipTexture *picture;
    std::vector<ChannelValues> inks; // one or eight
};

class PreparedPrint {
  public:
    // \param textures those of the scene, which must outlive this
    PreparedPrint(const Print &print, const std::vector<MipTexture> &textures,
                  const SpectralBasis &basis);

    // Replaces the dyes of the cloth's two yarn systems by that of the print where it covers them.
    // \param uv metres of cloth
    // \param footprint what one sample stands for, metres
    void dye(glm::vec2 uv, float footprint, ChannelValues &weft, ChannelValues &warp) const;
    // The same of one system by the means of its pictures.
    void mean_dye(ChannelValues &dye) const;

  private:
    // Of the layer at a pixel.
    ChannelValues ink(const PreparedLayer &layer, const glm::vec4 &pixel) const;
    void cover(float share, const ChannelValues &ink, ChannelValues &dye) const;

    std::vector<PreparedLayer> layers_{};
    ClothPlace place_;
    Repeat repeat_;
    int channels_;
};

} // namespace tsuya
