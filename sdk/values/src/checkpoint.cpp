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
                                   const Fingerprint &fingerprint)
    : file_(file) {
    file_.write(first_line(kind));
    value(fingerprint.input);
    value(fingerprint.settings);
    write_checksum();
}

void CheckpointWriter::write(const char *from, std::size_t size) {
    file_.write({from, size});
    hasher_.bytes(from, size);
}

void CheckpointWriter::write_checksum() {
    const std::uint64_t checksum = hasher_.result();
    file_.write({reinterpret_cast<const char *>(&checksum), sizeof checksum});
}

void CheckpointWriter::commit() {
    write_checksum();
    file_.commit();
}

CheckpointReader::CheckpointReader(const std::filesystem::path &file, std::string_view kind,
                                   const Fingerprint &fingerprint)
    : path_(file), in_(file, std::ios::binary) {
    const std::string expected = first_line(kind);
    std::string line(expected.size(), '\0');
    if (!in_.read(line.data(), static_cast<std::streamsize>(line.size())) || line != expected)
        throw Error({"the file is no checkpoint of " + std::string(kind), file.string(),
                     std::string("expected what an interrupted run left; ") + kAnew});
    Fingerprint found;
    value(found.input);
    value(found.settings);
    check_checksum("fingerprint");
    if (found == fingerprint)
        return;
    const bool input = found.input != fingerprint.input,
               settings = found.settings != fingerprint.settings;
    throw Error({std::string("the checkpoint is of other ") + (input ? "input" : "") +
                     (input && settings ? " and other " : "") + (settings ? "settings" : ""),
                 file.string(),
                 std::string("expected the same as in the interrupted run; ") + kAnew});
}

void CheckpointReader::refuse_damage(const std::string &what) const {
    throw Error({"the checkpoint is damaged: " + what, path_.string(), kAnew});
}

void CheckpointReader::read(char *to, std::size_t size) {
    if (!in_.read(to, static_cast<std::streamsize>(size)))
        refuse_damage("it is cut off");
    hasher_.bytes(to, size);
}

void CheckpointReader::check_checksum(const char *of) {
    const std::uint64_t expected = hasher_.result();
    std::uint64_t found = 0;
    if (!in_.read(reinterpret_cast<char *>(&found), sizeof found))
        refuse_damage("it is cut off");
    if (found != expected)
        refuse_damage(std::string("the checksum of its ") + of + " is wrong");
}

void CheckpointReader::finish() {
    check_checksum("numbers");
    if (in_.peek() != std::ifstream::traits_type::eof())
        refuse_damage("it is longer than its content");
}

} // namespace tsuya::detail
