#include "tsuya/sdk/detail/build_identity.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <link.h>

namespace tsuya::detail {
namespace {

struct Wanted {
    std::uintptr_t address; // of code
    std::string identity{};
};

bool holds(const dl_phdr_info &object, std::uintptr_t address) {
    return std::any_of(object.dlpi_phdr, object.dlpi_phdr + object.dlpi_phnum, [&](const auto &h) {
        const std::uintptr_t begin = object.dlpi_addr + h.p_vaddr;
        return h.p_type == PT_LOAD && address >= begin && address < begin + h.p_memsz;
    });
}

// The description of the note NT_GNU_BUILD_ID as hexadecimal digits; empty where there is none.
std::string build_id(const char *note, std::size_t size) {
    const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
    while (size >= sizeof(ElfW(Nhdr))) {
        ElfW(Nhdr) head;
        std::memcpy(&head, note, sizeof head);
        const char *const name = note + sizeof head;
        const std::size_t whole = sizeof head + padded(head.n_namesz) + padded(head.n_descsz);
        if (whole > size)
            break;
        if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 &&
            std::memcmp(name, "GNU", 4) == 0) {
            std::string digits;
            for (std::size_t i = 0; i < head.n_descsz; ++i) {
                const auto byte = static_cast<unsigned char>(name[4 + i]);
                digits += "0123456789abcdef"[byte / 16];
                digits += "0123456789abcdef"[byte % 16];
            }
            return digits;
        }
        note += whole;
        size -= whole;
    }
    return {};
}

int look_at(dl_phdr_info *object, std::size_t, void *data) {
    Wanted &wanted = *static_cast<Wanted *>(data);
    if (!holds(*object, wanted.address))
        return 0;
    for (int i = 0; i < object->dlpi_phnum && wanted.identity.empty(); ++i)
        if (const auto &h = object->dlpi_phdr[i]; h.p_type == PT_NOTE)
            wanted.identity =
                build_id(reinterpret_cast<const char *>(object->dlpi_addr + h.p_vaddr), h.p_memsz);
    return 1;
}

std::string vector_instructions() {
    std::string names;
#if defined(__x86_64__)
    for (const auto &[name, has] : {std::pair(" avx2", __builtin_cpu_supports("avx2")),
                                    std::pair(" fma", __builtin_cpu_supports("fma")),
                                    std::pair(" avx512f", __builtin_cpu_supports("avx512f")),
                                    std::pair(" avx512vl", __builtin_cpu_supports("avx512vl"))})
        if (has)
            names += name;
#endif
    return names;
}

} // namespace

std::string build_identity() {
    Wanted wanted{.address = reinterpret_cast<std::uintptr_t>(&build_identity)};
    dl_iterate_phdr(look_at, &wanted);
    return wanted.identity.empty() ? "" : wanted.identity + vector_instructions();
}

} // namespace tsuya::detail
