#include "frame_store.h"

#include "tsuya/lab/number_text.h"

#include <chrono>
#include <cmath>
#include <cstdio>

namespace tsuya::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook{50}; // at a picture that may still grow

std::string numbered(const char *format, std::size_t number, const std::string &extension) {
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text + ("." + extension);
}

std::uintmax_t size_of(const fs::path &file) {
    std::error_code code;
    const std::uintmax_t size = fs::file_size(file, code);
    if (code)
        throw Error({"no picture came", file.string(), "expected one from the camera"});
    return size;
}

} // namespace

FrameStore::FrameStore(const Session &session, const RigCamera &camera, const FrameReader &read,
                       SafetyClock &clock, SessionJournal &journal)
    : folder_(session.folder), camera_(camera), read_(read), clock_(clock), journal_(journal) {
    for (const std::vector<CountedFrame> *frames : {&session.frames, &session.warm_up})
        for (const CountedFrame &frame : *frames)
            keep(frame.hash);
}

fs::path FrameStore::place_for(std::optional<std::size_t> number) {
    const fs::path frames = folder_ / "frames";
    if (!number) {
        fs::path file;
        do
            file = frames / numbered("white-%04zu", next_beside_++, camera_.extension);
        while (fs::exists(file));
        return file;
    }
    fs::path file = frames / numbered("%06zu", *number, camera_.extension);
    if (fs::exists(file))
        reject(number, file, "it was taken by a run that ended before it was confirmed");
    return file;
}

void FrameStore::wait_until_complete(const fs::path &file, const std::atomic<bool> *stop) {
    const auto deadline =
        clock_.now() + std::chrono::round<std::chrono::nanoseconds>(camera_.timeout);
    std::uintmax_t size = size_of(file);
    for (std::uintmax_t before = size + 1; size == 0 || size != before;) {
        if (clock_.now() >= deadline)
            throw Error({size == 0 ? "the picture is empty" : "the picture does not stop growing",
                         file.string(), "expected a whole one in the camera's timeout_s"});
        if (!clock_.sleep_until(clock_.now() + kLook, stop))
            throw Interrupted("stopped while a picture was waited for");
        before = size;
        size = size_of(file);
    }
}

FrameStore::Checked FrameStore::check(const Shot &shot, const std::atomic<bool> *stop) {
    wait_until_complete(shot.file, stop);
    journal_.note({.kind = EventKind::file,
                   .frame = shot.number,
                   .texts = {{"file", name_of(shot.file)}},
                   .numbers = {{"bytes", static_cast<double>(size_of(shot.file))}}});
    Checked checked{.facts = read_(shot.file, camera_, shot.planned.directions.theta_r),
                    .hash = file_hash(shot.file)};
    if (hashes_.contains(checked.hash))
        throw Error({"the picture is a copy of an earlier one", shot.file.string(),
                     "expected a new one from the camera"});
    const double planned = shot.planned.exposure_s;
    const double exposure = checked.facts.exposure_s.value_or(planned);
    if (!(std::abs(exposure - planned) <= kExposureTolerance * planned))
        throw Error({"the picture was exposed for " + number_text(exposure) + " s",
                     shot.file.string(), "expected " + number_text(planned) + " s within 10 %"});
    sync_file(shot.file);
    sync_folder(shot.file.parent_path());
    return checked;
}

void FrameStore::reject(std::optional<std::size_t> number, const fs::path &file,
                        const std::string &why) {
    JournalEvent event{
        .kind = EventKind::reject, .frame = number, .texts = {{"why", why}, {"file", ""}}};
    if (fs::exists(file)) {
        fs::path aside;
        for (std::size_t i = 1; aside.empty() || fs::exists(aside); ++i)
            aside = folder_ / "rejected" /
                    (file.stem().string() + "-" + std::to_string(i) + file.extension().string());
        fs::rename(file, aside);
        event.texts["file"] = name_of(aside);
    }
    journal_.note_lasting(std::move(event));
}

std::string FrameStore::name_of(const fs::path &file) const {
    return file.lexically_relative(folder_).generic_string();
}

} // namespace tsuya::lab
