#pragma once
/// \file
/// From light transport to pictures under lamps, and to a sheet of them.

#include <span>
#include <string>
#include <vector>

#include "tsuya/color/compare.h"
#include "tsuya/color/config.h"
#include "tsuya/color/live_page.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

/// How pictures look by default: colours as seen beside daylight, highlights rolled off.
inline DisplayOptions default_look() { return {.adapt = Adaptation::none, .view = "Soft"}; }

/// Channels X, Y, Z of the transport under one lamp for all light groups, or one for each, each
/// times its factor; under one of the name `own`, each group has the lamp of its own, see
/// own_lamps.h. Throws Error as relight.
Image xyz_under(const SpectralImage &transport, std::span<const NamedLamp> lamps);

/// Display-encoded R, G, B of the same; where the transport has alpha also A, by which the colours
/// are not multiplied (as PNG has it).
/// Where the look adapts, the eye is used to the adopted_white. Throws Error as relight and
/// display.
Image picture_under(const SpectralImage &transport, std::span<const NamedLamp> lamps,
                    const DisplayOptions &look = default_look());
/// The same of a lighting.
Image picture_under(const SpectralImage &transport, const Lighting &lighting,
                    const DisplayOptions &look = default_look());

/// The look of a page: in the place of a config or display that it has not, the program's own.
DisplayOptions page_look(DisplayOptions look);

/// Lamps as programs name them, such as `D65` or `my/lamp.csv`; a name of `lamp_sets()` stands for
/// several. Each is called as label_of says. Throws Error as
/// find_lamp, and for none or two whose files would have one name. \param sample which of several
/// spectra a file has, where the spec does not say so
std::vector<NamedLamp> parse_lamps(std::span<const std::string> specs,
                                   const std::filesystem::path &folder = {},
                                   const std::string &sample = {});

/// Throws Error for names that parse_lamps refuses whatever files there are.
void check_lamps(std::span<const std::string> specs);

/// The lamp of each light group of `groups`, from specs that are either `LAMP`, for every group
/// that is not named, or `GROUP=LAMP`. Throws Error for an unknown group, with the known ones, a
/// group without a lamp, two lamps for one group, and as find_lamp.
/// \param sample see parse_lamps
std::vector<NamedLamp> parse_group_lamps(std::span<const std::string> specs,
                                         std::span<const std::string> groups,
                                         const std::filesystem::path &folder = {},
                                         const std::string &sample = {});

/// Throws Error for specs that parse_group_lamps refuses whatever the groups and files: an unknown
/// lamp, two lamps for one group.
void check_group_lamps(std::span<const std::string> specs);

/// Shows other dyes in a picture whose dyes are open: each spec is `DYE`, for all of them, or
/// `FABRIC=DYE`. Throws Error as find_dye and set_dye.
/// \return the warnings of find_dye
std::vector<std::string> show_dyes(SpectralImage &image, std::span<const std::string> specs);

/// A line about a page that was written: its file, size, and the errors of its colours.
std::string page_summary(const std::filesystem::path &file, const LivePage &page);

/// What a dye or lamp is called in words: `#aabbcc`, `0.5*A`; `x` of `my/x.csv`, `x:navy` of
/// `my/x.csv:navy`.
std::string label_of(const std::string &spec);

/// The part of a file name that stands for a dye or lamp, from how programs name it or from its
/// label: `crimson`; `x_navy` of `my/x.csv:navy`; `aabbcc` of `#aabbcc`, `0.5A` of `0.5*A`.
std::string file_stem_of(const std::string &spec);

/// Throws Error for two dyes or lamps whose files would have one name: `CRIMSON` and `crimson`,
/// `a/x.csv` and `b/x.csv`. \param kind `dye`, `lamp`
void check_distinct(std::span<const std::string> specs, const std::string &kind);

} // namespace tsuya::scene
