#include "depth_attributes.h"

#include <locale>
#include <sstream>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr const char *kBasis = "tsuya:basis";
constexpr std::size_t kMostDepths = 1024;

std::string dye_key(std::size_t i) { return "tsuya:dye." + std::to_string(i); }
std::string depth_key(std::size_t k) { return "tsuya:depth." + std::to_string(k); }

std::ostringstream writer() {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(17);
    return text;
}

// Reads the words of attributes.
struct Reader {
    const std::map<std::string, std::string> &attributes;
    const std::string &where;

    [[noreturn]] void fail(const std::string &key) const {
        throw Error({"the attribute " + key + " is missing or wrong", where,
                     "expected an EXR that tsuya wrote"});
    }
    std::istringstream words(const std::string &key) const {
        const auto found = attributes.find(key);
        if (found == attributes.end())
            fail(key);
        std::istringstream text(found->second);
        text.imbue(std::locale::classic());
        return text;
    }

    DyeVariable dye(std::size_t i) const {
        DyeVariable dye{.name = attributes.at(dye_key(i)), .dye = {{}, {}}};
        std::istringstream range = words(dye_key(i) + ".range");
        std::string kind;
        if (!(range >> dye.lowest >> dye.highest >> kind) || (kind != "open" && kind != "fixed"))
            fail(dye_key(i) + ".range");
        dye.open = kind == "open";
        std::istringstream spectrum = words(dye_key(i) + ".spectrum");
        for (double nm = 0, value = 0; spectrum >> nm >> value;) {
            dye.dye.wavelength_nm.push_back(nm);
            dye.dye.value.push_back(value);
        }
        if (!spectrum.eof())
            fail(dye_key(i) + ".spectrum");
        return dye;
    }
    void depth(std::size_t k, DyeDepths &depths) const {
        std::istringstream text = words(depth_key(k));
        depths.node.emplace_back();
        depths.degree.emplace_back();
        for (std::size_t d = 0; d < depths.dyes.size(); ++d)
            if (!(text >> depths.node.back()[d] >> depths.degree.back()[d]))
                fail(depth_key(k));
    }
};

} // namespace

void write_depths(const DyeDepths &depths, std::map<std::string, std::string> &attributes) {
    attributes[kBasis] = "depths " + std::to_string(depths.node.size());
    for (std::size_t i = 0; i < depths.dyes.size(); ++i) {
        const DyeVariable &dye = depths.dyes[i];
        attributes[dye_key(i)] = dye.name;
        std::ostringstream range = writer(), spectrum = writer();
        range << dye.lowest << ' ' << dye.highest << (dye.open ? " open" : " fixed");
        attributes[dye_key(i) + ".range"] = range.str();
        for (std::size_t s = 0; s < dye.dye.value.size(); ++s)
            spectrum << (s > 0 ? " " : "") << dye.dye.wavelength_nm[s] << ' ' << dye.dye.value[s];
        attributes[dye_key(i) + ".spectrum"] = spectrum.str();
    }
    for (std::size_t k = 0; k < depths.node.size(); ++k) {
        std::ostringstream text = writer();
        for (std::size_t d = 0; d < depths.dyes.size(); ++d)
            text << (d > 0 ? " " : "") << depths.node[k][d] << ' ' << depths.degree[k][d];
        attributes[depth_key(k)] = text.str();
    }
}

std::optional<DyeDepths> read_depths(const std::map<std::string, std::string> &attributes,
                                     const std::string &where) {
    const auto basis = attributes.find(kBasis);
    if (basis == attributes.end() || !basis->second.starts_with("depths"))
        return std::nullopt;
    const Reader reader{attributes, where};
    std::istringstream text = reader.words(kBasis);
    std::string kind;
    std::size_t count = 0;
    if (!(text >> kind >> count) || count < 1 || count > kMostDepths)
        reader.fail(kBasis);
    DyeDepths depths;
    while (depths.dyes.size() < kMostDyes && attributes.count(dye_key(depths.dyes.size())) > 0)
        depths.dyes.push_back(reader.dye(depths.dyes.size()));
    for (std::size_t k = 0; k < count; ++k)
        reader.depth(k, depths);
    check_dye_depths(depths, where);
    return depths;
}

} // namespace tsuya
