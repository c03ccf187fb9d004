#pragma once
/// \file
/// The sheet of a comparison: pictures under lamps, where they differ, and the colours of fabrics.

#include <span>
#include <string>
#include <vector>

#include "tsuya/color/color_report.h"
#include "tsuya/color/compare.h"
#include "tsuya/color/config.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/sheet.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

/// Width of a picture of a sheet of four columns that a screen shows whole, in pixels.
inline constexpr int kSheetPictureWidth = 480;

/// A transport of a smaller picture: each pixel is the mean of a square of `side` x `side`, those
/// at the right and the lower edge of fewer. Of AOVs it keeps those of one channel.
SpectralImage smaller_transport(const SpectralImage &transport, int side);

/// A comparison that is drawn picture by picture, each with rows of its own, at most kSheetColumns
/// pictures in each: adapted to each lamp (by CAT02, unless the look says otherwise), as a camera
/// for daylight sees it, the map of CIEDE2000 between each lamp and the first with its legend, and
/// swatches of the fabrics with L*, a*, b*. Captions have the correlated colour temperature and Ra
/// of the lamps, and the share of pixels that sRGB has no colour for.
class CompareSheet {
  public:
    /// \param lamps as picture_under has them; at least two
    /// \param look of the pictures
    /// \param figure_stops exposure of the maps and of the colours of parts, whatever that of the
    /// pictures is: L* = 100 is Y = 1 after it
    CompareSheet(std::vector<NamedLamp> lamps, const DisplayOptions &look, Observer observer,
                 double figure_stops = 0);

    /// \param label of its rows. \param parts of the report that are of this picture. Throws Error
    /// as picture_under.
    void add(const std::string &label, const SpectralImage &transport,
             std::span<const PartReport> parts);
    /// What is drawn by draw_sheet.
    const Sheet &sheet() const { return sheet_; }
    /// The largest share of pixels out of gamut so far, adapted or not.
    double most_out_of_gamut() const { return most_out_of_gamut_; }

  private:
    void add_pictures(const std::string &label, const SpectralImage &transport,
                      const std::vector<Lighting> &lightings, bool adapted);
    void add_maps(const SpectralImage &transport, const std::vector<Lighting> &lightings);
    void add_swatches(std::span<const PartReport> parts, int width, int height);

    std::vector<NamedLamp> lamps_;
    std::vector<std::string> captions_{};
    DisplayOptions look_;
    Observer observer_;
    double figure_stops_;
    Sheet sheet_{.columns = kSheetColumns};
    double most_out_of_gamut_ = 0;
};

/// What a lamp is, in two lines: name with colour temperature, and Ra where it has one.
std::string lamp_caption(const NamedLamp &lamp);

} // namespace tsuya::scene
