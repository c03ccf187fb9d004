// From a fabric to what the renderer shades with.

#include <algorithm>
#include <cmath>
#include <set>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/model.h"
#include "tsuya/sdk/near_yarn.h"

namespace tsuya {
namespace {

// function(a, b) at the wavelengths of both.
template <class Function>
Spectrum combined(const Spectrum &a, const Spectrum &b, const Function &function) {
    std::set<double> wavelengths(a.wavelength_nm.begin(), a.wavelength_nm.end());
    wavelengths.insert(b.wavelength_nm.begin(), b.wavelength_nm.end());
    Spectrum made{{wavelengths.begin(), wavelengths.end()}, {}};
    for (const double nm : wavelengths)
        made.value.push_back(function(a.at(nm), b.at(nm)));
    return made;
}

// The same of one spectrum.
template <class Function> Spectrum mapped(Spectrum spectrum, const Function &function) {
    for (double &value : spectrum.value)
        value = function(value);
    return spectrum;
}

// Of a surface that reflects all: what the coloured part is divided by stays above 0.
constexpr double kLeastPassed = 1e-3;

// The mean of an albedo at 8 degrees from the normal, where the port of a spectrophotometer is.
template <class Albedo> double at_port(const Albedo &albedo) {
    const float sine = static_cast<float>(std::sin(8 * kDegree));
    const float cosine = static_cast<float>(std::cos(8 * kDegree));
    return 0.5 * (static_cast<double>(albedo(glm::vec3(sine, 0, cosine))) +
                  static_cast<double>(albedo(glm::vec3(0, sine, cosine))));
}

// The coloured part by what a spectrophotometer sees of it: `even` and `body` of the light at the
// port are what a Lambertian part and a body without absorption would send back.
struct Port {
    const FabricColours &colours;
    double even = 1, body = 1;
    bool has_body = false;

