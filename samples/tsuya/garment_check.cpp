// tsuya garment check: what is wrong with a mesh.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::program {
namespace {

using detail::counted;

// [doc:command]
struct GarmentCheck final : Command {
    std::filesystem::path mesh{};
    std::string unit = "m", up{};
    garment::SeamOptions seams{};
    std::optional<double> metres_per_uv{};
    bool json = false, strict = false;
    const Option *unit_option = nullptr;

    void options(Options &o) override {
        o.argument(&mesh, "MESH", "mesh: OBJ, glTF, PLY, OFF, FBX, DAE or STL").required();
        unit_option = &add_unit(o, unit, "length unit of the mesh");
        add_up(o, up);
        add_sewing_tolerance(o, seams.tolerance);
        add_uv_scale(o, metres_per_uv);
        o.flag("--json", &json, "print the report as JSON");
        o.flag("--strict", &strict, "exit status 4 where there is a warning");
        o.example("tsuya garment check dress.obj --strict");
    }
    // [/doc:command]

    Status run(Console &console) override {
        const garment::Options settings{.metres_per_unit = garment::metres_per(unit),
                                        .up = stated_up(up)};
        garment::MeshFile read = garment::read_mesh(mesh, console.progress());
        for (glm::dvec3 &p : read.mesh.position)
            p = garment::in_metres(settings, p);
        garment::Report report = checked(std::move(read.mesh), console);
        if (const auto upright = garment::find_up_axis(report); upright && !settings.up)
            report.findings.push_back(*upright);
        report.findings.insert(report.findings.end(), read.findings.begin(), read.findings.end());
        if (json)
            std::cout << json_of(report).text() << "\n";
        else
            print(report);
        const bool warned =
            std::any_of(report.findings.begin(), report.findings.end(), [](const auto &finding) {
                return finding.severity == garment::Severity::warning;
            });
        return strict && warned ? kCheckFailed : kDone;
    }

    garment::Report checked(garment::PolygonMesh metres, Console &console) const {
        try {
            return garment::check(std::move(metres), seams, console.progress(), metres_per_uv,
                                  unit_option->given);
        } catch (const Error &error) {
            throw error.at(mesh.string());
        }
    }

    void print(const garment::Report &r) const {
        const glm::dvec3 size = r.upper - r.lower;
        std::cout << mesh.string() << "\n  " << counted(r.faces, "face") << " ("
                  << counted(r.triangles, "triangle") << ", " << counted(r.quads, "quad") << ", "
                  << r.ngons << " larger), " << counted(r.vertices, "vertex", "vertices") << ", "
                  << counted(r.uvs, "UV") << "\n  "
                  << (r.panels == 0 ? "no panels" : counted(r.panels, "panel")) << ", "
                  << counted(r.parts, "part") << " after joining " << r.parts_before << ", "
                  << counted(r.openings.size(), "opening") << "\n  " << size.x << " x " << size.y
                  << " x " << size.z << " m, area " << r.area << " m2\n";
        print_cloth(r);
        for (const garment::PanelReport &p : r.panel)
            print_panel("panel", p);
        print_islands(r);
        for (const garment::Finding &f : r.findings)
            std::cout << (f.severity == garment::Severity::warning ? "warning " : "note ") << f.key
                      << ": "
                      << shown(f.what + (f.where.empty() ? "" : " (" + f.where + ")") +
                               (f.action.empty() ? "" : "; " + f.action))
                      << "\n";
        if (r.findings.empty())
            std::cout << "nothing is wrong\n";
    }

    /// What the UVs say: the scale and the shear.
    static void print_cloth(const garment::Report &r) {
        if (r.metres_per_uv_warp.p50 == 0)
            return;
        const auto percentiles = [](const char *name, const garment::Percentiles &p, double scale,
                                    const char *unit) {
            std::cout << "  " << name << " " << scale * p.p5 << ", " << scale * p.p50 << ", "
                      << scale * p.p95 << " " << unit << " (percentiles 5, 50, 95)\n";
        };
        percentiles("weft (u):", r.metres_per_uv_weft, 1, "m a unit of UV");
        percentiles("warp (v):", r.metres_per_uv_warp, 1, "m a unit of UV");
        percentiles("between warp and weft:", r.warp_weft_angle, degrees_of(1), "degrees");
    }

    /// What can be named: in a scene by [garments.NAME.panels], in a try-on by --fabric
    /// PANEL=FABRIC.
    static void print_panel(const char *kind, const garment::PanelReport &p) {
        const glm::dvec3 size = p.upper - p.lower;
        std::cout << "  " << kind << " " << shown(p.name + names_of(p)) << ": "
                  << counted(p.faces, "face") << ", " << p.area << " m2, " << size.x << " x "
                  << size.y << " x " << size.z << " m about (" << 0.5 * (p.lower.x + p.upper.x)
                  << ", " << 0.5 * (p.lower.y + p.upper.y) << ", " << 0.5 * (p.lower.z + p.upper.z)
                  << ")";
        if (p.warp != glm::dvec3(0))
            std::cout << ", warp " << std::round(degrees_of(p.warp_to_vertical))
                      << " degrees from the vertical";
        std::cout << "\n";
    }

    /// Of panels that have several.
    static void print_islands(const garment::Report &r) {
        constexpr std::size_t kShown = 64;
        for (std::size_t i = 0; i < std::min(r.island.size(), kShown); ++i)
            print_panel("island", r.island[i]);
        if (r.island.size() > kShown)
            std::cout << "  and " << counted(r.island.size() - kShown, "island")
                      << " more; --json lists all\n";
    }

    /// ` (group g, material m)`: what the file calls a panel, where that is not its name.
    static std::string names_of(const garment::PanelReport &p) {
        std::string names;
        for (const auto &[kind, name] :
             {std::pair("object", &p.label.object), std::pair("group", &p.label.group),
              std::pair("material", &p.label.material), std::pair("island", &p.label.island)})
            if (!name->empty() && *name != p.name)
                names += (names.empty() ? " (" : ", ") + std::string(kind) + " " + *name;
        return names.empty() ? names : names + ")";
    }
};

} // namespace

// [doc:make_command]
std::unique_ptr<Command> make_garment_check() { return std::make_unique<GarmentCheck>(); }
// [/doc:make_command]

} // namespace tsuya::program
