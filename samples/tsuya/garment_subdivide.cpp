// tsuya garment subdivide: the limit surface of a mesh.

#include <iostream>

#include "command.h"
#include "grain_option.h"
#include "look_options.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/obj.h"
#include "tsuya/garment/ply.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::program {
namespace {

struct GarmentSubdivide final : Command {
    std::filesystem::path mesh{}, output{};
    std::string unit = "m", up{}, grain{};
    int level = 1;
    std::optional<double> tolerance{};
    double seam_crease = 0, fold_crease = 0, fold_angle_deg = 60;
    double max_degenerate_area = garment::FrameOptions{}.max_degenerate_area;
    garment::SeamOptions seams{};
    std::optional<double> metres_per_uv{};
    bool strict = false;
    const Option *unit_option = nullptr;

    void options(Options &o) override {
        o.argument(&mesh, "MESH", "mesh: OBJ, glTF, PLY, OFF, FBX, DAE or STL").required();
        o.option("-o,--output", &output, "OUT.obj|OUT.ply",
                 "the triangles; a PLY has warp and weft, too")
            .required()
            .result({".obj", ".ply"});
        unit_option = &add_unit(o, unit, "length unit of the mesh");
        add_up(o, up);
        const Option &levels =
            o.option("--level", &level, "N", "level of subdivision: each edge is cut into 2^N")
                .range(0, 8);
        o.option("--tolerance", &tolerance, "METRES",
                 "largest distance of the triangles from the limit surface")
            .positive()
            .excludes(levels);
        o.option("--crease", &fold_crease, "SHARPNESS",
                 "sharpness of folds: edges bent by more than the crease angle; 0 is smooth")
            .range(0, 9);
        o.option("--crease-angle", &fold_angle_deg, "DEGREES",
                 "angle between two faces above which their edge is a fold")
            .range(0, 180);
        o.option("--seam-crease", &seam_crease, "SHARPNESS", "sharpness of seams; 0 is smooth")
            .range(0, 10);
        o.option("--max-degenerate-area", &max_degenerate_area, "SHARE",
                 "share of the area without a usable UV above which it is an error")
            .range(0, 1);
        add_sewing_tolerance(o, seams.tolerance);
        add_uv_scale(o, metres_per_uv);
        o.flag("--strict", &strict, "refuse a mesh with a warning");
        add_grain(o, grain);
        o.example("tsuya garment subdivide dress.obj -o fine.ply --tolerance 1e-4");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        const garment::Options settings{.metres_per_unit = garment::metres_per(unit),
                                        .unit_stated = unit_option->given,
                                        .up = stated_up(up),
                                        .metres_per_uv = metres_per_uv,
                                        .seams = seams,
                                        .subdivide = {.level = level,
                                                      .tolerance = tolerance,
                                                      .seam_crease = seam_crease,
                                                      .fold_crease = fold_crease,
                                                      .fold_angle = fold_angle_deg * kDegree},
                                        .frames = {.invented_grain = parse_grain(grain),
                                                   .max_degenerate_area = max_degenerate_area},
                                        .strict = strict};
        const garment::LoadedGarment loaded = garment::load(mesh, settings, console.progress());
        console.warnings(loaded.report, mesh.string());
        // [doc:command_run]
        scene::prepare_output_file(output);
        if (output.extension() == ".ply")
            garment::write_ply(output, loaded.surface, console.progress());
        else
            garment::write_obj(output, loaded.surface, console.progress());
        std::cout << output.string() << "\n";
        return kDone;
        // [/doc:command_run]
    }
};

} // namespace

std::unique_ptr<Command> make_garment_subdivide() { return std::make_unique<GarmentSubdivide>(); }

} // namespace tsuya::program
