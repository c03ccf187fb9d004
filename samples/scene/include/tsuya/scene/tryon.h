#pragma once
/// \file
/// The main job: a garment in a fabric, in a studio, dyed and lit in several ways.
///
///     TryOn job = tsuya::scene::sample_try_on(tsuya::scene::data_folder());
///     job.output = "out";
///     for (const auto &file : tsuya::scene::run(job).files) ...

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/config.h"
#include "tsuya/color/image_file.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/report.h"
#include "tsuya/garment/seams.h"
#include "tsuya/scene/picture.h"
#include "tsuya/scene/studio_preset.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/render.h"
#include "tsuya/sdk/scene.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya::scene {

/// Default quality of the picture of a try-on: the mean error of the pixels
/// of each part of it before it is denoised, as a share of its value, and the most samples that a
/// pixel may take.
inline constexpr StopRule kTryOnQuality{.samples_per_pixel = 512, .relative_error = 0.06};

/// Throws Error for dyes that a try-on refuses whatever files there are: an unknown name, two of
/// one name.
void check_dyes(const std::vector<std::string> &specs);

/// What some panels of a garment are of, in place of its fabric. The last that names a panel
/// counts.
struct PanelCloth {
    std::string panels{};           ///< see garment::panels_named
    std::filesystem::path fabric{}; ///< F.fabric.toml; empty: the garment's
    std::filesystem::path back{};   ///< F.fabric.toml; empty: the fabric's own back
};

/// What is tried on and how it is shown.
struct TryOn {
    std::filesystem::path garment{}; ///< a mesh with the UV of its panels
    /// Meshes of the garment's faces with other positions: each gives pictures of its own, as does
    /// the garment, which is frame 0. The camera stands still and sees all of them.
    std::vector<std::filesystem::path> frames{};
    bool morph_targets = false; ///< of the garment (glTF): frames before `frames`
    /// Views of garment and body as they turn once before the camera and the lights, which stand
    /// still, each with pictures of its own as frames have: 2 to 9999; 0: they do not turn. The
    /// camera sees all of them whole. Without frames and tolerance_px.
    int turntable = 0;
    std::filesystem::path body{};           ///< a mesh; empty: none
    std::filesystem::path fabric{};         ///< F.fabric.toml
    std::filesystem::path back{};           ///< F.fabric.toml seen from behind; empty: its own back
    std::filesystem::path pattern{};        ///< a picture printed on the garment; empty: none
    double pattern_width = 0.64;            ///< of the picture, metres of cloth
    std::vector<PanelCloth> panels{};       ///< of the garment; they keep their own dyes
    std::optional<double> tolerance{};      ///< metres; in place of `level`, see SubdivideOptions
    std::optional<double> tolerance_px{};   ///< pixels; in place of `level`, see ViewTolerance
    std::optional<double> invented_grain{}; ///< of a garment without UV, see FrameOptions
    garment::SeamOptions seams{};           ///< of garment and body
    std::optional<double> metres_per_uv{};  ///< of the garment, see garment::Options
    double max_degenerate_area = 0.05;      ///< of the garment, see FrameOptions
    bool strict = false;                    ///< a warning about the garment is an Error
    std::string unit = "m";                 ///< of garment and body, see garment::metres_per
    bool unit_stated = false;               ///< see garment::Options
    std::optional<garment::UpAxis> up{};    ///< of garment and body, see garment::Options
    int level = 1;                          ///< of subdivision, 0 to 8
    /// One row of the sheet each, see parse_dye. Empty: the fabric's own dye. One render serves all
    /// of them where its channels can be depths of dye, see dye_variables; else each has its own.
    std::vector<std::string> dyes{"white", "crimson"};
    bool wavelengths = false;            ///< channels are wavelengths, one render a dye
    bool keeps_own_dye = false;          ///< a dyed fabric has its own dye in place of `dyes`
    std::string studio = kDefaultStudio; ///< see make_studio
    std::vector<std::string> lamps{"D65", "HP4", "A"}; ///< see parse_picture_lamps
    /// Which of several spectra the files of lamps and dyes hold, where a spec does not say so
    std::string column{};
    double azimuth_deg = 25;   ///< of the camera: 0 sees the garment's front (+z), 90 its left (+x)
    bool orthographic = false; ///< parallel rays, see Framing
    std::optional<Lens> lens{}; ///< focused on the garment unless it says where; empty: all sharp
    int width = 800;
    int height = 1000;
    /// Pictures of one sample per pixel are never denoised.
    RenderSettings render{.stop = kTryOnQuality, .denoise = true, .widen_after_diffuse = true};
    TableCache cache{}; ///< of the fabrics' tables
    DisplayOptions look = default_look();
    bool page = false; ///< also make the live page; without frames only
    /// The exposure of all pictures is metered on the garment, see ExposureMeter, in place of the
    /// look's.
    bool metered = false;
    /// false: nothing stands behind garment and body, and the pictures have alpha, see
    /// RenderSettings::alpha
    bool backdrop = true;
    std::filesystem::path output{};        ///< a folder; made where it is missing
    SampleType samples = SampleType::half; ///< of the light transport in files
    /// Keeps renders in it that are complete and of the same scene and settings; their pictures are
    /// written again.
    bool resume = false;
    int video_fps = 0; ///< frames per second of a video of each sequence, see video.h; 0: none
};

