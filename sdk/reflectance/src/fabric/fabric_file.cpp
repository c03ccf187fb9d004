// The file F.fabric.toml.

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/fabric_fields.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"
#include "tsuya/sdk/reflectance_file.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

using detail::Field;

constexpr const char *kSchema = "tsuya-fabric 1";

Spectrum read_spectrum(const Section &section, const Field &field, const Spectrum &otherwise) {
    const auto inner = section.section(field.key);
    if (!inner)
        return otherwise;
    if (inner->has("constant"))
        return Spectrum::constant(
            inner->number("constant", field.low, field.high).value_or(field.low));
    const auto wavelength_nm = inner->numbers("wavelength_nm"), value = inner->numbers("value");
    if (!inner->has("wavelength_nm") || !inner->has("value"))
        inner->problem("", "the spectrum is not complete",
                       "expected constant, or wavelength_nm and value");
    if (!wavelength_nm || !value)
        return otherwise;
    Spectrum spectrum{*wavelength_nm, *value};
    try {
        check_spectrum(spectrum, field.low, field.high, "");
    } catch (const Error &error) {
        inner->problem("", error);
    }
    return spectrum;
}

// Reads the fields of a struct from the section that has their keys.
struct FieldReader {
    const Section &section;

    void operator()(const Field &field, double &value) const {
        value = field.required ? section.required_number(field.key, field.low, field.high)
                               : section.number(field.key, field.low, field.high).value_or(value);
    }
    void operator()(const Field &field, std::optional<double> &value) const {
        value = section.number(field.key, field.low, field.high);
    }
    void operator()(const Field &field, std::string &value) const {
        value = field.required ? section.required_text(field.key)
                               : section.text(field.key).value_or(value);
    }
    void operator()(const Field &field, std::map<std::string, std::string> &texts) const {
        if (const auto inner = section.section(field.key))
            for (auto &[key, value] : inner->all_texts())
                texts[key] = value;
    }
    void operator()(const Field &field, Spectrum &spectrum) const {
        spectrum = read_spectrum(section, field, spectrum);
    }
    void operator()(const Field &field, std::optional<Spectrum> &spectrum) const {
        if (section.has(field.key))
            spectrum = read_spectrum(section, field, Spectrum::constant(1));
    }
    void operator()(const Field &field, Lustre &lustre) const {
        if (const auto name = section.text(field.key))
            try {
                lustre = lustre_named(*name, "");
            } catch (const Error &error) {
                section.problem(field.key, error);
            }
    }
    template <std::size_t N>
    void operator()(const Field &field, std::array<double, N> &values) const {
        const auto read = section.numbers(field.key).value_or(std::vector<double>{});
        if (read.size() == N && std::all_of(read.begin(), read.end(), [&](double v) {
                return v >= field.low && v <= field.high;
            }))
            std::copy(read.begin(), read.end(), values.begin());
        else
            section.problem(field.key,
                            "these " + std::to_string(read.size()) +
                                " numbers are no surfaces at the slopes of yarns",
                            "expected " + std::to_string(N) +
                                " not below 0, for every 2 degrees from -48 to 48");
    }
    void operator()(const Field &, FabricColours &colours) const { each_field(*this, colours); }
    void operator()(const Field &field, std::int64_t &value) const {
        value =
            section.integer(field.key, static_cast<int>(field.low), static_cast<int>(field.high))
                .value_or(static_cast<int>(value));
    }
    void operator()(const Field &field, Irregularity &irregularity) const {
        const auto inner = section.section(field.key);
        if (!inner)
            return;
        each_field(FieldReader{*inner}, irregularity);
        const double length = irregularity.slub_length, per_m = irregularity.slubs_per_m;
        if (!(per_m > 0) || length <= 1 / per_m)
            return;
        std::ostringstream text;
        text.imbue(std::locale::classic());
        text << "slubs of " << length << " m do not fit " << per_m << " times in a metre";
        inner->problem(inner->has("slub_length_m") ? "slub_length_m" : "slubs_per_m", text.str(),
                       "expected slub_length_m up to 1 / slubs_per_m");
    }
    void operator()(const Field &field, std::optional<ClothWeave> &weave) const {
        const auto inner = section.section(field.key);
        if (!inner) {
            if (section.has("irregularity"))
                section.problem("irregularity", "[irregularity] stands without [weave]",
                                "expected [weave], or no such section");
            return;
        }
        weave.emplace();
        weave->preset = inner->text("preset").value_or("");
        weave->file = inner->text("file").value_or("");
        if (weave->preset.empty() == weave->file.empty())
            inner->problem("", weave->file.empty() ? "no weave is named" : "two weaves are named",
                           "expected preset or file");
        (*this)({.key = "irregularity"}, weave->irregularity);
    }
    // Read by SpecularReader: what they are depends on each other
    void operator()(const Field &, Specular &) const {}
    void operator()(const Field &, std::vector<Specular> &) const {}
};

