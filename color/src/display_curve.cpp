#include "display_curve.h"

#include <algorithm>

#include "made_config.h"

namespace OCIO = OCIO_NAMESPACE;

namespace tsuya {

const DisplayCurve &DisplayCurve::of(const std::string &view) {
    if (view == "Soft") {
        static const DisplayCurve soft("Soft");
        return soft;
    }
    static const DisplayCurve plain("Plain");
    return plain;
}

DisplayCurve::DisplayCurve(const std::string &view) {
    for (std::uint32_t bits = kFirstBits; bits <= kLastBits; bits += 1u << kFractionBits)
        codes_.push_back(std::bit_cast<float>(bits));
    // Greys: matrices of the view and the display leave them as they are.
    std::vector<float> greys;
    for (const float linear : codes_)
        greys.insert(greys.end(), 3, linear);
    try {
        const auto processor = make_config({})->getProcessor("Linear Rec.709", "sRGB", view.c_str(),
                                                             OCIO::TRANSFORM_DIR_FORWARD);
        OCIO::PackedImageDesc description(greys.data(), static_cast<long>(codes_.size()), 1,
                                          OCIO::CHANNEL_ORDERING_RGB);
        processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS)->apply(description);
    } catch (const OCIO::Exception &error) {
        throw_ocio(error, "display config");
    }
    for (std::size_t i = 0; i < codes_.size(); ++i)
        codes_[i] = std::clamp(greys[3 * i + 1], 0.0f, 1.0f);
    slope_ = codes_.front() / kFirst;
}

} // namespace tsuya
