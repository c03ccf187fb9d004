#include "tsuya/color/palette.h"

#include "tsuya/color/spectrum_file.h"

namespace tsuya {

std::vector<std::string> expand_palettes(std::span<const std::string> specs) {
    std::vector<std::string> expanded;
    for (const std::string &spec : specs) {
        const auto file = parse_spectrum_file_spec(spec);
        if (!file || file->sample != "*") {
            expanded.push_back(spec);
            continue;
        }
        for (const SpectrumSample &sample : read_spectrum_file(file->path).samples)
            expanded.push_back(file->path.string() + ":" + sample.name);
    }
    return expanded;
}

} // namespace tsuya
