#include "tsuya/sdk/yarn_lobes.h"

#include "models/facets.h"
#include "models/yarn_from_above.h"
#include "models/yarn_problem.h"

namespace tsuya {

YarnLobes fit_yarn_lobes(const Bard &bard, double f0, const Progress &progress) {
    if (!(bard.peak() > 0))
        return {.f0 = checked_f0(f0)}; // black: nothing is on any slope
    return best_from_above(YarnProblem(bard, f0, progress), f0, least_roughness(bard)).lobes;
}

} // namespace tsuya
