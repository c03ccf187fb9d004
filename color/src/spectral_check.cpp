#include "spectral_check.h"

#include <algorithm>
#include <set>

#include "channels.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light_group.h"

namespace tsuya {
namespace {

void check_once(const std::vector<std::string> &names, const std::string &of,
                const std::string &where) {
    std::set<std::string> seen;
    for (const std::string &name : names)
        if (!seen.insert(name).second)
            throw Error(
                {"two " + of + " have the name '" + name + "'", where, "expected different names"});
}

} // namespace

void check_spectral_image(const SpectralImage &image, const std::string &where) {
    const SpectralBasis &basis = image.basis;
    const std::size_t values = static_cast<std::size_t>(std::max(0, image.width)) *
                               static_cast<std::size_t>(std::max(0, image.height)) *
                               static_cast<std::size_t>(std::max(0, basis.count)) *
                               image.groups.size();
    if (!basis.is_valid() || values == 0 || image.transport.size() != values)
        throw Error({"the transport holds " + std::to_string(image.transport.size()) +
                         " values where its size, groups and basis say " + std::to_string(values),
                     where, "expected width x height x channels x groups values, at least one"});
    if (image.depths) {
        check_dye_depths(*image.depths, where);
        if (image.depths->node.size() != static_cast<std::size_t>(basis.count))
            throw Error({detail::counted(image.depths->node.size(), "depth") + " of dye for " +
                             detail::counted(static_cast<std::size_t>(basis.count), "channel"),
                         where, "expected one for each"});
    }
    if (image.aovs.size() != image.aov_names.size())
        throw Error({detail::counted(image.aovs.size(), "AOV") + " given with " +
                         detail::counted(image.aov_names.size(), "name"),
                     where, "expected a name for each"});
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        check_image(image.aovs[i], where + ": aovs." + image.aov_names[i]);
        if (image.aovs[i].width != image.width || image.aovs[i].height != image.height)
            throw Error({"the AOV '" + image.aov_names[i] + "' has another size", where,
                         "expected the size of the picture"});
    }
    if (image.alpha)
        check_image(*image.alpha, where + ": alpha");
    if (image.alpha && (image.alpha->width != image.width || image.alpha->height != image.height ||
                        image.alpha->channels.size() != 1))
        throw Error({"alpha is no picture of the same size", where,
                     "expected the size of the picture, and one channel"});
    if (image.data_window) {
        const auto [x0, y0, x1, y1] = *image.data_window;
        if (!(0 <= x0 && x0 < x1 && x1 <= image.width && 0 <= y0 && y0 < y1 && y1 <= image.height))
            throw Error({"the data window does not lie in the picture", where,
                         "expected x0 < x1 and y0 < y1 within its size"});
    }
    for (const std::string &group : image.groups)
        check_light_group(group, where);
    if (std::find(image.aov_names.begin(), image.aov_names.end(), "") != image.aov_names.end())
        throw Error({"an AOV has no name", where, "expected names"});
    check_once(image.groups, "light groups", where);
    check_once(image.aov_names, "AOVs", where);
}

} // namespace tsuya
