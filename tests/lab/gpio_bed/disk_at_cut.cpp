// The disk of a virtual machine as it is after its power was cut, from the log of what was written.
// disk_at_cut LOG DISK marks SECTOR     places in the log of each write from SECTOR on, one a line,
//                                       and the log's length at last
// disk_at_cut LOG DISK cut AT SECTOR SEED   makes DISK, as it was before the log, what it is after
//                                       the first AT entries. Of the writes after the last flush
//                                       the disk's own memory loses all for SEED 0, else some.
//                                       Those from SECTOR on are kept.
// The log is that of QEMU's driver blklogwrites: the format of Linux's dm-log-writes.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr std::uint64_t kSector = 512;
constexpr std::uint64_t kMagic = 0x6a736677736872;
constexpr std::uint64_t kFlush = 1, kAtOnce = 2, kDiscard = 4;

/// As it lies in the file, at the beginning of a sector.
struct Entry {
    std::uint64_t sector, sectors, flags, text_length;
};
struct Head {
    std::uint64_t magic, version, entries;
    std::uint32_t sector_size;
};

struct Write {
    Entry entry{};
    std::string data{};
};

std::vector<Write> read_log(const char *name) {
    std::ifstream file(name, std::ios::binary);
    const auto read_sector = [&](auto &value) {
        char sector[kSector];
        file.read(sector, kSector);
        std::memcpy(&value, sector, sizeof value);
        return static_cast<bool>(file);
    };
    Head head{};
    if (!read_sector(head) || head.magic != kMagic || head.sector_size != kSector)
        throw std::runtime_error(std::string(name) +
                                 ": no log of a disk with sectors of 512 bytes");
    std::vector<Write> log;
    for (Entry entry{}; read_sector(entry);) {
        Write write{.entry = entry};
        if ((entry.flags & kDiscard) == 0) {
            write.data.resize(entry.sectors * kSector);
            file.read(write.data.data(), static_cast<std::streamsize>(write.data.size()));
        }
        if (file)
            log.push_back(std::move(write));
    }
    return log;
}

void apply(const Write &write, std::fstream &disk) {
    if (write.data.empty())
        return; // of what is discarded, the old bytes may stay
    disk.seekp(static_cast<std::streamoff>(write.entry.sector * kSector));
    disk.write(write.data.data(), static_cast<std::streamsize>(write.data.size()));
}

void cut(const std::vector<Write> &log, std::size_t at, std::uint64_t kept, unsigned seed,
         std::fstream &disk) {
    std::size_t flushed = 0;
    for (std::size_t i = 0; i < at; ++i)
        if ((log[i].entry.flags & kFlush) != 0)
            flushed = i + 1;
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < at; ++i) {
        const bool by_chance = seed != 0 && random() % 2 == 0;
        if (i < flushed || by_chance || log[i].entry.sector >= kept ||
            (log[i].entry.flags & kAtOnce) != 0)
            apply(log[i], disk);
    }
}

} // namespace

int main(int argc, char **argv) {
    try {
        if (argc < 5)
            return 2;
        const std::vector<Write> log = read_log(argv[1]);
        if (std::string(argv[3]) == "marks") {
            const std::uint64_t first = std::strtoull(argv[4], nullptr, 10);
            for (std::size_t i = 0; i < log.size(); ++i)
                if (log[i].entry.sector >= first)
                    std::printf("%zu\n", i + 1);
            std::printf("%zu\n", log.size());
            return 0;
        }
        if (argc != 7)
            return 2;
        std::fstream disk(argv[2], std::ios::binary | std::ios::in | std::ios::out);
        cut(log, std::min<std::size_t>(std::strtoull(argv[4], nullptr, 10), log.size()),
            std::strtoull(argv[5], nullptr, 10),
            static_cast<unsigned>(std::strtoul(argv[6], nullptr, 10)), disk);
        disk.flush();
        if (!disk)
            throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "disk_at_cut: %s\n", error.what());
        return 1;
    }
}
