#include <cmath>
#include <cstdio>
#include <sstream>

#include "tsuya/color/camera_frame.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

constexpr const char *kLine = "expected `dn,exposure_s`, both above those of the line before";

/// Whether a line is two numbers and nothing else.
bool scan(const std::string &line, double &dn, double &exposure_s) {
    char rest = 0;
    return std::sscanf(line.c_str(), " %lf , %lf %c", &dn, &exposure_s, &rest) == 2 &&
           std::isfinite(dn) && std::isfinite(exposure_s);
}

} // namespace

ResponseCurve read_response_csv(const std::filesystem::path &path) {
    std::istringstream lines(read_text(path));
    ResponseCurve curve;
    Problems problems;
    bool begun = false;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#')
            continue;
        double dn = 0, exposure_s = 0;
        const bool good = scan(line, dn, exposure_s);
        const bool header = !begun && !good;
        begun = true;
        if (header)
            continue;
        const double last_dn = curve.dn.empty() ? -1 : curve.dn.back(),
                     last_s = curve.dn.empty() ? 0 : curve.exposure_s.back();
        if (problems.need(good && dn > last_dn && exposure_s > last_s,
                          "the line is no next point of a response curve",
                          path.string() + ":" + std::to_string(number) + ":1", kLine)) {
            curve.dn.push_back(dn);
            curve.exposure_s.push_back(exposure_s);
        }
    }
    problems.throw_if_any();
    if (curve.dn.size() < 2)
        throw Error({"the file holds no response curve", path.string(),
                     "expected two lines `dn,exposure_s` or more"});
    return curve;
}

} // namespace tsuya
