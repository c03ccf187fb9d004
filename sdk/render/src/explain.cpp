// A plan as text.

#include <cstdint>
#include <iomanip>
#include <sstream>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/plan.h"

namespace tsuya {
namespace {

std::string channels_text(const Plan &p) {
    std::string text = "channels: " + std::to_string(p.channels);
    if (p.dyes.empty())
        return text + " over wavelengths\n";
    text += " depths of";
    for (std::size_t i = 0; i < p.dyes.size(); ++i)
        text += std::string(i > 0 ? " and" : "") + (p.dyes[i].open ? " the open dye '" : " '") +
                p.dyes[i].name + "'";
    return text + ": every dye and lamp afterwards\n";
}

std::string row(const Feature &feature) {
    const std::string saves = feature.saves ? text_of(*feature.saves) : "";
    return (feature.on ? "on   " : "off  ") + feature.name + ": " + feature.why +
           (saves.empty() ? "" : "; saves " + saves) + "\n";
}

} // namespace

std::string text_of(const Saving &saving) {
    std::ostringstream text;
    text << std::setprecision(2);
    const auto between = [&] { return text.tellp() > 0 ? ", " : ""; };
    if (saving.of_sample > 0)
        text << "about " << 100 * saving.of_sample << " % of a sample";
    if (saving.seconds > 0)
        text << between() << "about " << saving.seconds << " s";
    if (saving.bytes > 0)
        text << between() << detail::byte_text(static_cast<std::uint64_t>(saving.bytes));
    return text.str();
}

std::string explain(const Plan &p) {
    std::string text = channels_text(p) + "bounces: up to " + std::to_string(p.max_bounces) + "\n";
    text += "lights: " + detail::counted(p.lights.size(), "light") +
            (p.environment ? ", environment" : "") + "\n";
    text += std::string("parts:") + (p.any_diffuse ? " diffuse" : "") +
            (p.any_specular ? " specular" : "") + "\n";
    for (const Feature &feature : p.features)
        text += row(feature);
    return text;
}

} // namespace tsuya
