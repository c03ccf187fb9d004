#pragma once
/// \file
/// The pictures of a session: where they stand, whether they are good, and what is put aside.

#include <set>

#include "session_journal.h"
#include "tsuya/lab/frame_camera.h"
#include "tsuya/lab/safety.h"
#include "tsuya/lab/session.h"

namespace tsuya::lab {

class FrameStore {
  public:
    FrameStore(const Session &session, const RigCamera &camera, const FrameReader &read,
               SafetyClock &clock, SessionJournal &journal);

    /// Where the picture of a frame, or the next one beside the plan, shall stand. A picture that
    /// stands there does not count, and is put aside.
    std::filesystem::path place_for(std::optional<std::size_t> number);
    /// Looks at a picture, and makes it lasting. Throws Error naming what is wrong with it.
    /// \return what it says, with its hash
    struct Checked {
        FrameFacts facts{};
        std::string hash{};
    };
    Checked check(const Shot &shot, const std::atomic<bool> *stop);
    /// The picture counts: no other may equal it.
    void keep(const std::string &hash) { hashes_.insert(hash); }
    /// Puts a picture aside, if there is one, with the reason in the journal.
    void reject(std::optional<std::size_t> number, const std::filesystem::path &file,
                const std::string &why);
    /// As the journal names it: relative to the session's folder.
    std::string name_of(const std::filesystem::path &file) const;

  private:
    void wait_until_complete(const std::filesystem::path &file, const std::atomic<bool> *stop);

    std::filesystem::path folder_;
    const RigCamera &camera_;
    const FrameReader &read_;
    SafetyClock &clock_;
    SessionJournal &journal_;
    std::set<std::string> hashes_{};
    std::size_t next_beside_ = 0;
};

} // namespace tsuya::lab
