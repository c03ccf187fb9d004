#include "tsuya/color/measured_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectra/spectral_text.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// The range that every instrument for colour has, and what its outermost sample may be short of it.
constexpr double kFirstNm = 400, kLastNm = 700, kSlackNm = 10;
constexpr const char *kRange =
    "expected wavelengths in nm that cover 400 to 700 nm, in steps of 20 nm or less";
constexpr double kDark = 0.01; // share of a lamp's highest value that counts as none
constexpr double kLargestPower = 1e30;
constexpr double kCoarseNm = 20;
constexpr double kLeastPercent = 1.5; // highest value from which on values are percent
constexpr double kNoiseBelow = 0.01, kNoiseAbove = 0.05; // of reflectances

/// Units that wavelengths might have, and where a visible range lies in them.
struct Unit {
    const char *name;
    double low, high; ///< the range of wavelengths lies inside
    const char *advice;
};
constexpr std::array kUnits{
    Unit{"metres", 1e-7, 4e-6, "multiply them by 1e9"},
    Unit{"micrometres", 0.1, 1.3, "multiply them by 1000"},
    Unit{"electron volts", 1.3, 6.5, "divide 1239.84 by them"},
    Unit{"angstrom", 2000, 11000, "divide them by 10"},
    Unit{"wavenumbers in 1/cm", 11000, 50000, "divide 1e7 by them"},
};

std::string range_text(const Spectrum &s) {
    return number_text(s.wavelength_nm.front()) + " to " + number_text(s.wavelength_nm.back()) +
           " nm";
}

/// One spectrum of a file, and what is told about it.
class Judge {
  public:
    Judge(const std::filesystem::path &path, const std::string &sample)
        : path_(path.string()), sample_(find_sample(read_spectrum_file(path), sample, path_)) {}

    MeasuredSpectrum lamp() {
        if (sample_.quantity == SpectralQuantity::reflectance ||
            sample_.quantity == SpectralQuantity::transmittance)
            refuse("the file says that it holds a reflectance or transmittance",
                   "expected the relative power of a lamp");
        if (sample_.in_row)
            refuse("the spectrum is a row of samples, as charts of reflectances have them",
                   "expected a lamp's power in a column below its name, beside the wavelengths");
        check_wavelengths();
        for (std::size_t i = 0; i < values().size(); ++i)
            if (values()[i] > kLargestPower)
                throw Error({"the value is " + number_text(values()[i]), sample_.where[i],
                             "expected a relative power up to 1e30"});
        limit(-kDark * std::max(0.0, *std::ranges::max_element(values())), 0, kLargestPower,
              kLargestPower);
        cover_lamp();
        warn_coarse();
        if (!(highest_visible() > 0))
            refuse("the lamp has no visible power",
                   "expected positive power between 360 and 830 nm");
        return {std::move(sample_.spectrum), std::move(warnings_)};
    }

    MeasuredSpectrum dye() {
        if (sample_.quantity == SpectralQuantity::power)
            refuse("the file says that it holds the power of a lamp",
                   "expected the reflectance of a cloth");
        check_wavelengths();
        const Spectrum &s = sample_.spectrum;
        if (s.wavelength_nm.front() > kFirstNm + kSlackNm ||
            s.wavelength_nm.back() < kLastNm - kSlackNm)
            refuse("the reflectance is known from " + range_text(s) + " only", kRange);
        take_percent();
        limit(-kNoiseBelow, 0, 1, 1 + kNoiseAbove);
        warn_coarse();
        return {std::move(sample_.spectrum), std::move(warnings_)};
    }

  private:
    std::vector<double> &values() { return sample_.spectrum.value; }

    [[noreturn]] void refuse(std::string what, std::string accepted) const {
        throw Error({std::move(what), path_, std::move(accepted)});
    }

    void warn(const std::string &text) { warnings_.push_back(path_ + ": " + text); }

    void check_wavelengths() const {
        const Spectrum &s = sample_.spectrum;
        for (std::size_t i = 1; i < s.wavelength_nm.size(); ++i)
            if (!(s.wavelength_nm[i] > s.wavelength_nm[i - 1]))
                throw Error(
                    {"the wavelength " + number_text(s.wavelength_nm[i]) + " nm does not increase",
                     sample_.where[i], "expected each wavelength once, in order"});
        const double first = s.wavelength_nm.front(), last = s.wavelength_nm.back();
        if (first > kLastNm || last < kFirstNm)
            for (const Unit &unit : kUnits)
                if (first >= unit.low && last <= unit.high && s.wavelength_nm.size() > 1)
                    refuse("the wavelengths run from " + range_text(s) + ": they look like " +
                               unit.name,
                           std::string(kRange) + "; " + unit.advice);
        if (s.wavelength_nm.size() < 2)
            refuse("the spectrum has one row, at " + number_text(first) + " nm",
                   std::string(kRange) + "; a line has values that fall to 0 on both sides");
        if (first > kLastNm || last < kFirstNm)
            refuse("the wavelengths run from " + range_text(s) + ": none is visible", kRange);
    }