// The struct in a section of its own; empty where the file has none.
template <class T> std::optional<T> read_section(const Section &root, const char *key) {
    const auto section = root.section(key);
    if (!section)
        return std::nullopt;
    T read;
    each_field(FieldReader{*section}, read);
    return read;
}

Symmetry read_symmetry(const Section &root) {
    if (!root.has("views") && !root.has("symmetry"))
        return Symmetry::orthotropic;
    const std::string name = root.required_text("symmetry");
    if (const auto symmetry = symmetry_named(name))
        return *symmetry;
    root.problem("symmetry", "unknown symmetry '" + name + "'",
                 accepted_names(name, symmetry_names()));
    return Symmetry::orthotropic;
}

std::optional<ReflectanceTable> read_views(const Section &root, Symmetry symmetry) {
    const auto views = root.section("views");
    if (!views)
        return std::nullopt;
    const auto theta = views->numbers("theta_deg").value_or(std::vector<double>{});
    const auto phi = views->numbers("phi_deg").value_or(std::vector<double>{});
    const auto brdf = views->numbers("brdf_per_sr").value_or(std::vector<double>{});
    auto sigma = views->numbers("sigma_per_sr").value_or(std::vector<double>(brdf.size()));
    if (theta.size() != brdf.size() || phi.size() != brdf.size() || sigma.size() != brdf.size()) {
        views->problem("brdf_per_sr", "the arrays of the views differ in length",
                       "expected theta_deg, phi_deg and brdf_per_sr of one length");
        return std::nullopt;
    }
    ReflectanceTable table{.symmetry = symmetry};
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        if (!(theta[i] >= 0 && theta[i] <= 90 && brdf[i] >= 0 && sigma[i] >= 0)) {
            views->problem("brdf_per_sr", "view " + std::to_string(i) + " is out of range",
                           "expected theta_deg of 0 to 90 and values not below 0");
            return std::nullopt;
        }
        table.rows.push_back({0, 0, theta[i] * kDegree, phi[i] * kDegree, brdf[i], sigma[i]});
    }
    return table;
}

// Everything that a file says of the specular part.
class SpecularReader {
  public:
    SpecularReader(const Section &root, const std::filesystem::path &file)
        : file_(file), model_(root.text("model")), model_place_(root.where("model")),
          views_(read_views(root, read_symmetry(root))), f0_(root.number("f0", 1e-6, 1)),
          smoothness_(read_section<BardSmoothness>(root, "smoothness")),
          yarn_(read_section<YarnLobes>(root, "yarn")), ggx_(read_section<GgxFacets>(root, "ggx")) {
        if (f0_ && !views_)
            root.problem("f0", "f0 stands without [views]",
                         "expected [views], whose model looks at it, or f0 in [yarn] or [ggx]");
        if (model_)
            try {
                check_model_name(*model_, "");
            } catch (const Error &error) {
                root.problem("model", error);
            }
        if (const auto section = root.section("ggx");
            section && section->has("f0") && section->has("refractive_index"))
            section->problem("refractive_index", "both f0 and refractive_index are given",
                             "expected one of them");
        if (const auto table = root.text("table"))
            table_ = {read_reflectance_table(file.parent_path() / *table), *table};
        check_company(root);
    }

