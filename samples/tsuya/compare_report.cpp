#include "compare_report.h"

#include <iomanip>
#include <optional>
#include <sstream>
#include <vector>

namespace tsuya::program {
namespace {

constexpr const char *kLab[] = {"L", "a", "b"};

int degrees_of(Observer observer) { return observer == Observer::cie1931 ? 2 : 10; }

Json json_of(const glm::dvec3 &lab) { return Json::array({lab.x, lab.y, lab.z}); }

Json json_of(const Spread &spread) {
    return {{"mean", spread.mean}, {"p5", spread.p5}, {"p50", spread.p50}, {"p95", spread.p95}};
}

Json json_of(const std::optional<double> &value) { return value ? Json(*value) : Json(); }

Json json_of(const ObservedPart &observed) {
    Json colors = Json::array(), changes = Json::array();
    for (const PartColor &color : observed.colors) {
        Json angles = Json::object();
        for (std::size_t c = 0; c < 3; ++c)
            angles[kLab[c]] = json_of(color.over_angle[c]);
        colors.push_back(
            {{"lamp", color.lighting}, {"lab", json_of(color.lab)}, {"over_angle", angles}});
    }
    for (const PartChange &change : observed.changes)
        changes.push_back({{"reference", change.reference},
                           {"test", change.test},
                           {"ciede2000", json_of(change.ciede2000)},
                           {"cmccon02", json_of(change.inconstancy)},
                           {"ciede2000_over_angle", json_of(change.ciede2000_over_angle)},
                           {"cmccon02_over_angle", json_of(change.inconstancy_over_angle)}});
    return {
        {"observer_deg", degrees_of(observed.observer)}, {"colors", colors}, {"changes", changes}};
}

Json json_of(const PairReport &pair) {
    Json matches = Json::array(), metamerism = Json::array();
    for (const ClothMatch &match : pair.matches)
        matches.push_back(
            {{"lamp", match.lighting}, {"ciede2000", match.ciede2000}, {"cmc_2_1", match.cmc}});
    for (const MetamerismFigures &figures : pair.metamerism)
        metamerism.push_back({{"reference", figures.reference},
                              {"test", figures.test},
                              {"multiplicative", json_of(figures.multiplicative)},
                              {"additive", figures.additive},
                              {"spectral", json_of(figures.spectral)}});
    return {{"first", pair.first},
            {"second", pair.second},
            {"observer_deg", degrees_of(pair.observer)},
            {"matches", matches},
            {"metamerism", metamerism}};
}

/// Quoted where CSV asks for it.
std::string field(const std::string &text) {
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

/// Rows of the CSV file.
class Rows {
  public:
    explicit Rows(const ColorReport &report) : report_(report) {
        text_ << "picture,dye,kind,name,second_picture,second_dye,second_kind,second_name,"
                 "observer_deg,reference,lamp,figure,value,pixel_mean,pixel_p5,pixel_p50,"
                 "pixel_p95\n";
        text_ << std::setprecision(9);
    }

    /// What rows are of from here on.
    void of(std::size_t part, Observer observer, std::optional<std::size_t> second = {}) {
        std::ostringstream head;
        for (const std::optional<std::size_t> &one : {std::optional(part), second}) {
            const PartReport none{}, &named = one ? report_.parts[*one] : none;
            for (const std::string *text : {&named.picture, &named.dye, &named.kind, &named.name})
                head << field(*text) << ',';
        }
        head << degrees_of(observer) << ',';
        head_ = head.str();
    }
    void add(const std::string &reference, const std::string &lamp, const char *figure,
             const std::optional<double> &value, const std::optional<Spread> &spread = {}) {
        text_ << head_ << field(reference) << ',' << field(lamp) << ',' << figure << ',';
        if (value)
            text_ << *value;
        if (spread)
            text_ << ',' << spread->mean << ',' << spread->p5 << ',' << spread->p50 << ','
                  << spread->p95 << '\n';
        else
            text_ << ",,,,\n";
    }
    std::string text() const { return text_.str(); }

  private:
    const ColorReport &report_;
    std::ostringstream text_{};
    std::string head_{};
};

/// A part in words: `dress, crimson: fabric satin`.
std::string title_of(const PartReport &part) {
    std::string title;
    for (const std::string &more :
         {part.picture, part.dye, part.kind + (part.name.empty() ? "" : " ") + part.name})
        if (!more.empty())
            title += (title.empty() ? "" : ", ") + more;
    return title;
}

std::string number(const std::optional<double> &value, int width = 8) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << std::setw(width);
    if (value)
        text << *value;
    else
        text << '-';
    return text.str();
}

std::string cell(const std::string &text) {
    std::ostringstream padded;
    padded << "  " << std::left << std::setw(14) << text;
    return padded.str();
}

void describe(const ObservedPart &observed, std::ostream &out) {
    out << cell(std::to_string(degrees_of(observed.observer)) + " degrees")
        << "       L       a       b   L p5  p50  p95\n";
    for (const PartColor &color : observed.colors) {
        const Spread &lightness = color.over_angle[0];
        out << cell(color.lighting) << number(color.lab.x) << number(color.lab.y)
            << number(color.lab.z) << number(lightness.p5) << number(lightness.p50)
            << number(lightness.p95) << '\n';
    }
    for (const PartChange &change : observed.changes)
        out << cell(change.reference + " -> " + change.test) << "CIEDE2000"
            << number(change.ciede2000) << " (pixels p95" << number(change.ciede2000_over_angle.p95)
            << "), CMCCON02" << number(change.inconstancy) << " (pixels p95"
            << number(change.inconstancy_over_angle.p95) << ")\n";
}

} // namespace

Json json_of_report(const ColorReport &report) {
    Json parts = Json::array(), pairs = Json::array(), lamps = Json::array();
    for (const std::string &lamp : report.lightings)
        lamps.push_back(lamp);
    for (const PartReport &part : report.parts) {
        Json observed = Json::array();
        for (const ObservedPart &one : part.observed)
            observed.push_back(json_of(one));
        parts.push_back({{"picture", part.picture},
                         {"dye", part.dye},
                         {"kind", part.kind},
                         {"name", part.name},
                         {"pixels", part.pixels},
                         {"observers", observed}});
    }
    for (const PairReport &pair : report.pairs)
        pairs.push_back(json_of(pair));
    return {{"lamps", lamps},
            {"formulae",
             {{"lab", "CIELAB beside the white of the lamp"},
              {"ciede2000", "CIEDE2000, k_L = k_C = k_H = 1"},
              {"cmc_2_1", "CMC(2:1), ISO 105-J03"},
              {"cmccon02", "CMCCON02, ISO 105-J05: CAT02, adapted fully, CMC(2:1)"},
              {"metamerism", "ISO 18314-4, CIEDE2000"}}},
            {"parts", parts},
            {"pairs", pairs}};
}

std::string csv_of(const ColorReport &report) {
    Rows rows(report);
    for (std::size_t p = 0; p < report.parts.size(); ++p)
        for (const ObservedPart &observed : report.parts[p].observed) {
            rows.of(p, observed.observer);
            for (const PartColor &color : observed.colors)
                for (int c = 0; c < 3; ++c)
                    rows.add("", color.lighting, kLab[c], color.lab[c],
                             color.over_angle[static_cast<std::size_t>(c)]);
            for (const PartChange &change : observed.changes) {
                rows.add(change.reference, change.test, "ciede2000", change.ciede2000,
                         change.ciede2000_over_angle);
                rows.add(change.reference, change.test, "cmccon02", change.inconstancy,
                         change.inconstancy_over_angle);
            }
        }
    for (const PairReport &pair : report.pairs) {
        rows.of(pair.first, pair.observer, pair.second);
        for (const ClothMatch &match : pair.matches) {
            rows.add("", match.lighting, "ciede2000", match.ciede2000);
            rows.add("", match.lighting, "cmc_2_1", match.cmc);
        }
        for (const MetamerismFigures &figures : pair.metamerism) {
            rows.add(figures.reference, figures.test, "metamerism_multiplicative",
                     figures.multiplicative);
            rows.add(figures.reference, figures.test, "metamerism_additive", figures.additive);
            rows.add(figures.reference, figures.test, "metamerism_spectral", figures.spectral);
        }
    }
    return rows.text();
}

std::string text_of(const ColorReport &report) {
    std::ostringstream out;
    out << "CIELAB beside the white of each lamp, L* = 100 is Y = 1";
    if (report.exposure_stops != 0)
        out << " after the exposure (stops: " << report.exposure_stops << ")";
    out << ";\nchange of lamp by CAT02, fully adapted: CIEDE2000, and CMCCON02 (ISO 105-J05, "
           "CMC(2:1));\n"
           "metamerism by ISO 18314-4 with CIEDE2000.\n"
           "Percentiles are over the pixels, which see the cloth at as many angles.\n";
    for (const PartReport &part : report.parts) {
        out << '\n' << title_of(part) << " (" << part.pixels << " pixels)\n";
        for (const ObservedPart &observed : part.observed)
            describe(observed, out);
    }
    for (const PairReport &pair : report.pairs) {
        out << '\n'
            << title_of(report.parts[pair.first]) << " and " << title_of(report.parts[pair.second])
            << ", " << degrees_of(pair.observer) << " degrees\n";
        for (const ClothMatch &match : pair.matches)
            out << cell(match.lighting) << "CIEDE2000" << number(match.ciede2000) << ", CMC(2:1)"
                << number(match.cmc) << '\n';
        for (const MetamerismFigures &figures : pair.metamerism)
            out << cell(figures.reference + " -> " + figures.test) << "metamerism: multiplicative"
                << number(figures.multiplicative) << ", additive" << number(figures.additive)
                << ", spectral" << number(figures.spectral) << '\n';
    }
    return out.str();
}

} // namespace tsuya::program
