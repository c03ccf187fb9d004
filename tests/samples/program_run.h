#pragma once
// What tests of the program share beside process.h.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "samples/process.h"
#include "samples/scratch.h"
#include "tsuya/color/image_file.h"

namespace tsuya::program {

inline Outcome run(const scene::Scratch &scratch, const std::vector<std::string> &arguments) {
    return run_program(arguments, scratch.folder());
}

inline std::vector<std::string> lines_of(const std::string &text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// The picture has that size, and is neither black nor of one colour.
inline void expect_picture(const std::filesystem::path &file, int width, int height) {
    const Image image = read_image(file);
    EXPECT_EQ(image.width, width) << file;
    EXPECT_EQ(image.height, height) << file;
    const double mean = std::accumulate(image.data.begin(), image.data.end(), 0.0) /
                        static_cast<double>(image.data.size());
    const auto [least, most] = std::minmax_element(image.data.begin(), image.data.end());
    EXPECT_GT(mean, 0.05) << file;
    EXPECT_GT(*most - *least, 0.1f) << file;
}

/// The small scene of a piece of cloth; returns its path.
inline std::string write_scene(const scene::Scratch &scratch, const std::string &more = "") {
    scratch.write("cloth.obj", scene::cloth_obj());
    return scratch.write("small.scene.toml", scene::small_scene(more)).string();
}

} // namespace tsuya::program
