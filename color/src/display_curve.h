#pragma once
/// \file
/// Linear light of a channel to its code, by a table.

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace tsuya {

/// A view on the display sRGB, channel by channel, as OpenColorIO has it: straight below 2^-9,
/// linear between 512 values an octave, constant from 2^10. Codes are limited to [0, 1].
class DisplayCurve {
  public:
    /// Of `Plain` or `Soft`; made once.
    static const DisplayCurve &of(const std::string &view);

    float code(float linear) const {
        if (!(linear > kFirst))
            return linear > 0 ? linear * slope_ : 0.0f;
        if (linear >= kLast)
            return codes_.back();
        const std::uint32_t place = std::bit_cast<std::uint32_t>(linear) - kFirstBits;
        const std::uint32_t index = place >> kFractionBits;
        const float share = static_cast<float>(place & ((1u << kFractionBits) - 1)) *
                            (1.0f / static_cast<float>(1u << kFractionBits));
        const float below = codes_[index];
        return below + share * (codes_[index + 1] - below);
    }

  private:
    explicit DisplayCurve(const std::string &view);

    static constexpr int kStepBits = 9, kFractionBits = 23 - kStepBits;
    static constexpr float kFirst = 1.0f / 512, kLast = 1024;
    static constexpr std::uint32_t kFirstBits = std::bit_cast<std::uint32_t>(kFirst),
                                   kLastBits = std::bit_cast<std::uint32_t>(kLast);

    float slope_ = 0;
    std::vector<float> codes_{};
};

} // namespace tsuya
