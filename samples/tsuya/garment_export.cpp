// tsuya garment export: a dressed garment for viewers.

#include <iostream>

#include "command.h"
#include "fabric_options.h"
#include "grain_option.h"
#include "look_options.h"
#include "tsuya/scene/export.h"
#include "tsuya/scene/output_file.h"

namespace tsuya::program {
namespace {

struct GarmentExport final : Command {
    scene::TryOn job{.dyes = {"white"}};
    std::filesystem::path output{};
    FabricOptions cloth{};
    std::string dye{}, grain{}, up{};
    const Option *unit = nullptr;

    void options(Options &o) override {
        o.argument(&job.garment, "MESH", "mesh: OBJ, glTF, PLY, OFF, FBX, DAE or STL").required();
        o.option("-o,--output", &output, "OUT.glb", "the garment with its fabrics, for viewers")
            .required()
            .result({".glb"});
        cloth.add_to(o);
        o.option("--dye", &dye, "DYE",
                 "name of `tsuya list dyes`, #rrggbb, F.csv; white where none is given and the "
                 "fabric has none")
            .check([this] {
                if (!dye.empty())
                    scene::check_dyes({dye});
            });
        unit = &add_unit(o, job.unit, "length unit of the mesh");
        add_up(o, up);
        o.option("--level", &job.level, "N", "level of subdivision: each edge is cut into 2^N")
            .range(0, 8);
        add_sewing_tolerance(o, job.seams.tolerance);
        add_uv_scale(o, job.metres_per_uv);
        add_grain(o, grain);
        cloth.add_data(o);
        o.example("tsuya garment export dress.obj --fabric black_satin --dye crimson -o dress.glb");
        o.notes("Viewers have one lobe of facets: its widths along and across the yarns are fitted "
                "to the fabric's views, and how far it lies from the fabric is printed (l2_cos of "
                "15 lights). UVs are in metres of cloth. Prints, opacity and backs have no place "
                "there.\n" +
                FabricOptions::notes());
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        cloth.fill(job);
        job.invented_grain = parse_grain(grain);
        job.unit_stated = unit->given;
        job.up = stated_up(up);
        job.keeps_own_dye = dye.empty();
        if (!dye.empty())
            job.dyes = {dye};
        scene::prepare_output_file(output);
        for (const scene::ExportedFabric &fabric :
             scene::export_glb(job, output, console.progress()))
            std::cout << fabric.name << ": roughness " << fabric.roughness << ", anisotropy "
                      << fabric.anisotropy_strength << ", l2_cos " << fabric.l2_cos << "\n";
        std::cout << output.string() << "\n";
        return kDone;
    }
};

} // namespace

std::unique_ptr<Command> make_garment_export() { return std::make_unique<GarmentExport>(); }

} // namespace tsuya::program
