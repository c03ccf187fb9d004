#pragma once
/// \file
/// Picture files. A file appears under its name only when it is complete; a failed write leaves
/// nothing behind.
///
/// Two modules read and write them, each loaded when it is first used: `libtsuya_picture_writer.so`
/// writes EXR and PNG, `libtsuya_picture_reader.so` reads all, and writes TIFF and JPEG.
/// color/README.md says where they are looked for. A function whose module is missing throws Error.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/lamp.h"
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

/// What write_spectral_exr writes beside the picture.
struct SpectralExrOptions {
    /// Of transport and alpha. Halves where they can hold it: a picture whose values end above
    /// 65504, or whose light group ends below 1/1024, is written in floats all the same.
    SampleType samples = SampleType::half;
    /// Lamps of the picture R, G, B that other programs show: one for all light groups, or one for
    /// each, with their factors; the neutral is that of the first. Empty: D65, or E for radiance.
    std::vector<NamedLamp> lamps{};
};

/// Writes light transport as an EXR of several parts in the layout of [Fichet]. The first part,
/// `rgb`, is the picture under a lamp in halves, linear with the primaries of Rec. 709, and alpha
/// as `A`, by which colours are multiplied (associated alpha). Each light group is a part
/// `transport.GROUP` with a channel for each centre, named with a decimal comma: `T.400,000nm`; or
/// `T.depth.00`, see DyeDepths. Each AOV is a part `aov.NAME` of float32, its channels named as
/// they are. All parts have the data window of the picture in the display window of the whole. The
/// attributes of the first part say the rest: `tsuya:schema`, `tsuya:basis`, `tsuya:group.<i>`,
/// `tsuya:aov.<i>`, `tsuya:alpha`, `tsuya:rgb.lamp`, the metadata as `tsuya:meta:<key>` (an entry
/// without a value is left out), and `cryptomatte/...`. Equal pictures are equal bytes. Throws
/// Error at the path, also for sizes that do not agree and names that are empty or used twice.
void write_spectral_exr(const std::filesystem::path &path, const SpectralImage &image,
                        const SpectralExrOptions &options = {});

/// Rounds transport and alpha to what a file of these samples has, so that pictures that are made
/// of them are those that are made of the file.
void round_as_written(SpectralImage &image, SampleType samples);

/// Reads what write_spectral_exr wrote, in this layout or its first (all in one part), the whole
/// picture with 0 outside of its data window; floats are exact. Also reads spectral EXRs of other
/// programs in the layout of [Fichet]: reflectances (T) as transport, or radiance (S0), see
/// SpectralImage::emissive; each layer or part that has them is a light group, their wavelengths
/// are samples. Other channels of such a file are left out, those of polarised light too. Throws
/// Error at the path: no such file, no EXR, no spectral one, a channel that is missing, layers of
/// different wavelengths or sizes, both radiance and reflectance, fluorescence, cut short.
SpectralImage read_spectral_exr(const std::filesystem::path &path);

} // namespace tsuya