/// The sample dress on its dress form in the sample satin. `output` is left to the caller. Throws
/// Error as find_fabric.
TryOn sample_try_on(const std::filesystem::path &data);

/// A scene with what is found about its garment.
struct TryOnScene {
    Scene scene{};
    std::vector<std::string> own_lamps{}; ///< of the scene's light groups, see note_own_lamps
    garment::Report report{};
};

/// The studio of a try-on with the fabric's own dye: the camera in front frames the garment, the
/// lights of the studio stand about it, everything scales with the garment. Without another studio
/// a softbox from the left of the picture and a weaker one from its right are the light group
/// `key`, a weak uniform light from everywhere is the group `fill`. The garment's fabric is the
/// first. Throws Error for files that cannot be read, and Interrupted.
TryOnScene make_try_on_scene(const TryOn &job, const Progress &progress = {});

/// Renders the scene of a try-on with the AOV `garment` beside those of the settings: compare_lamps
/// and ExposureMeter look at it. Throws Error as render.
/// \param prepared see render
RenderResult render_try_on(const Scene &scene, const RenderSettings &settings,
                           const Progress &progress = {}, PreparedScene *prepared = nullptr);

/// What a try-on made.
struct TryOnResult {
    std::vector<std::filesystem::path> files{}; ///< in the order of their making
    std::vector<RenderStats> stats{};           ///< one a render
    std::vector<Problem> warnings{};         ///< of the renders and of files of spectra, each once
    std::vector<PackingError> page_errors{}; ///< of the live page, one a dress
    garment::Report report{};
    double exposure_stops = 0; ///< of the pictures
    bool interrupted = false;
};

/// Renders once for all dyes or for each, and writes into the output folder `DYE.exr` (light
/// transport, with the AOV `garment`), `DYE-LAMP.png` for each lamp, and
/// `sheet.png`; with `page` also `page.html`, which shows any lamp, and any dye where one render
/// serves all. With frames or a turntable, each dye and frame gives `DYE-0000.exr` and
/// `DYE-LAMP-0000.png`, and neither sheet nor page; where they are wanted, also `DYE-LAMP.mp4`.
/// Where progress.stop becomes true, what is done is still written, without sheet and page. Throws
/// Error with nothing written for any wrong value of the job.
TryOnResult run(const TryOn &job, const Progress &progress = {});

/// The files in the output folder that have the names of results, which `run` may replace. How many
/// frames there are is not looked up: all numbers count.
std::vector<std::filesystem::path> replaced_files(const TryOn &job);

} // namespace tsuya::scene
