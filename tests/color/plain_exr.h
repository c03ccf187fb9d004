#pragma once
// A reader of OpenEXR files that shares no code with the one under test: the container as "OpenEXR
// File Layout" [OpenEXRLayout] describes it, scan lines packed by ZIP or not at all; and on top the
// rules of [Fichet] for the names of channels.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tsuya::test {

struct PlainPart {
    std::map<std::string, std::string> attribute{}; ///< bytes of the value
    std::map<std::string, std::string> type{};      ///< of the attribute
    std::array<int, 4> data_window{}, display_window{};
    std::vector<std::string> channels{};     ///< in the order of the file
    std::map<std::string, int> pixel_type{}; ///< 1 half, 2 float
    std::map<std::string, std::vector<float>> values{};

    /// The value of an attribute of the type string.
    std::string text(const std::string &name) const;
    /// Numbers of an attribute that is made of floats.
    std::vector<float> floats(const std::string &name) const;
};

/// Throws std::runtime_error for what it does not know.
std::vector<PlainPart> read_plain_exr(const std::string &bytes);

/// Wavelengths in nm of the channels of a kind (S0, T) in the root layer of a part, ascending, and
/// the names of these channels.
std::map<double, std::string> spectral_channels(const PlainPart &part, const std::string &kind);

/// A file of one part whose channels are floats, not packed: for pictures of other programs.
/// `strings` are attributes; each channel has width x height values, row by row.
std::string plain_exr(int width, int height,
                      const std::map<std::string, std::vector<float>> &channels,
                      const std::map<std::string, std::string> &strings);

} // namespace tsuya::test
