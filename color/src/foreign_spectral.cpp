#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "spectral_layout.h"
#include "spectral_reader.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using namespace layout;

/// The spectral channels of one layer.
struct Layer {
    const InputPicture *part;
    std::string name{};
    std::map<double, std::size_t> channel{}; ///< by wavelength
};

/// What a layer is called where a light group is named: by its layer, else by its part.
std::string name_of(const InputPicture &part, const std::string &layer) {
    std::string name = !layer.empty() ? layer : !part.part.empty() ? part.part : "light";
    std::replace(name.begin(), name.end(), '=', '-');
    return name;
}

/// Of one kind, radiance or reflectance.
std::vector<Layer> layers_of(const std::vector<InputPicture> &parts, bool emissive,
                             const std::string &where) {
    std::vector<Layer> layers;
    for (const InputPicture &part : parts) {
        std::map<std::string, Layer> of_part;
        for (std::size_t c = 0; c < part.image.channels.size(); ++c) {
            const std::string &channel = part.image.channels[c];
            const auto parsed = parse_channel(channel, where);
            if (!parsed || parsed->emissive != emissive)
                continue;
            Layer &layer = of_part.try_emplace(parsed->layer, Layer{&part}).first->second;
            layer.name = name_of(part, parsed->layer);
            if (!std::isfinite(parsed->wavelength_nm) || parsed->wavelength_nm <= 0 ||
                !layer.channel.emplace(parsed->wavelength_nm, c).second)
                throw Error({"the channel '" + channel + "' repeats a wavelength, or has none",
                             where, "expected each wavelength once, above 0"});
        }
        for (auto &[name, layer] : of_part)
            layers.push_back(std::move(layer));
    }
    return layers;
}

std::vector<double> wavelengths_of(const Layer &layer) {
    std::vector<double> nm;
    for (const auto &[wavelength, channel] : layer.channel)
        nm.push_back(wavelength);
    return nm;
}

std::vector<std::string> different_names(const std::vector<Layer> &layers) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Layer &layer : layers) {
        std::string name = layer.name;
        for (int i = 2; !taken.insert(name).second; ++i)
            name = layer.name + ' ' + std::to_string(i);
        names.push_back(std::move(name));
    }
    return names;
}

} // namespace

SpectralImage read_foreign_spectral(const std::vector<InputPicture> &parts,
                                    const std::string &where) {
    std::vector<Layer> layers = layers_of(parts, false, where);
    const std::vector<Layer> radiance = layers_of(parts, true, where);
    if (layers.empty() && radiance.empty())
        throw Error({"the file is no spectral picture", where, kOurs});
    if (!layers.empty() && !radiance.empty())
        throw Error({"the picture has radiance and reflectance", where,
                     "expected one of them: S0 channels or T channels"});
    const bool emissive = layers.empty();
    if (emissive)
        layers = radiance;
    const std::vector<double> nm = wavelengths_of(layers.front());
    for (const Layer &layer : layers)
        if (wavelengths_of(layer) != nm)
            throw Error({"the layers '" + layers.front().name + "' and '" + layer.name +
                             "' have different wavelengths",
                         where, "expected the same in all"});
    SpectralImage image = empty_spectral(*layers.front().part, SpectralBasis::samples_at(nm),
                                         different_names(layers), where);
    image.emissive = emissive;
    for (std::size_t g = 0; g < layers.size(); ++g) {
        const InputPicture &part = *layers[g].part;
        const SpectralImage same = empty_spectral(part, {.count = 1}, {"light"}, where);
        if (same.width != image.width || same.height != image.height ||
            same.data_window != image.data_window)
            throw Error({"the layer '" + layers[g].name + "' has another size", where,
                         "expected the same in all"});
        std::vector<std::size_t> channels;
        for (const auto &[wavelength, channel] : layers[g].channel)
            channels.push_back(channel);
        copy_channels(part, channels, [&](int x, int y) { return image.pixel(g, x, y); });
    }
    if (const auto units = layers.front().part->attributes.find(kUnitsKey);
        units != layers.front().part->attributes.end())
        image.metadata[kUnitsKey] = units->second;
    return image;
}

} // namespace tsuya
