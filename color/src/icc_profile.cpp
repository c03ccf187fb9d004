#include "icc_profile.h"

#include <algorithm>
#include <array>
#include <memory>

#include <lcms2.h>

#include "tsuya/color/config.h"
#include "tsuya/color/rgb_primaries.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

struct FreeCurve {
    void operator()(cmsToneCurve *curve) const { cmsFreeToneCurve(curve); }
};
struct CloseProfile {
    void operator()(void *profile) const { cmsCloseProfile(profile); }
};

cmsCIExyY chromaticity_of(const glm::dvec2 &xy) { return {xy.x, xy.y, 1.0}; }

RgbPrimaries primaries_of(const std::string &display) {
    if (display == "Display P3")
        return kDisplayP3;
    return display == "Rec.2020" ? kRec2020 : kRec709;
}

/// The curve of sRGB [IEC61966], or the power 2.4 of Rec. 1886.
std::unique_ptr<cmsToneCurve, FreeCurve> curve_of(const std::string &display) {
    constexpr std::array kSrgb{2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    return std::unique_ptr<cmsToneCurve, FreeCurve>(
        display.starts_with("Rec.") ? cmsBuildGamma(nullptr, 2.4)
                                    : cmsBuildParametricToneCurve(nullptr, 4, kSrgb.data()));
}

/// Writes the date of no day, so that files of one picture are the same bytes.
void clear_date(std::string &profile) {
    constexpr std::size_t kDate = 24, kDateSize = 12; // of the header
    std::fill_n(profile.begin() + kDate, kDateSize, '\0');
}

} // namespace

std::string icc_profile(const std::string &display) {
    const RgbPrimaries p = primaries_of(display);
    const auto curve = curve_of(display);
    const std::array<cmsToneCurve *, 3> curves{curve.get(), curve.get(), curve.get()};
    const cmsCIExyY white = chromaticity_of(p.white);
    const cmsCIExyYTRIPLE primaries{chromaticity_of(p.red), chromaticity_of(p.green),
                                    chromaticity_of(p.blue)};
    const std::unique_ptr<void, CloseProfile> profile(
        display.starts_with("Rec.2100") || !curve
            ? nullptr
            : cmsCreateRGBProfile(&white, &primaries, curves.data()));
    cmsUInt32Number size = 0;
    if (!profile || !cmsSaveProfileToMem(profile.get(), nullptr, &size))
        throw Error({"there is no ICC profile of the display '" + display + "'", "display",
                     "expected one with a matrix and curves"});
    const std::unique_ptr<cmsMLU, void (*)(cmsMLU *)> name(cmsMLUalloc(nullptr, 1), cmsMLUfree);
    if (name && cmsMLUsetASCII(name.get(), "en", "US", display.c_str()))
        cmsWriteTag(profile.get(), cmsSigProfileDescriptionTag, name.get());
    cmsSaveProfileToMem(profile.get(), nullptr, &size);
    std::string bytes(size, '\0');
    if (!cmsSaveProfileToMem(profile.get(), bytes.data(), &size))
        throw Error({"the ICC profile of '" + display + "' cannot be made", "display",
                     "expected memory for it"});
    clear_date(bytes);
    return bytes;
}

} // namespace tsuya
