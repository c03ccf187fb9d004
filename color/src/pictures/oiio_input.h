#pragma once
/// \file
/// Opens picture files through OpenImageIO, with its errors translated; shared by the readers of
/// pictures and of a camera's frames.

#include <filesystem>
#include <memory>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace tsuya {

/// OpenImageIO's message on one line. A part that another part repeats is left out.
std::string one_line(const std::string &text);

/// Gives OpenImageIO and OpenEXR as many threads as the caller's arena has, see
/// detail::run_with_threads. The number is the library's own and global: of two callers at once,
/// the later one's holds.
void use_threads_of_arena();

/// Opens a flat picture. Throws Error at the path: no such file, no picture, deep or a volume.
/// \param config how a reader shall read; null: as it does by itself
std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path &path,
                                               const OIIO::ImageSpec *config = nullptr);

/// The same of a PNG in memory. The proxy must outlive the picture. \param name for errors
std::unique_ptr<OIIO::ImageInput> open_png(OIIO::Filesystem::IOProxy &bytes,
                                           const std::string &name, const OIIO::ImageSpec &config);

/// Throws Error at the path where the memory for some rows of a picture is not available: its
/// header may declare any size.
/// \param bytes_a_sample of all that the rows are kept in
void need_memory_for(const std::filesystem::path &path, const OIIO::ImageSpec &spec, int rows,
                     std::size_t bytes_a_sample);

/// Throws the Error of a picture that ended early or cannot be decoded.
[[noreturn]] void fail_reading(const std::filesystem::path &path, const std::string &cause);

} // namespace tsuya