    // Fits the views, and makes what the model is made of the specular part.
    Fabric finish(Fabric fabric, const Progress &progress) const {
        if (views_) {
            const std::string where = file_.string() + ": views";
            fabric.spare.push_back(
                CarriedViews{.bard = smoothness_ ? Bard::fit(*views_, *smoothness_, where, progress)
                                                 : Bard::fit(*views_, where, progress),
                             .f0 = f0_});
        }
        if (yarn_)
            fabric.spare.push_back(*yarn_);
        if (ggx_)
            fabric.spare.push_back(*ggx_);
        if (table_)
            fabric.spare.push_back(*table_);
        if (!model_ && !views_ && !yarn_)
            return fabric; // nothing that the default is made of: no specular part
        try {
            return with_model(std::move(fabric), model_.value_or(kDefaultModel), "");
        } catch (const Error &error) {
            throw error.at(model_place_);
        }
    }

  private:
    // What would say nothing.
    void check_company(const Section &root) const {
        if (!root.has("views"))
            for (const char *const key : {"symmetry", "smoothness"})
                if (root.has(key))
                    root.problem(key, std::string(key) + " stands without [views]",
                                 "expected [views], or no such key");
        if (model_ || root.has("views") || root.has("yarn"))
            return;
        for (const char *const key : {"ggx", "table"})
            if (root.has(key))
                root.problem(key, "no model is named that is made of '" + std::string(key) + "'",
                             key == std::string("ggx") ? "expected model = \"ggx\""
                                                       : "expected model = \"tabulated\"");
    }

    std::filesystem::path file_;
    std::optional<std::string> model_;
    std::string model_place_;
    std::optional<ReflectanceTable> views_;
    std::optional<double> f0_;
    std::optional<BardSmoothness> smoothness_;
    std::optional<YarnLobes> yarn_;
    std::optional<GgxFacets> ggx_;
    std::optional<TabulatedSpecular> table_{};
};

void write_numbers(std::ostream &out, std::string_view key, const std::vector<double> &values) {
    out << key << " = [";
    for (std::size_t i = 0; i < values.size(); ++i)
        out << (i == 0 ? "" : i % 12 == 0 ? ",\n    " : ", ") << values[i];
    out << "]\n";
}

// A TOML basic string. Bytes that are not UTF-8 are written as decode_text shows them.
std::string toml_string(const std::string &text) {
    std::ostringstream out;
    out << '"' << std::hex << std::setfill('0');
    for (const char c : decode_text(text, "")) {
        const int code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7f)
            out << "\\u" << std::setw(4) << code;
        else
            out << (c == '"' || c == '\\' ? "\\" : "") << c;
    }
    out << '"';
    return out.str();
}

// Writes the fields of a struct as the lines of a section.
struct FieldWriter {
    std::ostream &out;

    void operator()(const Field &field, double value) const {
        if (field.written)
            out << field.key << " = " << value << "\n";
    }
    void operator()(const Field &field, const std::optional<double> &value) const {
        if (value)
            (*this)(field, *value);
    }
    template <std::size_t N>
    void operator()(const Field &field, const std::array<double, N> &values) const {
        write_numbers(out, field.key, {values.begin(), values.end()});
    }
    void operator()(const Field &field, const std::vector<double> &values) const {
        write_numbers(out, field.key, values);
    }
    void operator()(const Field &field, std::int64_t value) const {
        if (field.written)
            out << field.key << " = " << value << "\n";
    }
    void operator()(const Field &field, const std::string &value) const {
        if (field.written)
            out << field.key << " = " << toml_string(value) << "\n";
    }
    void operator()(const Field &field, const Irregularity &irregularity) const {
        if (irregularity != Irregularity{}) {
            out << "\n[" << field.key << "]\n";
            each_field(*this, irregularity);
        }
    }
    void operator()(const Field &, const WeaveMap &) const {} // made by who reads
};

template <class T> void write_section(std::ostream &out, std::string_view key, const T &fields) {
    out << "\n[" << key << "]\n";
    each_field(FieldWriter{out}, fields);
}

// Keys of the root have to stand before all sections; the views stand last, being long.
class FabricWriter {
  public:
    FabricWriter() {
        for (std::ostringstream *const out : {&keys_, &sections_, &specular_}) {
            out->imbue(std::locale::classic()); // a decimal point in every country
            out->precision(6);
        }
        keys_ << "schema = " << toml_string(kSchema) << "\n";
    }
    std::string text() const { return keys_.str() + sections_.str() + specular_.str(); }

