#pragma once
// The program gnuplot.

#include <filesystem>
#include <string>

namespace tsuya::scene {

// Draws a picture of that size in pixels; its name ends in .svg or .png, which chooses the kind.
// The script sets no terminal and no output. Throws Error: another name, no gnuplot, naming the
// package that has it, and what gnuplot says where it fails.
void run_gnuplot(const std::string &script, const std::filesystem::path &file, int width,
                 int height);

} // namespace tsuya::scene