    /// Limits values to [low, high]; those outside [least, most] are refused.
    void limit(double least, double low, double high, double most) {
        Problems problems;
        std::size_t below = 0, above = 0;
        double lowest = 0, highest = 0;
        for (std::size_t i = 0; i < values().size(); ++i) {
            double &v = values()[i];
            if (v < least || v > most)
                problems.add({"the value is " + number_text(v * shown_unit_), sample_.where[i],
                              most < kLargestPower ? share_range() : "expected 0 or more"});
            below += v < low;
            above += v > high;
            lowest = std::min(lowest, v);
            highest = std::max(highest, v);
            v = std::clamp(v, low, high);
        }
        problems.throw_if_any();
        if (below > 0)
            warn(detail::counted(below, "value") + " below 0, down to " +
                 number_text(lowest * shown_unit_) + ", counted as 0");
        if (above > 0)
            warn(detail::counted(above, "value") + " above " + number_text(high * shown_unit_) +
                 ", up to " + number_text(highest * shown_unit_) + ", counted as " +
                 number_text(high * shown_unit_));
    }

    std::string share_range() const {
        return shown_unit_ == 1
                   ? "expected 0 to 1, or percent"
                   : "expected 0 to 100 percent; light that a whitener adds is no reflectance";
    }

    /// Beyond a lamp's ends its power is constant, or 0 where it has fallen.
    void cover_lamp() {
        Spectrum &s = sample_.spectrum;
        const double dark = kDark * *std::ranges::max_element(s.value);
        const bool begins =
            s.wavelength_nm.front() <= kFirstNm + kSlackNm || s.value.front() <= dark;
        const bool ends = s.wavelength_nm.back() >= kLastNm - kSlackNm || s.value.back() <= dark;
        if (!begins || !ends)
            refuse("the lamp is known from " + range_text(s) + " only, and its power is not 0 at " +
                       number_text(begins ? s.wavelength_nm.back() : s.wavelength_nm.front()) +
                       " nm",
                   kRange);
        const double first_step = s.wavelength_nm[1] - s.wavelength_nm[0];
        const double last_step = s.wavelength_nm.back() - *(s.wavelength_nm.end() - 2);
        if (s.wavelength_nm.back() < kLastNm - kSlackNm && s.value.back() > 0) {
            s.wavelength_nm.push_back(s.wavelength_nm.back() + last_step);
            s.value.push_back(0);
        }
        if (s.wavelength_nm.front() > kFirstNm + kSlackNm && s.value.front() > 0) {
            s.wavelength_nm.insert(s.wavelength_nm.begin(), s.wavelength_nm.front() - first_step);
            s.value.insert(s.value.begin(), 0);
        }
    }

    double highest_visible() const {
        constexpr double kObserverFirst = 360, kObserverLast = 830;
        const Spectrum &s = sample_.spectrum;
        double highest = std::max(s.at(kObserverFirst), s.at(kObserverLast));
        for (std::size_t i = 0; i < s.value.size(); ++i)
            if (s.wavelength_nm[i] > kObserverFirst && s.wavelength_nm[i] < kObserverLast)
                highest = std::max(highest, s.value[i]);
        return highest;
    }

    void warn_coarse() {
        const Spectrum &s = sample_.spectrum;
        double widest = 0;
        for (std::size_t i = 1; i < s.value.size(); ++i)
            if (s.wavelength_nm[i] > kFirstNm && s.wavelength_nm[i - 1] < kLastNm &&
                (s.value[i] != 0 || s.value[i - 1] != 0))
                widest = std::max(widest, s.wavelength_nm[i] - s.wavelength_nm[i - 1]);
        if (widest > kCoarseNm)
            warn("steps of " + number_text(widest) +
                 " nm between samples; values between them are linear");
    }

    void take_percent() {
        const double highest = *std::ranges::max_element(values());
        const bool by_value = !sample_.percent && highest > kLeastPercent;
        if (!sample_.percent && !by_value)
            return;
        if (by_value && highest <= 100 * (1 + kNoiseAbove))
            warn("values up to " + number_text(highest) + " are read as percent");
        shown_unit_ = 100;
        for (double &v : values())
            v /= 100;
    }

    std::string path_;
    SpectrumSample sample_;
    double shown_unit_ = 1; ///< 100: values are told in percent
    std::vector<std::string> warnings_{};
};

} // namespace

MeasuredSpectrum read_lamp_file(const std::filesystem::path &path, const std::string &sample) {
    return Judge(path, sample).lamp();
}

MeasuredSpectrum read_dye_file(const std::filesystem::path &path, const std::string &sample) {
    return Judge(path, sample).dye();
}

} // namespace tsuya
