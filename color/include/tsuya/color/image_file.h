#pragma once
/// \file
/// Picture files. A file appears under its name only when it is complete; a failed write leaves
/// nothing behind.
///
/// OpenImageIO is in a module, `libtsuya_pictures.so`, that is loaded when the first picture is
/// touched; color/README.md says where it is looked for. Without it every function that touches a
/// file throws Error.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/rgb_primaries.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// Throws Error where the module that writes pictures cannot be loaded. For programs that work long
/// before they write the first picture; any other has no need to call it.
void check_pictures();

/// Writes a PNG of a display picture: values in [0, 1], already encoded (see display), clamped; 1
/// (grey), 3 (RGB) or 4 (RGBA) channels, the colours not multiplied by alpha, which is linear, as
/// PNG has them. `bits` is 8 or 16. Throws Error at the path for another
/// number of channels or bits, a value that is NaN, or a file that cannot be written.
void write_png(const std::filesystem::path &path, const Image &image, int bits = 8);

/// How a picture of a display is written.
struct PictureFileOptions {
    int bits = 8; ///< of a sample: 8, or 16 for PNG and TIFF
    /// Of display_names(), whose profile the file gets: none for sRGB, which every program takes
    /// for granted and a PNG states; an ICC profile; for Rec.2100 the chunk cICP of a PNG [Png3].
    /// Empty: one that is not known, without a profile.
    std::string display = "sRGB";
};

/// Writes a picture as write_png, as what its ending says: `.png`, `.tif`, `.tiff`, `.jpg` or
/// `.jpeg` (of quality 95, without alpha). Throws Error as write_png, for another ending, and for
/// what the format does not have.
void write_picture(const std::filesystem::path &path, const Image &image,
                   const PictureFileOptions &options = {});

/// The endings that write_picture takes.
std::vector<std::string> picture_file_endings();

/// Throws Error at `path` where write_picture refuses its ending or the options, whatever the
/// picture is. \param alpha the picture has alpha
void check_picture_file(const std::filesystem::path &path, const PictureFileOptions &options,
                        bool alpha = false);

/// Reads any picture that OpenImageIO reads (PNG, JPEG, TIFF, EXR, ...): the values as the file has
/// them (encoded for a PNG: 255 becomes 1; linear for an EXR), channels named as in the file, the
/// first part of a file of many. Throws Error at the path.
Image read_image(const std::filesystem::path &path);

/// How samples are stored. Half has 11 significant bits and ends at 65504.
enum class SampleType { float32, half };

/// What write_exr writes beside the picture.
struct ExrOptions {
    SampleType samples = SampleType::float32;
    std::map<std::string, std::string> metadata{}; ///< written as `tsuya:meta:<key>`
    std::optional<RgbPrimaries> primaries{};       ///< of R, G, B: the attribute `chromaticities`
};

/// Writes all channels by their names. Floats come back exactly. Throws Error at the path, also for
/// a channel name that is empty or used twice.
void write_exr(const std::filesystem::path &path, const Image &image,
               const ExrOptions &options = {});

/// Writes light transport as a spectral EXR in the layout of [Fichet]: a channel of the group `key`
/// is named after its centre with a decimal comma, e.g. `key.S0.400,000nm`; AOVs are layers, e.g.
/// `aov.normal.X`, but those of Cryptomatte, whose channels and metadata `cryptomatte/...` have
/// their own names. Alpha is the channel `A`, by which colours are multiplied (associated alpha).
/// AOVs are always float32. The file has the data window of the picture in the display window of
/// the whole. Attributes: `tsuya:schema`, `tsuya:basis`, `tsuya:group.<i>`,
/// `tsuya:aov.<i>`, `tsuya:alpha`, and the metadata as `tsuya:meta:<key>` (an
/// entry without a value is left out). Throws Error at the path, also for
/// sizes that do not agree and names that are empty or used twice.
void write_spectral_exr(const std::filesystem::path &path, const SpectralImage &image,
                        SampleType samples = SampleType::float32);

/// Reads what write_spectral_exr wrote, the whole picture with 0 outside of its data window; floats
/// are exact. Throws Error at the path: no such file,
/// no EXR, none of ours, a channel that is missing, cut short.
SpectralImage read_spectral_exr(const std::filesystem::path &path);

} // namespace tsuya
