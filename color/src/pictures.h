#pragma once
/// \file
/// Picture files, behind two modules, each loaded when it is first used. The writer of EXR and PNG
/// needs few libraries. The reader, which also writes TIFF and JPEG, needs OpenImageIO with its 260
/// libraries, which take a fifth of a second to load.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "tsuya/color/camera_frame.h"
#include "tsuya/color/image_file.h"

namespace tsuya {

/// Where a part of a picture lies: its upper left corner, and the size of the whole.
struct PicturePlace {
    int x = 0, y = 0, width = 0, height = 0;
};

/// A picture to write, row by row; or a part of a file of several.
struct OutputPicture {
    std::string part{}; ///< its name; of a file of several
    int width = 0;      ///< of what is written
    int height = 0;
    /// Its place in a picture that may be larger; empty: it is the whole
    std::optional<PicturePlace> place{};
    std::vector<std::string> channels{};
    SampleType samples = SampleType::float32;
    /// Number of the channel from which on all are float32: those before are as `samples` says
    std::size_t exact_from = std::numeric_limits<std::size_t>::max();
    std::map<std::string, std::string> attributes{};
    std::optional<RgbPrimaries> primaries{}; ///< of R, G, B
    std::optional<glm::dvec2> neutral{};     ///< x, y of what is to be seen as neutral
    /// Fills one row: width x channels floats, interleaved.
    std::function<void(int y, float *row)> fill_row{};
};

/// What a file of coded samples is.
struct CodedFile {
    int bits = 8;                       ///< of a sample
    std::string icc{};                  ///< the profile; empty: none
    std::array<std::uint8_t, 4> cicp{}; ///< of a PNG; all 0: not stated [Png3]
    bool srgb = true;                   ///< the file says that it is sRGB, where it can
};

/// A picture as it was read, with its string attributes.
struct InputPicture {
    std::string part{};   ///< the name of its part; empty where the file has no names
    std::string format{}; ///< OpenImageIO's name of the file format, e.g. openexr
    Image image{};
    PicturePlace place{}; ///< its pixels in the whole that the file describes
    std::map<std::string, std::string> attributes{};
};

/// What floats, which are linear, become in 8 bits: colours by the curve of sRGB, shares as they
/// are. Alpha is a share in both.
enum class FloatCode { srgb, linear };

/// A picture of 8 bits a sample. Alpha is not multiplied into colours.
struct EncodedPicture {
    int width = 0, height = 0, channels = 0;
    int alpha = -1; ///< its channel; -1: none
    std::vector<std::uint8_t> data{};
};

/// A camera's picture that is open.
class FrameFile {
  public:
    virtual ~FrameFile() = default;
    /// Why the numbers are not in proportion to light; empty where they are.
    virtual std::string not_linear() const = 0;
    /// All but image and area; `cfa` from the picture's corner.
    virtual CameraFrame description() const = 0;
    /// The numbers of an area within the picture: whole ones as they are stored. Throws Error.
    virtual Image read(const PixelArea &area) = 0;
};

/// How a line of text stands.
struct TextPlace {
    int x = 0, baseline = 0; ///< pixels
    bool centred = false;    ///< about x; else it begins there
    int size = 0;            ///< of the letters, pixels
    std::array<float, 3> colour{};
};

/// What the module that writes does. All throw Error at the path.
class PictureWriter {
  public:
    virtual ~PictureWriter() = default;
    /// One part or more.
    virtual void write_exr(const std::filesystem::path &path,
                           std::span<const OutputPicture> parts) const = 0;
    /// A PNG. Values are rows of width x channels samples.
    virtual void write_png(const std::filesystem::path &path, const Image &shape,
                           const CodedFile &file, const void *samples) const = 0;
    /// The bytes compressed, in the format of zlib.
    virtual std::string deflate(std::string_view bytes) const = 0;
    /// Width and height of a text in pixels. Throws Error at `sheet.font`.
    virtual std::array<int, 2> text_size(const std::string &text, int size,
                                         const std::string &font) const = 0;
    /// Writes a text into an RGB picture. Throws Error at `sheet.font`.
    virtual void write_text(Image &image, const std::string &text, const TextPlace &place,
                            const std::string &font) const = 0;
};

/// What the module that reads does, which also writes TIFF and JPEG. All throw Error at the path.
class PictureReader {
  public:
    virtual ~PictureReader() = default;
    virtual InputPicture read(const std::filesystem::path &path) const = 0; ///< the first part
    virtual std::vector<InputPicture> read_parts(const std::filesystem::path &path) const = 0;
    /// Floats are clamped to [0, 1]; one that is not a number is an Error.
    virtual EncodedPicture read_encoded(const std::filesystem::path &path,
                                        FloatCode floats) const = 0;
    /// A PNG in memory. \param name for errors
    virtual EncodedPicture decode_png(std::string_view bytes, const std::string &name) const = 0;
    virtual std::unique_ptr<FrameFile> open_frame(const std::filesystem::path &path) const = 0;
    /// A TIFF or JPEG, as the path ends. Values are rows of width x channels samples.
    virtual void write_tiff_or_jpeg(const std::filesystem::path &path, const Image &shape,
                                    const CodedFile &file, const void *samples) const = 0;
};

/// The modules, loaded at the first call. Throw Error where that fails.
const PictureWriter &picture_writer();
const PictureReader &picture_reader();

} // namespace tsuya
