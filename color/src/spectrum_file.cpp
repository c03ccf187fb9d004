#include "tsuya/color/spectrum_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "lower_case.h"
#include "spectra/spectral_formats.h"
#include "spectra/spectral_text.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

using Reader = SpectrumFile (*)(std::string_view bytes, const std::string &name);

struct Format {
    std::string_view ending;
    Reader read;
};

SpectrumFile read_text_table(std::string_view bytes, const std::string &name) {
    const std::string text = decode_text(bytes, name);
    return text.find("BEGIN_DATA_FORMAT") == text.npos ? parse_spectral_text(text, name)
                                                       : parse_cgats(text, name);
}

constexpr std::array kFormats{
    Format{".csv", read_text_table}, Format{".txt", read_text_table},
    Format{".tsv", read_text_table}, Format{".spdx", parse_tm27},
    Format{".cxf", parse_cxf},       Format{".ti3", parse_cgats},
    Format{".sp", parse_cgats},      Format{".cgats", parse_cgats},
    Format{".qtx", parse_qtx},       Format{".mif", parse_mif},
};

const Format *format_of(std::string_view file) {
    const std::string name = lower_case(file);
    const auto found = std::ranges::find_if(
        kFormats, [&](const Format &format) { return name.ends_with(format.ending); });
    return found == kFormats.end() ? nullptr : &*found;
}

} // namespace

std::string spectrum_file_endings() {
    std::string text;
    for (const Format &format : kFormats)
        text += (text.empty() ? "" : ", ") + std::string(format.ending);
    return text;
}

std::optional<SpectrumFileSpec> parse_spectrum_file_spec(std::string_view text) {
    if (format_of(text))
        return SpectrumFileSpec{std::filesystem::path(text), {}};
    for (std::size_t colon = text.find(':'); colon != text.npos; colon = text.find(':', colon + 1))
        if (format_of(text.substr(0, colon)))
            return SpectrumFileSpec{std::filesystem::path(text.substr(0, colon)),
                                    std::string(text.substr(colon + 1))};
    return std::nullopt;
}

SpectrumFile read_spectrum_file(const std::filesystem::path &path) {
    const Format *const format = format_of(path.string());
    if (!format)
        throw Error({"the file has an ending that no format of spectra has", path.string(),
                     "expected one of: " + spectrum_file_endings()});
    SpectrumFile file = format->read(read_file(path), path.string());
    for (SpectrumSample &sample : file.samples)
        sort_rising(sample);
    return file;
}

const SpectrumSample &find_sample(const SpectrumFile &file, const std::string &name,
                                  const std::string &where) {
    if (name.empty() && file.samples.size() == 1)
        return file.samples.front();
    std::vector<std::string> names;
    for (const SpectrumSample &sample : file.samples) {
        if (!name.empty() && lower_case(sample.name) == lower_case(name))
            return sample;
        names.push_back(sample.name);
    }
    constexpr std::size_t kShown = 30;
    const std::string known =
        names.size() > kShown ? "expected the name of one of them" : accepted_names(name, names);
    if (name.empty())
        throw Error({"the file holds " + detail::counted(names.size(), "spectrum", "spectra"),
                     where, known + ", as FILE:NAME"});
    throw Error({"the file holds no spectrum '" + name + "'", where, known});
}

void write_spectrum_csv(const std::filesystem::path &path, const Spectrum &spectrum,
                        const std::string &comment) {
    check_spectrum(spectrum, std::numeric_limits<double>::lowest(),
                   std::numeric_limits<double>::max(), path.string());
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    std::istringstream lines(comment);
    for (std::string line; std::getline(lines, line);)
        text << "# " << line << '\n';
    text << "wavelength_nm,value\n";
    for (std::size_t i = 0; i < spectrum.value.size(); ++i)
        text << spectrum.wavelength_nm[i] << ',' << spectrum.value[i] << '\n';
    write_file(path, text.str());
}

} // namespace tsuya
