// CGATS tables, by Little CMS.

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <lcms2.h>

#include "spectra/spectral_formats.h"
#include "spectra/spectral_text.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// A context whose messages are kept.
class Messages {
  public:
    Messages() : context_(cmsCreateContext(nullptr, this)) {
        cmsSetLogErrorHandlerTHR(
            context_, [](cmsContext context, cmsUInt32Number, const char *text) {
                static_cast<Messages *>(cmsGetContextUserData(context))->text_ = text;
            });
    }
    ~Messages() { cmsDeleteContext(context_); }
    Messages(const Messages &) = delete;
    Messages &operator=(const Messages &) = delete;

    cmsContext context() const { return context_; }
    /// The last one, without the place of a file that it was not told.
    std::string text() const { return text_.starts_with(": ") ? text_.substr(2) : text_; }

  private:
    cmsContext context_;
    std::string text_{};
};

struct CloseTable {
    void operator()(void *handle) const { cmsIT8Free(handle); }
};

/// One table of a file.
class CgatsTable {
  public:
    CgatsTable(cmsHANDLE handle, const std::string &name, SpectrumFile &file, Problems &problems)
        : handle_(handle), name_(name), file_(file), problems_(problems) {}

    void read() {
        char **names = nullptr;
        const int count = cmsIT8EnumDataFormat(handle_, &names);
        for (int i = 0; i < count; ++i) {
            const std::string field = names[i] ? names[i] : "";
            if (const auto nm = wavelength_in_name(field)) {
                columns_.push_back(i);
                wavelength_nm_.push_back(*nm);
            } else if (const std::string plain = plain_name(field);
                       plain == "samplename" || (plain == "sampleid" && name_column_ < 0)) {
                name_column_ = i;
            }
        }
        if (columns_.size() < 2)
            return;
        place_bands();
        const auto sets = static_cast<int>(property("NUMBER_OF_SETS").value_or(0));
        for (int row = 0; row < sets && !problems_.full(); ++row)
            read_row(row);
    }

  private:
    std::optional<double> property(const char *key) const {
        const char *const text = cmsIT8GetProperty(handle_, key);
        return text ? detail::DecimalReader().read(text) : std::nullopt;
    }

    std::string text_property(const char *key) const {
        const char *const text = cmsIT8GetProperty(handle_, key);
        return text ? plain_name(text) : std::string();
    }

    /// Argyll rounds wavelengths in names; the first and the last stand elsewhere.
    void place_bands() {
        const auto first = property("SPECTRAL_START_NM"), last = property("SPECTRAL_END_NM");
        if (!first || !last || *first == *last)
            return;
        const auto steps = static_cast<double>(wavelength_nm_.size() - 1);
        for (std::size_t i = 0; i < wavelength_nm_.size(); ++i)
            wavelength_nm_[i] = *first + (*last - *first) * static_cast<double>(i) / steps;
    }

    SpectralQuantity quantity() const {
        const std::string type = text_property("MEAS_TYPE");
        if (type == "emission" || type == "ambient")
            return SpectralQuantity::power;
        if (type == "reflective")
            return SpectralQuantity::reflectance;
        return type == "transmissive" ? SpectralQuantity::transmittance : SpectralQuantity::unknown;
    }

    void read_row(int row) {
        constexpr double kPercent = 100;
        const char *const named =
            name_column_ < 0 ? nullptr : cmsIT8GetDataRowCol(handle_, row, name_column_);
        SpectrumSample sample{.name = named ? named : std::to_string(row + 1),
                              .quantity = quantity()};
        sample.percent =
            property("SPECTRAL_NORM") == kPercent && sample.quantity != SpectralQuantity::power;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const char *const given = cmsIT8GetDataRowCol(handle_, row, columns_[i]);
            const std::string text = given ? given : "";
            const auto value = detail::DecimalReader().read(text);
            const std::string where = name_ + ": set " + std::to_string(row + 1) + ", " +
                                      number_text(wavelength_nm_[i]) + " nm";
            if (!value) {
                problems_.add({"'" + text + "' is not a number", where,
                               "expected a finite number such as 0.25"});
                return;
            }
            sample.spectrum.wavelength_nm.push_back(wavelength_nm_[i]);
            sample.spectrum.value.push_back(*value);
            sample.where.push_back(where);
        }
        file_.samples.push_back(std::move(sample));
    }

    cmsHANDLE handle_;
    const std::string &name_;
    SpectrumFile &file_;
    Problems &problems_;
    std::vector<int> columns_{};
    std::vector<double> wavelength_nm_{};
    int name_column_ = -1;
};

} // namespace

SpectrumFile parse_cgats(std::string_view bytes, const std::string &name) {
    if (bytes.empty()) // Little CMS would end the process
        throw Error({"the file holds no spectrum", name, "expected a CGATS table"});
    const Messages messages;
    if (bytes.size() > std::numeric_limits<cmsUInt32Number>::max())
        throw Error({"the file is too large for a table", name, "expected less than 4 GB"});
    const std::unique_ptr<void, CloseTable> handle(cmsIT8LoadFromMem(
        messages.context(), bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    if (!handle)
        throw Error({"the table cannot be read: " +
                         (messages.text().empty() ? "it is no CGATS file" : messages.text()),
                     name, "expected a CGATS table such as Argyll's .ti3 and .sp"});
    SpectrumFile file;
    Problems problems;
    const cmsUInt32Number tables = cmsIT8TableCount(handle.get());
    for (cmsUInt32Number table = 0; table < tables; ++table) {
        cmsIT8SetTable(handle.get(), table);
        CgatsTable(handle.get(), name, file, problems).read();
    }
    if (problems.empty() && file.samples.empty())
        problems.add({"the file holds no spectrum", name,
                      "expected fields that name wavelengths, such as SPEC_560"});
    problems.throw_if_any();
    return file;
}

} // namespace tsuya
