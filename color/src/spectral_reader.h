#pragma once
/// \file
/// Readers of spectral EXRs by whose they are.

#include <string>
#include <vector>

#include "pictures.h"
#include "rows.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// A file that tsuya wrote, in any of its layouts. Throws Error at `where`.
SpectralImage read_own_spectral(const std::vector<InputPicture> &parts, const std::string &where);

/// A file of another program in the layout of [Fichet]. Throws Error at `where`.
SpectralImage read_foreign_spectral(const std::vector<InputPicture> &parts,
                                    const std::string &where);

/// A picture of 0 of the size that a part has or is a part of, with its data window. Throws Error
/// at `where` if there is no memory for it.
SpectralImage empty_spectral(const InputPicture &part, const SpectralBasis &basis,
                             std::vector<std::string> groups, const std::string &where);

/// Numbers of channels of a part, by their names. Throws Error at `where` for one that is missing.
std::vector<std::size_t> find_channels(const InputPicture &part,
                                       const std::vector<std::string> &names,
                                       const std::string &where);

/// Copies the channels `from` of a part, side by side, to the pixels `to(x, y)` of the whole
/// picture.
template <class To>
void copy_channels(const InputPicture &part, const std::vector<std::size_t> &from, To &&to) {
    const Image &image = part.image;
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    for_rows(image.height, row, [&](int first, int end) {
        for (int y = first; y < end; ++y)
            for (int x = 0; x < image.width; ++x) {
                float *out = to(part.place.x + x, part.place.y + y);
                for (const std::size_t channel : from)
                    *out++ = image.pixel(x, y)[channel];
            }
    });
}

} // namespace tsuya