    double most() const { return has_body ? std::min(even, body) : even; }
    // Share of a reflectance that is Lambertian
    double delustre(double reflectance) const {
        return has_body ? colours.delustre.value_or(delustre_of(colours.lustre, reflectance)) : 1;
    }
    double even_albedo(double dye) const {
        const double r = std::min(dye, most());
        return r * delustre(r) / even;
    }
    double body_albedo(double dye) const {
        const double r = std::min(dye, most());
        return r * (1 - delustre(r)) / body;
    }
    // Of what the surface lets through, and no more than the dye leaves of it
    double transmitted(double transmittance, double dye) const {
        return std::min(transmittance, most() - std::min(dye, most())) / even;
    }
};

// Adds the coloured part and what the cloth lets through.
// \param tables of the specular part
void add_colours(const Fabric &fabric, Material &material, ModelTables &tables,
                 const Progress &progress) {
    const FabricColours &colours = fabric.colours;
    // Of light, for viewers too: so the renderer scales the Lambertian part
    const auto surface = [&](const glm::vec3 &d) {
        return material.has_specular() ? std::min(material.specular->albedo_of_light(d), 1.0f)
                                       : 0.0f;
    };
    const auto *const yarns = material.specular ? material.specular->get_if<YarnBrdf>() : nullptr;
    Port port{.colours = colours, .even = std::max(1 - at_port(surface), kLeastPassed)};
    if (yarns && yarns->lobes().filaments(0) + yarns->lobes().filaments(1) > 0 &&
        has_body(fabric)) {
        std::shared_ptr<const BodyBrdf> &body =
            material.has_specular() ? tables.body : tables.bare_body;
        if (!body)
            body = std::make_shared<const BodyBrdf>(yarns->lobes(), surface, progress);
        material.body = body;
        port.has_body = true;
        port.body = std::max(at_port([&](const glm::vec3 &d) { return material.body->albedo(d); }),
                             kLeastPassed);
    }
    const Spectrum &weft = colours.dye_of_weft(), &warp = colours.dye_of_warp();
    const double share = yarns ? yarns->lobes().weft_share() : 0.5;
    material.weft_share = share;
    material.most_dye = port.most();
    material.dye = combined(weft, warp, [&](double a, double b) {
        return share * port.even_albedo(a) + (1 - share) * port.even_albedo(b);
    });
    material.transmittance =
        combined(colours.transmittance,
                 combined(weft, warp, [](double a, double b) { return std::max(a, b); }),
                 [&](double t, double dye) { return port.transmitted(t, dye); });
    constexpr int kDyeSteps = 128;
    for (int i = 0; i <= kDyeSteps; ++i) {
        const double dye = static_cast<double>(i) / kDyeSteps;
        material.of_dye.emplace_back(port.even_albedo(dye),
                                     material.body ? port.body_albedo(dye) : 0.0);
    }
    if (!material.body)
        return;
    material.weft_body = mapped(weft, [&](double r) { return port.body_albedo(r); });
    material.warp_body = mapped(warp, [&](double r) { return port.body_albedo(r); });
}

} // namespace

bool Material::has_diffuse() const {
    return dye.any_above_zero() || transmittance.any_above_zero();
}

bool Material::has_specular() const {
    return specular && (weft_tint.any_above_zero() || warp_tint.any_above_zero());
}

Material resolve(const Fabric &fabric, const std::string &where, const Progress &progress) {
    ModelTables tables;
    return resolve(fabric, where, tables, progress);
}

Material resolve(const Fabric &fabric, const std::string &where, ModelTables &tables,
                 const Progress &progress) {
    check_fabric(fabric, where);
    if (!tables.specular)
        if (std::optional<Brdf> made = make_brdf(fabric, where, progress))
            tables.specular = std::make_shared<const Brdf>(std::move(*made));
    Material material{.specular = tables.specular,
                      .weft_tint = fabric.colours.weft(),
                      .warp_tint = fabric.colours.warp()};
    add_colours(fabric, material, tables, progress);
    const auto *const yarns = material.specular ? material.specular->get_if<YarnBrdf>() : nullptr;
    if (yarns && fabric.weave && fabric.weave->has_map())
        material.near =
            std::make_shared<const NearYarn>(yarns->lobes(), body_roughness(yarns->lobes()),
                                             fabric.weave->map, fabric.weave->irregularity);
    return material;
}

std::vector<Problem> weave_warnings(const Material &material, const std::string &where) {
    constexpr double kMost = 1.2, kFullCover = kPi / 2;
    std::vector<Problem> warnings;
    for (std::size_t axis = 0; material.near && axis < 2; ++axis)
        if (const double covers = material.near->crowding(axis) / kFullCover; covers > kMost)
            warnings.push_back(
                {std::string("the weave shows ") + (axis == 0 ? "weft" : "warp") +
                     " where its filaments would have to lie " +
                     std::to_string(covers).substr(0, 4) + " deep to reflect what was fitted",
                 where + ".weave", "expected the weave of the cloth that was measured"});
    return warnings;
}

float mean_passed(const Brdf &brdf) {
    constexpr int kSteps = 32; // midpoint rule
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const float sine2 = (static_cast<float>(i) + 0.5f) / kSteps;
            const float phi = 2 * kPiF * (static_cast<float>(j) + 0.5f) / kSteps;
            const float s = std::sqrt(sine2);
            sum += std::min(1.0f, brdf.albedo_of_light({s * std::cos(phi), s * std::sin(phi),
                                                        std::sqrt(1 - sine2)}));
        }
    return static_cast<float>(std::max(1 - sum / (kSteps * kSteps), kLeastPassed));
}

// The Lambertian part lies below the surface as in [Kelemen].
BrdfFunction coloured_part(const Material &material, double wavelength_nm) {
    const bool covered = material.has_specular();
    const double passed = covered ? mean_passed(*material.specular) : 1;
    return [=, dye = material.dye.at(wavelength_nm), weft = material.weft_body.at(wavelength_nm),
            warp = material.warp_body.at(wavelength_nm)](const glm::dvec3 &l, const glm::dvec3 &v) {
        const glm::vec3 light(l), viewer(v);
        if (!(light.z > 0 && viewer.z > 0))
            return 0.0;
        double f = dye / (kPi * passed);
        if (covered)
            for (const glm::vec3 &d : {light, viewer})
                f *= 1 - std::min(1.0f, material.specular->albedo_of_light(d));
        if (material.body) {
            const WeighedLight w = material.body->weigh(light, viewer);
            f += (weft * w.weft + warp * (w.f_cos - w.weft)) / light.z;
        }
        return f;
    };
}

} // namespace tsuya
