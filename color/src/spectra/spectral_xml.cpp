// TM-27 and CxF3.

#include <algorithm>
#include <map>
#include <optional>

#include <pugixml.hpp>

#include "lower_case.h"
#include "spectra/spectral_formats.h"
#include "spectra/spectral_text.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

using detail::DecimalReader;

/// The name without its namespace.
std::string local_name(const pugi::xml_node &node) {
    const std::string name = node.name();
    return name.substr(name.find(':') + 1);
}

class XmlSpectra {
  public:
    XmlSpectra(std::string_view bytes, std::string name)
        : name_(std::move(name)), text_(decode_text(bytes, name_)) {
        const pugi::xml_parse_result result = document_.load_buffer(
            text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!result)
            throw Error({std::string("the XML cannot be read: ") + result.description(),
                         place(result.offset), "expected XML that is complete"});
    }

    SpectrumFile tm27() {
        for_each("SpectralDistribution", [&](const pugi::xml_node &node) {
            SpectrumSample sample{.name = std::to_string(file_.samples.size() + 1)};
            for (const pugi::xml_node &child : node.children())
                if (local_name(child) == "SpectralQuantity")
                    sample.quantity = quantity_of(child.text().get());
                else if (local_name(child) == "SpectralData")
                    add(sample, child, child.attribute("wavelength").value(), child.text().get());
            keep(std::move(sample));
        });
        return finish("SpectralDistribution");
    }

    SpectrumFile cxf() {
        for_each("ColorSpecification", [&](const pugi::xml_node &node) {
            specifications_[node.attribute("Id").value()] = node;
        });
        for_each("Object", [&](const pugi::xml_node &object) {
            for (const pugi::xml_node &values : object.children())
                for (const pugi::xml_node &spectrum : values.children())
                    read_cxf(object, spectrum);
        });
        return finish("Object with a spectrum");
    }

  private:
    /// Every element of that name.
    template <class Take> void for_each(std::string_view element, const Take &take) {
        struct Walker : pugi::xml_tree_walker {
            std::string_view element;
            const Take *take = nullptr;
            bool for_each(pugi::xml_node &node) override {
                if (local_name(node) == element)
                    (*take)(node);
                return true;
            }
        } walker;
        walker.element = element;
        walker.take = &take;
        document_.traverse(walker);
    }

    static SpectralQuantity quantity_of(const std::string &text) {
        const std::string plain = plain_name(text);
        if (plain == "reflectance" || plain == "rvalues")
            return SpectralQuantity::reflectance;
        if (plain == "transmittance" || plain == "absorptance" || plain == "tvalues")
            return SpectralQuantity::transmittance;
        return plain.empty() || plain == "other" ? SpectralQuantity::unknown
                                                 : SpectralQuantity::power;
    }

    void read_cxf(const pugi::xml_node &object, const pugi::xml_node &spectrum) {
        const std::map<std::string, SpectralQuantity> kinds{
            {"EmissiveSpectrum", SpectralQuantity::power},
            {"ReflectanceSpectrum", SpectralQuantity::reflectance},
            {"TransmittanceSpectrum", SpectralQuantity::transmittance}};
        const auto kind = kinds.find(local_name(spectrum));
        if (kind == kinds.end())
            return;
        const std::string named = object.attribute("Name").value();
        SpectrumSample sample{.name = named.empty() ? object.attribute("Id").value() : named,
                              .quantity = kind->second};
        const auto start = number(spectrum, wavelengths(spectrum, "StartWL"));
        const auto step = number(spectrum, wavelengths(spectrum, "Increment"));
        if (!start || !step)
            return;
        std::size_t index = 0;
        for (const detail::DelimitedField &field :
             detail::split_fields(one_line(spectrum.text().get()), ' ')) {
            add(sample, spectrum, number_text(*start + *step * static_cast<double>(index)),
                field.text);
            ++index;
        }
        keep(std::move(sample));
    }

    static std::string one_line(std::string text) {
        std::ranges::replace_if(
            text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
        return text;
    }

    /// An attribute of the spectrum, or of the range of its colour specification.
    std::string wavelengths(const pugi::xml_node &spectrum, const char *attribute) const {
        if (const std::string own = spectrum.attribute(attribute).value(); !own.empty())
            return own;
        const auto found = specifications_.find(spectrum.attribute("ColorSpecification").value());
        if (found == specifications_.end())
            return {};
        const pugi::xml_node range = found->second.find_node(
            [](const pugi::xml_node &node) { return local_name(node) == "WavelengthRange"; });
        return range.attribute(attribute).value();
    }

    void add(SpectrumSample &sample, const pugi::xml_node &node, const std::string &wavelength,
             const std::string &value) {
        const auto nm = number(node, wavelength), v = number(node, value);
        if (!nm || !v)
            return;
        sample.spectrum.wavelength_nm.push_back(*nm);
        sample.spectrum.value.push_back(*v);
        sample.where.push_back(place(node.offset_debug()));
    }

    std::optional<double> number(const pugi::xml_node &node, const std::string &text) {
        const std::string content(detail::without_blanks(text));
        const auto value = DecimalReader().read(content);
        if (!value)
            problems_.add({"<" + std::string(node.name()) + ">: '" + content + "' is not a number",
                           place(node.offset_debug()),
                           "expected a finite number such as 560 or 0.25"});
        return value;
    }

    void keep(SpectrumSample sample) {
        if (!sample.spectrum.value.empty())
            file_.samples.push_back(std::move(sample));
    }

    SpectrumFile finish(const std::string &element) {
        if (problems_.empty() && file_.samples.empty())
            problems_.add({"the file holds no spectrum", name_, "expected an element " + element});
        problems_.throw_if_any();
        return std::move(file_);
    }

    std::string place(std::ptrdiff_t offset) const {
        if (offset < 0)
            return name_;
        const std::string_view before =
            std::string_view(text_).substr(0, static_cast<std::size_t>(offset));
        return name_ + ':' + std::to_string(std::ranges::count(before, '\n') + 1);
    }

    std::string name_, text_;
    pugi::xml_document document_{};
    std::map<std::string, pugi::xml_node> specifications_{};
    SpectrumFile file_{};
    Problems problems_{};
};

} // namespace

SpectrumFile parse_tm27(std::string_view bytes, const std::string &name) {
    return XmlSpectra(bytes, name).tm27();
}

SpectrumFile parse_cxf(std::string_view bytes, const std::string &name) {
    return XmlSpectra(bytes, name).cxf();
}

} // namespace tsuya
