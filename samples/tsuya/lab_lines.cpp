// tsuya lab lines: the GPIO lines of this computer.

#include <array>
#include <iostream>

#include "command.h"
#include "json.h"
#include "tsuya/lab/gpio_line.h"

namespace tsuya::program {
namespace {

struct LabLines final : Command {
    bool json = false;

    void options(Options &o) override {
        o.flag("--json", &json, "print the lines as JSON");
        o.example("tsuya lab lines");
    }

    Status run(Console &console) override {
        const lab::GpioListing listing = lab::gpio_lines();
        if (listing.lines.empty() && !listing.unreadable.empty())
            throw Error(listing.unreadable);
        if (listing.lines.empty())
            console.warning("this computer has no GPIO chip");
        for (const Problem &problem : listing.unreadable)
            console.warning(problem);
        if (json)
            print_json(listing);
        else
            print(listing.lines);
        return kDone;
    }

    static void print(const std::vector<lab::GpioLineInfo> &lines) {
        std::vector<std::array<std::string, 6>> rows{
            {"chip", "label", "offset", "direction", "name", "held by"}};
        for (const lab::GpioLineInfo &line : lines)
            rows.push_back({line.chip, line.label, std::to_string(line.offset),
                            line.output ? "output" : "input", line.name, line.consumer});
        std::array<std::size_t, 6> widths{};
        for (const auto &row : rows)
            for (std::size_t i = 0; i < row.size(); ++i)
                widths[i] = std::max(widths[i], row[i].size());
        for (const auto &row : rows) {
            std::string text;
            for (std::size_t i = 0; i < row.size(); ++i)
                text += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
            std::cout << text.substr(0, text.find_last_not_of(' ') + 1) << "\n";
        }
    }

    static void print_json(const lab::GpioListing &listing) {
        Json report{{"schema", "tsuya-lab-lines 1"},
                    {"lines", Json::array()},
                    {"unreadable", Json::array()}};
        for (const lab::GpioLineInfo &line : listing.lines)
            report["lines"].push_back({{"chip", line.chip},
                                       {"label", line.label},
                                       {"offset", line.offset},
                                       {"name", line.name},
                                       {"holder", line.consumer},
                                       {"direction", line.output ? "output" : "input"}});
        for (const Problem &problem : listing.unreadable)
            report["unreadable"].push_back({{"chip", problem.where}, {"why", problem.what}});
        std::cout << report.text() << "\n";
    }
};

} // namespace

std::unique_ptr<Command> make_lab_lines() { return std::make_unique<LabLines>(); }

} // namespace tsuya::program
