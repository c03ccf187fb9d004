#include "render_plan.h"

#include <iomanip>
#include <sstream>

#include "console.h"
#include "json_file.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::program {

std::string environment_text(double error) {
    std::ostringstream text;
    text << "the colours of the environment are mixed of three lamps with an error of "
         << std::setprecision(2) << 100 * error << " %";
    return text.str();
}

std::string plan_text(const scene::SceneFile &file, const scene::BuiltScene &built,
                      const RenderSettings &settings, bool as_json) {
    const Plan made = plan(built.scene, settings);
    if (as_json) {
        Json report = json_of(made);
        report["environment_error"] =
            file.environment_error ? Json(*file.environment_error) : Json();
        report["meshes"] = Json::array();
        for (const scene::MeshReport &mesh : built.reports)
            report["meshes"].push_back({{"mesh", mesh.mesh.string()},
                                        {"faces", mesh.report.faces},
                                        {"triangles", mesh.report.limit_triangles}});
        return report.text() + "\n";
    }
    std::string text =
        file.environment_error ? environment_text(*file.environment_error) + "\n" : "";
    text += shown(explain(made), "\n");
    for (const scene::MeshReport &mesh : built.reports)
        text += detail::counted(mesh.report.limit_triangles, "triangle") + " of " +
                detail::counted(mesh.report.faces, "face") + ": " + mesh.mesh.string() + "\n";
    return text;
}

} // namespace tsuya::program
