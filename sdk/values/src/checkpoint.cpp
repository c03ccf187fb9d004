#include "tsuya/sdk/detail/checkpoint.h"

#include "tsuya/sdk/error.h"

namespace tsuya::detail {
namespace {

constexpr const char *kAnew = "remove it to start anew";

std::string first_line(std::string_view kind) {
    return "tsuya-checkpoint " + std::string(kind) + "\n";
}

} // namespace

CheckpointWriter::CheckpointWriter(const std::filesystem::path &file, std::string_view kind,
                                   std::uint64_t fingerprint)
    : file_(file) {
    file_.write(first_line(kind));
    value(fingerprint);
}

CheckpointReader::CheckpointReader(const std::filesystem::path &file, std::string_view kind,
                                   std::uint64_t fingerprint)
    : path_(file), in_(file, std::ios::binary) {
    const std::string expected = first_line(kind);
    std::string found(expected.size(), '\0');
    if (!in_.read(found.data(), static_cast<std::streamsize>(found.size())) || found != expected)
        throw Error({"the file is no checkpoint of " + std::string(kind), file.string(),
                     std::string("expected what an interrupted run left; ") + kAnew});
    std::uint64_t print = 0;
    value(print);
    if (print != fingerprint)
        throw Error({"the checkpoint is of other input or other settings, or damaged",
                     file.string(),
                     std::string("expected the same as in the interrupted run; ") + kAnew});
}

void CheckpointReader::read(char *to, std::size_t size) {
    if (!in_.read(to, static_cast<std::streamsize>(size)))
        throw Error({"the checkpoint is cut off", path_.string(), kAnew});
}

void CheckpointReader::finish() {
    if (in_.peek() != std::ifstream::traits_type::eof())
        throw Error({"the checkpoint is longer than its content", path_.string(), kAnew});
}

} // namespace tsuya::detail
