#include "tsuya/scene/map_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gnuplot.h"
#include "plot_data.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/feature_points.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

constexpr int kWidth = 1360, kHeight = 640;
constexpr double kLargestTilt = 45; // degrees, that light from above can show

// D of the facets at a tilt.
class FacetMap {
  public:
    explicit FacetMap(const Fabric &fabric)
        : model_(make_model("half_vector", fabric, "fabric")), bard_(*views_of(fabric)),
          f0_(f0_of(*find_specular<CarriedViews>(fabric))) {}

    double at(double tilt, double phi) const {
        const glm::dvec3 half = direction_of(tilt, phi);
        const double cosine = half.z;
        if (tilt <= kLargestTilt * kDegree) {
            const glm::dvec3 view = direction_of(2 * tilt, phi);
            return facets_of_view(bard_, f0_, {view.x, view.y, std::max(view.z, 0.0)});
        }
        // The same solved for light and viewer at H, where F is f0 and G is min(1, 2 cos^2)
        return cosine > 1e-3 ? model_(half, half) * std::max(cosine * cosine, 0.5) / f0_ : 0;
    }

  private:
    BrdfFunction model_;
    const Bard &bard_;
    double f0_;
};

// Marks, and a title with their values. \param angle_share of theta_r in the map's angle
std::string marks(const std::string &title, const std::vector<FeaturePoint> &points,
                  double FeaturePoint::*value, double angle_share) {
    std::string script, values;
    int index = 1;
    for (const FeaturePoint &point : points) {
        const double angle = point.theta * angle_share / kDegree;
        const std::string name(point.name);
        values += (index > 1 ? ", " : "") + name + " " + rounded(point.*value);
        script += "set label " + std::to_string(index++) + " '" + name + "' at " +
                  number(angle * std::cos(point.phi)) + "," + number(angle * std::sin(point.phi)) +
                  " point pt 7 ps 0.7 lc rgb 'black' front center offset 0," +
                  (std::sin(point.phi) < -0.5 ? "1.1" : "-1.1") + " noenhanced boxed\n";
    }
    return script + "set title \"" + title + "\\n" + values + " 1/sr\" noenhanced\n";
}

constexpr const char *kStyle = R"(
set multiplot
set tmargin at screen 0.87
set bmargin at screen 0.13
set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.3,0.3
)";

constexpr const char *kBardLabels = R"(
set lmargin at screen 0.05
set rmargin at screen 0.395
set xlabel 'theta_r along the weft, degrees' noenhanced
set ylabel 'theta_r along the warp, degrees' noenhanced
set cblabel '1/sr'
plot $bard using 1:2:3 with image
)";

constexpr const char *kFacetLabels = R"(
set lmargin at screen 0.55
set rmargin at screen 0.895
set xlabel 'tilt of the facet along the weft, degrees' noenhanced
set ylabel 'tilt of the facet along the warp, degrees' noenhanced
set cblabel 'D(H), 1/sr'
plot $facets using 1:2:3 with image
unset multiplot
)";

} // namespace

void plot_maps(const Fabric &fabric, const std::filesystem::path &file) {
    prepare_output_file(file, {".svg", ".png"});
    const FacetMap facets(fabric); // first: it throws where there is no BARD
    const CarriedViews &carried = *find_specular<CarriedViews>(fabric);
    const auto bard = [&](double theta, double phi) {
        return carried.bard.at(direction_of(theta, phi));
    };
    const auto facet = [&](double tilt, double phi) { return facets.at(tilt, phi); };
    const DiskMap views = disk_map("bard", 90, bard);
    const double shown = shown_tilt(carried.bard) / kDegree;
    const DiskMap tilts = disk_map("facets", shown, facet);
    const double f0 = f0_of(carried);
    const std::vector<FeaturePoint> points = feature_points(carried.bard, f0);
    const std::string title = "Facets D(H) with f0 = " + rounded(f0) + "; striped, beyond " +
                              rounded(shown) + "° of tilt: extrapolated";
    run_gnuplot(views.block + tilts.block + kStyle + disk_style(views.most) +
                    marks("BARD: BRDF under light from straight above", points,
                          &FeaturePoint::brdf_per_sr, 1) +
                    kBardLabels + disk_style(tilts.most) +
                    marks(title, points, &FeaturePoint::facets_per_sr, 0.5) +
                    "set object 4 circle at 0,0 size " + number(shown) +
                    " front fs empty border rgb '#ff3030' lw 1.5\n" + kFacetLabels,
                file, kWidth, kHeight);
}

} // namespace tsuya::scene