    void operator()(const Field &field, const std::string &text) {
        keys_ << field.key << " = " << toml_string(text) << "\n";
    }
    void operator()(const Field &field, const std::map<std::string, std::string> &texts) {
        if (texts.empty())
            return;
        sections_ << "\n[" << field.key << "]\n";
        for (const auto &[key, value] : texts)
            sections_ << toml_string(key) << " = " << toml_string(value) << "\n";
    }
    void operator()(const Field &field, const Spectrum &spectrum) {
        if (!field.written)
            return;
        if (!spectrum.is_constant())
            return write_section(sections_, field.key, spectrum);
        sections_ << "\n[" << field.key << "]\nconstant = " << spectrum.value[0] << "\n";
    }
    void operator()(const Field &field, const std::optional<Spectrum> &spectrum) {
        if (spectrum)
            (*this)(field, *spectrum);
    }
    void operator()(const Field &field, Lustre lustre) {
        if (field.written)
            keys_ << field.key << " = "
                  << toml_string(std::string(kLustreNames[static_cast<std::size_t>(lustre)]))
                  << "\n";
    }
    void operator()(const Field &field, const std::optional<double> &value) {
        if (value)
            keys_ << field.key << " = " << *value << "\n";
    }
    void operator()(const Field &, const FabricColours &colours) { each_field(*this, colours); }
    void operator()(const Field &field, const std::optional<ClothWeave> &weave) {
        if (weave)
            write_section(sections_, field.key, *weave);
    }
    void operator()(const Field &, const Specular &) {} // see write_specular
    void operator()(const Field &, const std::vector<Specular> &) {}

    // All that is known of the specular part, and which of it is the model.
    void write_specular(const Fabric &fabric) {
        const auto *const carried = find_specular<CarriedViews>(fabric);
        const auto *const table = find_specular<TabulatedSpecular>(fabric);
        if (carried)
            keys_ << "symmetry = " << toml_string(name_of(carried->bard.symmetry())) << "\n";
        if (const std::string model(model_of(fabric)); model != kDefaultModel)
            keys_ << "model = " << toml_string(model) << "\n";
        if (carried && carried->f0)
            keys_ << "f0 = " << *carried->f0 << "\n";
        if (table)
            keys_ << "table = " << toml_string(table->file) << "\n";
        if (const auto *const facets = find_specular<GgxFacets>(fabric))
            write_section(specular_, "ggx", *facets);
        if (const auto *const lobes = find_specular<YarnLobes>(fabric))
            write_section(specular_, "yarn", *lobes);
        if (carried)
            write_views(carried->bard);
    }

  private:
    void write_views(const Bard &bard) {
        write_section(specular_, "smoothness", bard.smoothness());
        std::vector<double> theta, phi, brdf, sigma;
        bool any_sigma = false;
        for (const BardView &v : bard.views()) {
            theta.push_back(v.theta / kDegree);
            phi.push_back(v.phi / kDegree);
            brdf.push_back(v.brdf_per_sr);
            sigma.push_back(v.sigma_per_sr);
            any_sigma |= v.sigma_per_sr > 0;
        }
        specular_ << "\n[views]\n";
        write_numbers(specular_, "theta_deg", theta);
        write_numbers(specular_, "phi_deg", phi);
        write_numbers(specular_, "brdf_per_sr", brdf);
        if (any_sigma)
            write_numbers(specular_, "sigma_per_sr", sigma);
    }

    std::ostringstream keys_, sections_, specular_;
};

} // namespace

Fabric read_fabric(const std::filesystem::path &file, const Progress &progress) {
    const Document document(file);
    const Section root = document.root();
    if (const std::string schema = root.required_text("schema"); schema != kSchema)
        root.problem("schema", "the schema is '" + schema + "'",
                     std::string("expected \"") + kSchema + "\"");
    Fabric fabric;
    each_field(FieldReader{root}, fabric);
    const SpecularReader specular(root, file);
    document.finish();
    return specular.finish(std::move(fabric), progress);
}

void write_fabric(const Fabric &fabric, const std::filesystem::path &file) {
    FabricWriter writer;
    each_field(writer, fabric);
    writer.write_specular(fabric);
    write_file(file, writer.text());
}

} // namespace tsuya
