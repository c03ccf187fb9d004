// tsuya garment: what is wrong with a mesh, and its limit surface.

#include <algorithm>
#include <cmath>
#include <iostream>

#include "command.h"
#include "grain_option.h"
#include "json_file.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/garment/obj.h"
#include "tsuya/garment/ply.h"
#include "tsuya/scene/output_file.h"

namespace tsuya::program {
namespace {

class GarmentCommand final : public Command {
  public:
    explicit GarmentCommand(CLI::App &program)
        : app_(*program.add_subcommand("garment", "Examine and subdivide meshes")),
          check_(*app_.add_subcommand("check", "What is wrong with a mesh")),
          subdivide_(*app_.add_subcommand("subdivide", "The limit surface of a mesh")) {
        app_.require_subcommand(1);
        app_.footer("Example:\n  tsuya garment check dress.obj --strict");
        check_.footer("Example:\n  tsuya garment check dress.obj --strict\n"
                      "With --strict, a warning gives exit status 4.");
        subdivide_.footer(
            "Example:\n  tsuya garment subdivide dress.obj -o fine.ply --tolerance 1e-4");
        for (CLI::App *app : {&check_, &subdivide_}) {
            app->add_option("mesh", mesh_, "MESH.obj, .gltf, .glb, .ply or .off")->required();
            app->add_option("--unit", unit_, "Of the mesh: m, dm, cm, mm, in")
                ->capture_default_str();
        }
        check_.add_flag("--json", json_, "The report as JSON");
        check_.add_flag("--strict", strict_, "Fail where there is a warning");
        subdivide_.add_option("-o,--output", output_, "OUT.obj, or OUT.ply with warp and weft")
            ->required();
        subdivide_.add_option("--level", level_, "Cuts each edge into 2^level")
            ->check(CLI::Range(0, 8))
            ->capture_default_str();
        subdivide_
            .add_option("--tolerance", tolerance_,
                        "METRES that triangles may depart from the limit surface")
            ->check(CLI::PositiveNumber)
            ->excludes("--level");
        subdivide_
            .add_option("--crease", fold_crease_,
                        "Sharpness of folds, 0 (smooth) to 9: edges bent by more than the angle")
            ->check(CLI::Range(0.0, 9.0))
            ->capture_default_str();
        subdivide_.add_option("--crease-angle", fold_angle_deg_, "DEGREES between the faces")
            ->check(CLI::Range(0.0, 180.0))
            ->capture_default_str();
        subdivide_.add_option("--seam-crease", seam_crease_, "Sharpness of seams, 0 to 10")
            ->check(CLI::Range(0.0, 10.0))
            ->capture_default_str();
        subdivide_
            .add_option("--max-degenerate-area", max_degenerate_area_,
                        "Share of the area without a usable UV above which it is an error")
            ->check(CLI::Range(0.0, 1.0))
            ->capture_default_str();
        subdivide_.add_flag("--strict", strict_, "Refuse a mesh with a warning");
        subdivide_.add_option(
            "--grain", grain_,
            "Of a mesh without UV: vertical, horizontal, or degrees from the vertical");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override { return check_.parsed() ? check() : subdivide(console); }

  private:
    Status check() const {
        const double metres = garment::metres_per(unit_);
        garment::PolygonMesh mesh = garment::read_mesh(mesh_).mesh;
        for (glm::dvec3 &p : mesh.position)
            p *= metres;
        const garment::Report report = garment::check(mesh);
        if (json_)
            std::cout << json_of(report).dump(2) << "\n";
        else
            print(report);
        const bool warned =
            std::any_of(report.findings.begin(), report.findings.end(), [](const auto &finding) {
                return finding.severity == garment::Severity::warning;
            });
        return strict_ && warned ? kCheckFailed : kDone;
    }

    Status subdivide(Console &console) const {
        const garment::Options options{.metres_per_unit = garment::metres_per(unit_),
                                       .subdivide = {.level = level_,
                                                     .tolerance = tolerance_,
                                                     .seam_crease = seam_crease_,
                                                     .fold_crease = fold_crease_,
                                                     .fold_angle = fold_angle_deg_ / degrees_of(1)},
                                       .frames = {.invented_grain = parse_grain(grain_),
                                                  .max_degenerate_area = max_degenerate_area_},
                                       .strict = strict_};
        scene::prepare_output_file(output_, {".obj", ".ply"});
        const garment::LoadedGarment loaded = garment::load(mesh_, options, console.progress());
        console.warnings(loaded.report, mesh_.string());
        if (output_.extension() == ".ply")
            garment::write_ply(output_, loaded.surface);
        else
            garment::write_obj(output_, loaded.surface);
        std::cout << output_.string() << "\n";
        return kDone;
    }

    void print(const garment::Report &r) const {
        const glm::dvec3 size = r.upper - r.lower;
        std::cout << mesh_.string() << "\n  " << r.faces << " faces (" << r.triangles
                  << " triangles, " << r.quads << " quads, " << r.ngons << " larger), "
                  << r.vertices << " vertices, " << r.uvs << " UVs\n  " << r.panels << " panels, "
                  << r.parts << " parts after joining " << r.parts_before << ", "
                  << r.openings.size() << " openings\n  " << size.x << " x " << size.y << " x "
                  << size.z << " m, area " << r.area << " m2\n";
        print_cloth(r);
        for (const garment::Finding &f : r.findings)
            std::cout << (f.severity == garment::Severity::warning ? "warning " : "note ") << f.key
                      << ": " << f.what << (f.where.empty() ? "" : " (" + f.where + ")")
                      << (f.action.empty() ? "" : "; " + f.action) << "\n";
        if (r.findings.empty())
            std::cout << "nothing is wrong\n";
    }

    /// What the UVs say: the scale, the shear, and the grain of each panel.
    static void print_cloth(const garment::Report &r) {
        if (r.metres_per_uv_warp.p50 == 0)
            return;
        const auto line = [](const char *name, const garment::Percentiles &p, double scale,
                             const char *unit) {
            std::cout << "  " << name << " " << scale * p.p5 << ", " << scale * p.p50 << ", "
                      << scale * p.p95 << " " << unit << " (percentiles 5, 50, 95)\n";
        };
        line("weft (u):", r.metres_per_uv_weft, 1, "m a unit of UV");
        line("warp (v):", r.metres_per_uv_warp, 1, "m a unit of UV");
        line("between warp and weft:", r.warp_weft_angle, degrees_of(1), "degrees");
        for (const garment::PanelReport &p : r.panel)
            std::cout << "  panel " << p.name << ": " << p.faces << " faces, " << p.area
                      << " m2, warp " << std::round(degrees_of(p.warp_to_vertical))
                      << " degrees from the vertical\n";
    }

    CLI::App &app_;
    CLI::App &check_;
    CLI::App &subdivide_;
    std::filesystem::path mesh_{}, output_{};
    std::string unit_ = "m";
    std::string grain_{};
    int level_ = 1;
    std::optional<double> tolerance_{};
    double seam_crease_ = 0, fold_crease_ = 0, fold_angle_deg_ = 60;
    double max_degenerate_area_ = garment::FrameOptions{}.max_degenerate_area;
    bool json_ = false, strict_ = false;
};

} // namespace

std::unique_ptr<Command> make_garment(CLI::App &program) {
    return std::make_unique<GarmentCommand>(program);
}

} // namespace tsuya::program
