// A session whose computer loses its power: what power_cut_test.sh runs in a virtual machine.
// power_cut_session run FOLDER DEVICE SECTOR    a whole session in FOLDER; each exposure is also
//                                               marked on the raw disk, from SECTOR on
// power_cut_session resume FOLDER DEVICE SECTOR what the disk has after the cut, against the marks;
//                                               then the rest of the session
#include "lab/session_bed.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSector = 512;

/// Marks that a cut cannot undo: one sector each, past the end of the file system.
class Marks {
  public:
    Marks(const char *device, const char *sector) : first_(std::atol(sector)) {
        descriptor_ = open(device, O_RDWR | O_DIRECT | O_CLOEXEC);
        if (descriptor_ < 0 || posix_memalign(&buffer_, 4096, kSector) != 0)
            throw Error({std::strerror(errno), device});
    }
    Marks(const Marks &) = delete;
    Marks &operator=(const Marks &) = delete;
    ~Marks() {
        std::free(buffer_);
        close(descriptor_);
    }

    void add(std::optional<std::size_t> frame) {
        std::memset(buffer_, 0, kSector);
        std::snprintf(static_cast<char *>(buffer_), kSector, "open %s",
                      frame ? std::to_string(*frame).c_str() : "white");
        if (pwrite(descriptor_, buffer_, kSector, place(count_++)) != ssize_t{kSector})
            throw Error({"a mark cannot be written"});
    }
    /// `open FRAME` or `open white`, in order.
    std::vector<std::string> all() const {
        std::vector<std::string> marks;
        const char *const text = static_cast<const char *>(buffer_);
        while (pread(descriptor_, buffer_, kSector, place(marks.size())) == ssize_t{kSector} &&
               *text != '\0')
            marks.emplace_back(text);
        return marks;
    }

  private:
    off_t place(std::size_t i) const {
        return static_cast<off_t>(kSector) * (first_ + static_cast<off_t>(i));
    }

    off_t first_;
    int descriptor_ = -1;
    void *buffer_ = nullptr;
    std::size_t count_ = 0;
};

/// Rig, plan and session in a folder.
struct Place {
    explicit Place(const fs::path &folder)
        : rig_file(folder / "small.rig.toml"), plan_file(folder / "small.plan.jsonl"),
          session(folder / "session"), logs{.lamp_log = folder / "lamp.log",
                                            .fault_log = folder / "faults.jsonl",
                                            .wait = true} {}
    fs::path rig_file, plan_file, session;
    SessionSettings logs;
};

void create(const Place &place) {
    write_file(place.rig_file, kSmallRig);
    const RigFile rig = read_rig_file(place.rig_file);
    write_plan(make_plan(rig, {.directions = views_named("few:45", Symmetry::orthotropic),
                               .views = "few:45",
                               .rig = place.rig_file}),
               place.plan_file);
    create_session(place.session, place.plan_file, place.rig_file);
}

/// \param marks null after the cut
void run(const Place &place, double epoch_s, const std::string &boot, Marks *marks) {
    const RigFile rig = read_rig_file(place.session / "rig.toml");
    BedRun bed(rig, epoch_s, boot);
    if (marks)
        bed.camera.on_expose = [&](const Shot &shot) { marks->add(shot.number); };
    if (bed.run(place.session, rig, place.logs).missing() != 0)
        throw Error({"frames are missing after a run without faults"});
}

void need(bool good, const std::string &what) {
    if (!good)
        throw Error({what});
}

/// What must be on the disk by what was seen of the shutter before the cut.
void check_against(const std::vector<std::string> &marks, const Session &session) {
    std::vector<std::string> opened, counted;
    for (const JournalEvent &event : read_journal(session.folder / "journal.jsonl").events) {
        const std::string frame = event.frame ? std::to_string(*event.frame) : "white";
        if (event.kind == EventKind::open)
            opened.push_back("open " + frame);
        if (event.kind == EventKind::ok)
            counted.push_back("open " + frame);
    }
    const auto begin_alike = [&](const std::vector<std::string> &part,
                                 const std::vector<std::string> &whole) {
        return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
    };
    need(begin_alike(marks, opened),
         "the shutter opened and the journal does not know: " + std::to_string(marks.size()) +
             " exposures, " + std::to_string(opened.size()) + " in the journal");
    // No frame is exposed before the one before it counts for good.
    const std::vector<std::string> done(marks.begin(),
                                        marks.empty() ? marks.end() : marks.end() - 1);
    need(begin_alike(done, counted),
         "a frame was taken and does not count: " + std::to_string(done.size()) + " taken, " +
             std::to_string(counted.size()) + " count");
    for (const std::vector<CountedFrame> *frames : {&session.frames, &session.warm_up})
        for (const CountedFrame &frame : *frames)
            need(file_hash(frame.file) == frame.hash,
                 frame.file.string() + ": a frame that counts is not the picture that was taken");
}

void resume(const Place &place, const std::vector<std::string> &marks) {
    const Session before = read_session(place.session);
    check_against(marks, before);
    run(place, 1.7e9 + 1e5, "boot-2", nullptr);
    const Session after = read_session(place.session);
    need(after.missing.empty(), "frames are missing after the session was resumed");
    std::set<std::string> hashes;
    for (const CountedFrame &frame : after.frames) {
        need(hashes.insert(frame.hash).second, "a picture counts twice: " + frame.file.string());
        need(file_hash(frame.file) == frame.hash, "a picture changed: " + frame.file.string());
        const std::string number = " " + std::to_string(*frame.number) + " end\n";
        need(read_file(frame.file).ends_with(number), "no picture of its frame");
    }
    std::printf("%zu exposures before the cut, %zu frames counted, %zu after it, %zu put aside\n",
                marks.size(), before.frames.size(), after.frames.size(), after.rejected.size());
}

int main_of(int argc, char **argv) {
    if (argc != 5)
        return 2;
    try {
        const Place place(argv[2]);
        Marks marks(argv[3], argv[4]);
        if (std::string_view(argv[1]) == "run") {
            create(place);
            run(place, 1.7e9, "boot-1", &marks);
        } else {
            resume(place, marks.all());
        }
        return 0;
    } catch (const Error &error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}

} // namespace
} // namespace tsuya::lab

int main(int argc, char **argv) { return tsuya::lab::main_of(argc, argv); }
