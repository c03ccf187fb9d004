#pragma once
// The files that a try-on writes.

#include <string>
#include <vector>

#include "tsuya/color/sheet.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/tryon.h"

namespace tsuya::scene {

// Writes renders as they come, their pictures at once or, where the exposure is metered, at the
// end.
class TryOnPictures {
  public:
    // \param result its list of files grows
    TryOnPictures(const TryOn &job, std::vector<NamedLamp> lamps, TryOnResult &result);

    // \param number of the frame, `-0000`, or empty
    void add(const SpectralImage &image, const std::string &dye, const std::string &number);
    // Writes what waits for the exposure.
    void finish();
    // Writes the sheet of pictures without a number.
    void write_sheet();

  private:
    struct Waiting {
        std::string dye, number;
    };
    void write_pictures(const SpectralImage &image, const Waiting &render);
    std::filesystem::path transport(const Waiting &render) const;

    const TryOn &job_;
    std::vector<NamedLamp> lamps_;
    TryOnResult &result_;
    DisplayOptions look_;
    ExposureMeter meter_;
    Sheet sheet_;
    std::vector<Waiting> waiting_{};
};

} // namespace tsuya::scene
