#include "tsuya/lab/plan.h"

#include <cstdio>

int main() {
    const tsuya::lab::Plan plan{.views = "one", .frames = {{.exposure_s = 0.1}}};
    const std::string text = tsuya::lab::plan_text(plan);
    std::fputs(text.c_str(), stdout);
    return text.find("\"exposure_s\":0.1}") == std::string::npos ? 1 : 0;
}
