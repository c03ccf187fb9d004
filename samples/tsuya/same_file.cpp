#include "same_file.h"

namespace tsuya::program {

namespace fs = std::filesystem;

bool is_same_file(const fs::path &a, const fs::path &b) {
    std::error_code code;
    if (fs::equivalent(a, b, code))
        return true;
    const fs::path whole = fs::weakly_canonical(a, code);
    return !code && whole == fs::weakly_canonical(b, code) && !code;
}

} // namespace tsuya::program
