#include "tsuya/sdk/fabric.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/document.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/model.h"

namespace tsuya {
namespace {

constexpr const char *kSchema = "tsuya-fabric 1";

Spectrum read_spectrum(const Section &section, const char *key, double otherwise) {
    Spectrum spectrum = Spectrum::constant(otherwise);
    const auto inner = section.section(key);
    if (!inner)
        return spectrum;
    if (const auto constant = inner->number("constant", 0, 1))
        return Spectrum::constant(*constant);
    spectrum.wavelength_nm = inner->numbers("wavelength_nm").value_or(std::vector<double>{560});
    spectrum.value = inner->numbers("value").value_or(std::vector<double>{otherwise});
    try {
        check_spectrum(spectrum, 0, 1, inner->where());
    } catch (const Error &error) {
        inner->problem("", error.problems()[0].what, error.problems()[0].accepted);
    }
    return spectrum;
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

Symmetry read_symmetry(const Section &root) {
    if (!root.has("views") && !root.has("symmetry"))
        return Symmetry::orthotropic;
    const std::string name = root.required_text("symmetry");
    const std::vector<std::string> known = {"orthotropic", "half-turn", "none"};
    for (const Symmetry s : {Symmetry::none, Symmetry::half_turn, Symmetry::orthotropic})
        if (name == name_of(s))
            return s;
    root.problem("symmetry", "unknown symmetry '" + name + "'", accepted_names(name, known));
    return Symmetry::orthotropic;
}

void write_numbers(std::ostream &out, const char *key, const std::vector<double> &values) {
    out << key << " = [";
    for (std::size_t i = 0; i < values.size(); ++i)
        out << (i == 0 ? "" : i % 12 == 0 ? ",\n    " : ", ") << values[i];
    out << "]\n";
}

void write_spectrum(std::ostream &out, const char *key, const Spectrum &spectrum) {
    out << "\n[" << key << "]\n";
    if (spectrum.is_constant()) {
        out << "constant = " << spectrum.value[0] << "\n";
        return;
    }
    write_numbers(out, "wavelength_nm", spectrum.wavelength_nm);
    write_numbers(out, "value", spectrum.value);
}

void write_yarn(std::ostream &out, const YarnLobes &lobes) {
    out << "\n[yarn]\nf0 = " << lobes.f0 << "\nroughness = " << lobes.roughness
        << "\neven = " << lobes.even << "\npit_weft = " << lobes.pit[0]
        << "\npit_warp = " << lobes.pit[1] << "\n";
    const auto all = [](const auto &surface) {
        return std::vector<double>(surface.begin(), surface.end());
    };
    write_numbers(out, "surface_weft", all(lobes.surface[0]));
    write_numbers(out, "surface_warp", all(lobes.surface[1]));
}

// A TOML basic string.
std::string quoted(const std::string &text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + '"';
}

// What is scattered to both sides is no more than arrives.
void check_diffuse(const Fabric &fabric, const std::string &where) {
    std::vector<double> wavelengths = fabric.dye.wavelength_nm;
    wavelengths.insert(wavelengths.end(), fabric.transmittance.wavelength_nm.begin(),
                       fabric.transmittance.wavelength_nm.end());
    for (const double nm : wavelengths)
        if (const double sum = fabric.dye.at(nm) + fabric.transmittance.at(nm); sum > 1 + 1e-9)
            throw Error({"dye and transmittance are " + std::to_string(sum) + " together at " +
                             std::to_string(nm) + " nm",
                         where + ".transmittance", "expected at most 1"});
}

std::optional<YarnLobes> read_yarn(const Section &root) {
    const auto section = root.section("yarn");
    if (!section)
        return std::nullopt;
    YarnLobes lobes;
    lobes.f0 = section->required_number("f0", 1e-6, 1);
    lobes.roughness = section->required_number("roughness", 0.005, 1);
    lobes.even = section->required_number("even", 0, 1);
    lobes.pit = {section->required_number("pit_weft", 0, 10),
                 section->required_number("pit_warp", 0, 10)};
    for (const std::size_t axis : {0u, 1u}) {
        const char *const key = axis == 0 ? "surface_weft" : "surface_warp";
        const auto surface = section->numbers(key).value_or(std::vector<double>{});
        if (surface.size() != kYarnSlopes ||
            !std::all_of(surface.begin(), surface.end(),
                         [](double s) { return s >= 0 && std::isfinite(s); }))
            section->problem(key,
                             "these " + std::to_string(surface.size()) +
                                 " numbers are no surfaces at the slopes of yarns",
                             "expected " + std::to_string(kYarnSlopes) +
                                 " not below 0, for every 2 degrees from -48 to 48");
        else
            std::copy(surface.begin(), surface.end(), lobes.surface[axis].begin());
    }
    return lobes;
}

// The model, and what it is made of but the views.
void read_model(const Section &root, const std::filesystem::path &file, Fabric &fabric) {
    if (const auto model = root.text("model")) {
        fabric.model = *model;
        try {
            check_model_name(*model, root.where("model"));
        } catch (const Error &error) {
            root.problem("model", error.problems()[0].what, error.problems()[0].accepted);
        }
    }
    if (const auto section = root.section("ggx")) {
        GgxFacets facets;
        facets.alpha_weft = section->required_number("alpha_weft", 1e-4, 1);
        facets.alpha_warp = section->required_number("alpha_warp", 1e-4, 1);
        facets.f0 = section->number("f0", 1e-6, 1).value_or(facets.f0);
        facets.refractive_index = section->number("refractive_index", 1.001, 10);
        if (section->has("f0") && facets.refractive_index)
            section->problem("refractive_index", "both f0 and refractive_index are given",
                             "expected one of them");
        fabric.ggx = facets;
    }
    fabric.yarn = read_yarn(root);
    if (const auto table = root.text("table")) {
        fabric.table_file = *table;
        fabric.table = read_reflectance_table(file.parent_path() / *table);
    }
}

} // namespace

bool Material::has_diffuse() const {
    return dye.any_above_zero() || transmittance.any_above_zero();
}

bool Material::has_specular() const {
    return specular && (weft_tint.any_above_zero() || warp_tint.any_above_zero());
}

double f0_of(const Fabric &fabric, const std::string &where) {
    const double basic = fabric.bard ? fabric.bard->at({0, 0, 1}) : 0.0;
    const double f0 = fabric.f0.value_or(std::min(1.0, basic));
    if (!(f0 > 0 && f0 <= 1))
        throw Error({"f0 is " + std::to_string(f0), where + ".f0",
                     "expected a reflectance above 0 and not above 1"});
    return f0;
}

Material resolve(const Fabric &fabric, const std::string &where) {
    Material material{.weft_tint = fabric.weft_tint.value_or(fabric.specular_tint),
                      .warp_tint = fabric.warp_tint.value_or(fabric.specular_tint),
                      .dye = fabric.dye,
                      .transmittance = fabric.transmittance};
    check_spectrum(fabric.specular_tint, 0, 1, where + ".specular_tint");
    check_spectrum(material.weft_tint, 0, 1, where + ".weft_tint");
    check_spectrum(material.warp_tint, 0, 1, where + ".warp_tint");
    check_spectrum(fabric.dye, 0, 1, where + ".dye");
    check_spectrum(fabric.transmittance, 0, 1, where + ".transmittance");
    check_diffuse(fabric, where);
    check_model_name(fabric.model, where + ".model");
    if ((fabric.weft_tint || fabric.warp_tint) && fabric.model != "yarn")
        throw Error({"the model '" + fabric.model + "' does not tell weft and warp apart",
                     where + (fabric.weft_tint ? ".weft_tint" : ".warp_tint"),
                     "expected specular_tint, or the model 'yarn'"});
    if (has_data_of(fabric.model, fabric))
        material.specular = make_brdf(fabric.model, fabric, where);
    return material;
}

Fabric read_fabric(const std::filesystem::path &file) {
    const Document document(file);
    const Section root = document.root();
    if (const std::string schema = root.required_text("schema"); schema != kSchema)
        root.problem("schema", "the schema is '" + schema + "'",
                     std::string("expected \"") + kSchema + "\"");
    Fabric fabric{.name = root.required_text("name")};
    fabric.f0 = root.number("f0", 1e-6, 1);
    fabric.dye = read_spectrum(root, "dye", 0);
    fabric.transmittance = read_spectrum(root, "transmittance", 0);
    fabric.specular_tint = read_spectrum(root, "specular_tint", 1);
    if (root.has("weft_tint"))
        fabric.weft_tint = read_spectrum(root, "weft_tint", 1);
    if (root.has("warp_tint"))
        fabric.warp_tint = read_spectrum(root, "warp_tint", 1);
    if (const auto keys = root.section("provenance"))
        for (auto &[key, value] : keys->all_texts())
            fabric.keys[key] = value;
    read_model(root, file, fabric);
    const auto table = read_views(root, read_symmetry(root));
    std::optional<BardSmoothness> smoothness;
    if (const auto section = root.section("smoothness"))
        smoothness = {.weft_support = section->required_number("weft_support", 0.01, 100),
                      .warp_support = section->required_number("warp_support", 0.01, 100),
                      .noise_share = section->required_number("noise_share", 1e-12, 1)};
    document.finish();
    if (table) {
        const std::string where = file.string() + ": views";
        fabric.bard = smoothness ? Bard::fit(*table, *smoothness, where) : Bard::fit(*table, where);
    }
    return fabric;
}

void write_fabric(const Fabric &fabric, const std::filesystem::path &file) {
    std::ostringstream out;
    out.imbue(std::locale::classic()); // a decimal point in every country
    out.precision(6);
    out << "schema = \"" << kSchema << "\"\nname = " << quoted(fabric.name) << "\n";
    if (fabric.bard)
        out << "symmetry = \"" << name_of(fabric.bard->symmetry()) << "\"\n";
    if (fabric.model != Fabric{}.model)
        out << "model = " << quoted(fabric.model) << "\n";
    if (fabric.f0)
        out << "f0 = " << *fabric.f0 << "\n";
    if (!fabric.table_file.empty())
        out << "table = " << quoted(fabric.table_file) << "\n";
    if (!fabric.keys.empty())
        out << "\n[provenance]\n";
    for (const auto &[key, value] : fabric.keys)
        out << quoted(key) << " = " << quoted(value) << "\n";
    write_spectrum(out, "dye", fabric.dye);
    if (fabric.transmittance.any_above_zero())
        write_spectrum(out, "transmittance", fabric.transmittance);
    write_spectrum(out, "specular_tint", fabric.specular_tint);
    if (fabric.weft_tint)
        write_spectrum(out, "weft_tint", *fabric.weft_tint);
    if (fabric.warp_tint)
        write_spectrum(out, "warp_tint", *fabric.warp_tint);
    if (fabric.ggx) {
        out << "\n[ggx]\nalpha_weft = " << fabric.ggx->alpha_weft
            << "\nalpha_warp = " << fabric.ggx->alpha_warp;
        if (fabric.ggx->refractive_index)
            out << "\nrefractive_index = " << *fabric.ggx->refractive_index << "\n";
        else
            out << "\nf0 = " << fabric.ggx->f0 << "\n";
    }
    if (fabric.yarn)
        write_yarn(out, *fabric.yarn);
    if (fabric.bard) {
        const BardSmoothness &s = fabric.bard->smoothness();
        out << "\n[smoothness]\nweft_support = " << s.weft_support
            << "\nwarp_support = " << s.warp_support << "\nnoise_share = " << s.noise_share
            << "\n\n[views]\n";
        std::vector<double> theta, phi, brdf, sigma;
        bool any_sigma = false;
        for (const BardView &v : fabric.bard->views()) {
            theta.push_back(v.theta / kDegree);
            phi.push_back(v.phi / kDegree);
            brdf.push_back(v.brdf_per_sr);
            sigma.push_back(v.sigma_per_sr);
            any_sigma |= v.sigma_per_sr > 0;
        }
        write_numbers(out, "theta_deg", theta);
        write_numbers(out, "phi_deg", phi);
        write_numbers(out, "brdf_per_sr", brdf);
        if (any_sigma)
            write_numbers(out, "sigma_per_sr", sigma);
    }
    write_file(file, out.str());
}

} // namespace tsuya
