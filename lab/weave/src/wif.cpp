#include "tsuya/lab/wif.h"

#include <numeric>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"
#include "wif_text.h"

namespace tsuya::lab {
namespace {

using detail::WifEntry;
using detail::WifSection;
using detail::WifText;

constexpr int kMaxThreads = 4096, kMaxShafts = 256, kMaxColors = 65536;
constexpr std::size_t kMaxBytes = 4 << 20;

/// Which of the numbers 1 to n are named; index 0 is unused.
using Marks = std::vector<char>;

int required_integer(WifText &text, const WifSection *section, std::string_view section_name,
                     std::string_view key, int high) {
    if (section == nullptr)
        return 1;
    if (const WifEntry *entry = section->find(key))
        return text.integer(*entry, 1, high);
    text.problem(section->line, 1, "[" + std::string(section_name) + "] has no " + std::string(key),
                 "expected " + std::string(key) + "=number");
    return 1;
}

/// `1=2,3` for each of `count` rows as the marks of that row.
std::vector<Marks> marks_of(WifText &text, const WifSection *section, int count, int high) {
    std::vector<Marks> rows(static_cast<std::size_t>(count),
                            Marks(static_cast<std::size_t>(high) + 1, 0));
    if (section != nullptr)
        for (const WifEntry &entry : section->entries) {
            const int row = text.key_number(entry, count);
            for (const int value : text.integers(entry, 0, high))
                if (row > 0)
                    rows[static_cast<std::size_t>(row - 1)][static_cast<std::size_t>(value)] = 1;
        }
    for (Marks &row : rows)
        row[0] = 0; // shaft or treadle 0 is none
    return rows;
}

bool share_one(const Marks &a, const Marks &b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] != 0 && b[i] != 0)
            return true;
    return false;
}

/// Shafts that are tied, by treadles or liftplan, for each pick.
std::vector<Marks> shafts_of_picks(WifText &text, int picks, int shafts, int treadles) {
    const WifSection *treadling = text.find("treadling");
    if (treadling == nullptr) {
        const WifSection *liftplan = text.find("liftplan");
        if (liftplan == nullptr)
            text.problem(1, 1, "neither [TREADLING] nor [LIFTPLAN]", "expected one of them");
        return marks_of(text, liftplan, picks, shafts);
    }
    const std::vector<Marks> tieup = marks_of(text, text.require("tieup"), treadles, shafts);
    const std::vector<Marks> trodden = marks_of(text, treadling, picks, treadles);
    std::vector<Marks> result(trodden.size(), Marks(static_cast<std::size_t>(shafts) + 1, 0));
    for (std::size_t p = 0; p < trodden.size(); ++p)
        for (std::size_t t = 1; t < trodden[p].size(); ++t)
            for (std::size_t s = 0; trodden[p][t] != 0 && s < tieup[t - 1].size(); ++s)
                result[p][s] = static_cast<char>(result[p][s] | tieup[t - 1][s]);
    return result;
}

/// Colours 1 to n as 0 to 1.
std::vector<glm::dvec3> palette_of(WifText &text) {
    std::vector<glm::dvec3> palette;
    const WifSection *table = text.find("color table");
    if (table == nullptr)
        return palette;
    int low = 0, high = 255;
    if (const WifSection *section = text.find("color palette"))
        if (const WifEntry *entry = section->find("range")) {
            const std::vector<int> range = text.integers(*entry, 0, 1 << 20);
            if (range.size() == 2 && range[0] < range[1])
                std::tie(low, high) = std::pair(range[0], range[1]);
            else
                text.value_problem(*entry, "range is \"" + entry->value + "\"",
                                   "expected two numbers, the smaller first");
        }
    for (const WifEntry &entry : table->entries) {
        const int index = text.key_number(entry, kMaxColors);
        const std::vector<int> rgb = text.integers(entry, low, high);
        if (rgb.size() != 3) {
            text.value_problem(entry, "colour " + entry.key + " has not three parts",
                               "expected red,green,blue");
            continue;
        }
        palette.resize(std::max(palette.size(), static_cast<std::size_t>(index)));
        if (index > 0)
            palette[static_cast<std::size_t>(index - 1)] =
                (glm::dvec3(rgb[0], rgb[1], rgb[2]) - double(low)) / double(high - low);
    }
    return palette;
}

