#pragma once
/// \file
/// `--fabric` and `--back`: what the panels of a garment are of.

#include <filesystem>
#include <string>
#include <vector>

#include "options.h"
#include "tsuya/scene/tryon.h"

namespace tsuya::program {

class FabricOptions {
  public:
    void add_to(Options &options);
    /// `--data`, by itself because a command's help ends with it.
    void add_data(Options &options);
    /// Sets fabric, back and panels of the job. Throws Error as find_fabric.
    void fill(scene::TryOn &job) const;
    /// The folder of the sample data; empty where fabrics are named by their files alone.
    /// \param wanted also for something else
    std::filesystem::path data_folder(bool wanted = false) const;

    /// What PANELS is, for a command's notes.
    static std::string notes();

  private:
    void check(const std::vector<std::string> &words) const;

    std::vector<std::string> fabrics_{"black_satin"}, backs_{};
    std::filesystem::path data_{};
};

} // namespace tsuya::program
