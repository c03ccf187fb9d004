#include "tsuya/lab/cameras.h"

#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace tsuya::lab {
namespace {

namespace fs = std::filesystem;
using std::chrono::nanoseconds;

constexpr Seconds kLook{0.1}; // at the folder where pictures arrive

/// Also from one disk to another.
void move_file(const fs::path &from, const fs::path &to) {
    std::error_code code;
    fs::rename(from, to, code);
    if (!code)
        return;
    fs::copy_file(from, to, code);
    if (code)
        throw Error({"the picture cannot be moved to the session: " + code.message(), from.string(),
                     "expected space on the disk"});
    fs::remove(from, code);
}

} // namespace

CommandCamera::CommandCamera(const RigCamera &camera, Clock &clock, CommandRun how)
    : camera_(camera), clock_(clock), how_(std::move(how)) {
    how_.timeout = camera.timeout;
}

void CommandCamera::expose(const Shot &shot) {
    CommandRun how = how_;
    how.timeout += Seconds(shot.planned.exposure_s);
    run_command(filled_in(camera_.command, {{"file", shot.file.string()},
                                            {"exposure", number_text(shot.planned.exposure_s)}}),
                clock_, how);
}

TriggeredCamera::TriggeredCamera(const RigCamera &camera, Clock &clock,
                                 const std::atomic<bool> *stop)
    : camera_(camera), clock_(clock), stop_(stop) {}

void TriggeredCamera::sleep(Seconds time) {
    if (!clock_.sleep_until(clock_.now() + std::chrono::round<nanoseconds>(time), stop_))
        throw Interrupted("stopped while a picture was taken");
}

/// The pictures in the watched folder. A camera that also writes small ones has other extensions.
std::map<fs::path, std::uintmax_t> TriggeredCamera::pictures() const {
    std::map<fs::path, std::uintmax_t> sizes;
    std::error_code code;
    for (const auto &entry : fs::directory_iterator(camera_.watch_folder, code)) {
        std::string extension = entry.path().extension().string();
        std::transform(
            extension.begin(), extension.end(), extension.begin(),
            [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
        if (extension == "." + camera_.extension && entry.is_regular_file(code))
            sizes[entry.path()] = entry.file_size(code);
    }
    return sizes;
}

void TriggeredCamera::expose(const Shot &shot) {
    before_ = pictures();
    sleep(Seconds(shot.planned.exposure_s));
}

void TriggeredCamera::collect(const Shot &shot) {
    const nanoseconds deadline = clock_.now() + std::chrono::round<nanoseconds>(camera_.timeout);
    for (std::map<fs::path, std::uintmax_t> last;;) {
        std::map<fs::path, std::uintmax_t> arrived = pictures();
        for (const auto &[picture, size] : before_)
            arrived.erase(picture);
        if (arrived.size() == 1 && arrived == last && arrived.begin()->second > 0)
            return move_file(arrived.begin()->first, shot.file);
        if (clock_.now() >= deadline)
            throw Error({detail::counted(arrived.size(), "picture") + " arrived",
                         camera_.watch_folder.string(),
                         "expected one within the camera's timeout_s"});
        last = std::move(arrived);
        sleep(kLook);
    }
}

} // namespace tsuya::lab