std::vector<glm::dvec3> colors_of(WifText &text, const std::string &name, int threads,
                                  const std::vector<glm::dvec3> &palette) {
    const WifSection *section = text.find(name), *each = text.find(name + " colors");
    const WifEntry *common = section != nullptr ? section->find("color") : nullptr;
    if (common == nullptr && each == nullptr)
        return {};
    const auto color = [&](const WifEntry &entry) {
        const std::vector<int> values = text.integers(entry, 0, kMaxColors);
        if (!values.empty() && values[0] >= 1 &&
            static_cast<std::size_t>(values[0]) <= palette.size())
            return palette[static_cast<std::size_t>(values[0] - 1)];
        text.value_problem(entry, "colour \"" + entry.value + "\" is not in the colour table",
                           "expected a number from 1 to " + std::to_string(palette.size()));
        return glm::dvec3(1);
    };
    std::vector<glm::dvec3> result(static_cast<std::size_t>(threads),
                                   common != nullptr ? color(*common) : glm::dvec3(1));
    if (each != nullptr)
        for (const WifEntry &entry : each->entries)
            if (const int thread = text.key_number(entry, threads); thread > 0)
                result[static_cast<std::size_t>(thread - 1)] = color(entry);
    return result;
}

/// Metres that 1 stands for in the spacings of a section.
double unit_of(WifText &text, const WifSection &section) {
    constexpr double kInch = 0.0254, kCentimetre = 0.01;
    const WifEntry *entry = section.find("units");
    if (entry == nullptr)
        return kCentimetre;
    const std::string unit = detail::lower_case(entry->value);
    if (unit == "decipoints")
        return kInch / 720;
    if (unit == "inches")
        return kInch;
    if (unit != "centimeters")
        text.value_problem(*entry, "unknown unit \"" + entry->value + "\"",
                           "expected decipoints, inches or centimeters");
    return kCentimetre;
}

std::optional<double> spacing_of(WifText &text, const std::string &name, int threads) {
    constexpr double kLeast = 1e-6, kMost = 1e6;
    const WifSection *section = text.find(name), *each = text.find(name + " spacing");
    if (section == nullptr)
        return std::nullopt;
    const double unit = unit_of(text, *section);
    std::optional<double> common;
    if (const WifEntry *entry = section->find("spacing"))
        common = unit * text.number(*entry, kLeast, kMost);
    if (each == nullptr || each->entries.empty())
        return common;
    std::vector<double> all(static_cast<std::size_t>(threads), common.value_or(0));
    for (const WifEntry &entry : each->entries)
        if (const int thread = text.key_number(entry, threads); thread > 0)
            all[static_cast<std::size_t>(thread - 1)] = unit * text.number(entry, kLeast, kMost);
    std::erase(all, 0.0);
    if (all.empty())
        return common;
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

} // namespace

Wif parse_wif(std::string_view content, const std::string &name) {
    if (content.size() > kMaxBytes)
        throw Error({"the file has " + std::to_string(content.size()) + " bytes", name,
                     "expected at most 4 MB"});
    WifText text(content, name);
    text.require("wif");
    const int ends = required_integer(text, text.require("warp"), "WARP", "threads", kMaxThreads);
    const int picks = required_integer(text, text.require("weft"), "WEFT", "threads", kMaxThreads);
    const WifSection *weaving = text.require("weaving");
    const int shafts = required_integer(text, weaving, "WEAVING", "shafts", kMaxShafts);
    const bool treadled = text.find("treadling") != nullptr;
    const int treadles =
        treadled ? required_integer(text, weaving, "WEAVING", "treadles", kMaxShafts) : 1;
    const WifEntry *shed = weaving != nullptr ? weaving->find("rising shed") : nullptr;
    const bool rising = shed == nullptr || text.flag(*shed);
    text.finish(); // sizes first: what follows is counted against them

    const std::vector<Marks> threading = marks_of(text, text.require("threading"), ends, shafts);
    const std::vector<Marks> lifted = shafts_of_picks(text, picks, shafts, treadles);
    const std::vector<glm::dvec3> palette = palette_of(text);
    Wif wif;
    for (auto [yarns, system, threads] :
         {std::tuple(&wif.warp, "warp", ends), std::tuple(&wif.weft, "weft", picks)}) {
        yarns->color = colors_of(text, system, threads, palette);
        yarns->spacing = spacing_of(text, system, threads);
    }
    if (const WifSection *notes = text.find("text"))
        if (const WifEntry *title = notes->find("title"))
            wif.title = title->value;
    text.finish();

    wif.drawdown = {ends, picks, {}};
    for (const Marks &pick : lifted)
        for (const Marks &end : threading)
            wif.drawdown.warp_up.push_back(share_one(pick, end) == rising ? 1 : 0);
    wif.draft = smallest_repeat(wif.drawdown);
    return wif;
}

Wif read_wif(const std::filesystem::path &file) {
    return parse_wif(read_text(file), file.string());
}

} // namespace tsuya::lab
