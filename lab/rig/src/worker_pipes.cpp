#include "worker_pipes.h"

#include "tsuya/sdk/error.h"

#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tsuya::lab::detail {
namespace {

using Size = std::uint16_t;
constexpr std::size_t kHeader = 1 + sizeof(Size);
static_assert(WorkerPipes::kMaxPayload + kHeader <= PIPE_BUF);

} // namespace

WorkerPipes::WorkerPipes() {
    if (pipe2(from_worker_, O_CLOEXEC | O_NONBLOCK) != 0 ||
        pipe2(to_worker_, O_CLOEXEC | O_NONBLOCK) != 0)
        throw Error(
            {.what = "no pipe to a supervised process: " + std::generic_category().message(errno)});
}

WorkerPipes::~WorkerPipes() {
    for (int *ends : {from_worker_, to_worker_})
        for (int i = 0; i < 2; ++i)
            close_end(ends[i]);
}

void WorkerPipes::close_end(int &end) {
    if (end >= 0)
        close(end);
    end = -1;
}

void WorkerPipes::become_worker() {
    close_end(from_worker_[0]);
    close_end(to_worker_[1]);
}

void WorkerPipes::become_supervisor() {
    close_end(from_worker_[1]);
    close_end(to_worker_[0]);
}

void WorkerPipes::write(FrameKind kind, std::string_view payload, bool may_be_lost) {
    payload = payload.substr(0, kMaxPayload);
    const Size size = static_cast<Size>(payload.size());
    std::string frame(kHeader, static_cast<char>(kind));
    std::memcpy(frame.data() + 1, &size, sizeof size);
    frame += payload;
    while (::write(from_worker_[1], frame.data(), frame.size()) < 0) {
        if (errno != EINTR && (errno != EAGAIN || may_be_lost))
            return; // nobody listens any more, which stop_asked() tells
        pollfd room{.fd = from_worker_[1], .events = POLLOUT, .revents = 0};
        poll(&room, 1, -1);
    }
}

bool WorkerPipes::stop_asked() {
    char byte = 0;
    const ssize_t got = read(to_worker_[0], &byte, 1);
    return got >= 0 || (errno != EAGAIN && errno != EINTR);
}

void WorkerPipes::ask_to_stop() {
    const char byte = 1;
    // A worker that is gone is noticed at the end of its pipe.
    [[maybe_unused]] const ssize_t written = ::write(to_worker_[1], &byte, 1);
}

bool WorkerPipes::wait_and_read(int timeout_ms) {
    pollfd frames{.fd = from_worker_[0], .events = POLLIN, .revents = 0};
    poll(&frames, 1, timeout_ms);
    for (char part[PIPE_BUF];;) {
        const ssize_t got = read(from_worker_[0], part, sizeof part);
        if (got > 0)
            buffer_.append(part, static_cast<std::size_t>(got));
        else if (got == 0)
            return false;
        else if (errno != EINTR)
            return true;
    }
}

bool WorkerPipes::next(Frame &frame) {
    if (buffer_.size() < kHeader)
        return false;
    Size size = 0;
    std::memcpy(&size, buffer_.data() + 1, sizeof size);
    if (buffer_.size() < kHeader + size)
        return false;
    frame.kind = static_cast<FrameKind>(buffer_[0]);
    frame.payload = buffer_.substr(kHeader, size);
    buffer_.erase(0, kHeader + size);
    return true;
}

} // namespace tsuya::lab::detail
