#pragma once
// Options that several commands have: how a picture is shown.

#include <string>

#include <CLI/CLI.hpp>

#include "tsuya/scene/picture.h"

namespace tsuya::program {

/// --adapt, --view and --exposure.
struct LookOptions {
    std::string adapt = to_string(scene::default_look().adapt);
    std::string view = scene::default_look().view;
    double exposure_stops = 0;

    void add_to(CLI::App &app) {
        app.add_option("--adapt", adapt, "Eye's adaptation to the lamp: none, bradford, cat02")
            ->capture_default_str();
        app.add_option("--view", view, "See `tsuya list views`")->capture_default_str();
        app.add_option("--exposure", exposure_stops, "Stops; 1 doubles the light")
            ->check(CLI::Range(-20.0, 20.0))
            ->capture_default_str();
    }
    /// Throws Error for unknown names.
    DisplayOptions look() const {
        view_description(view);
        return {.adapt = parse_adaptation(adapt), .view = view, .exposure_stops = exposure_stops};
    }
};

} // namespace tsuya::program
