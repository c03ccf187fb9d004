// PLY and OFF from any bytes: a mesh or an Error. What begins as an OFF file is read as one.

#include <cstdint>

#include "fuzz_load.h"
#include "tsuya/garment/ply.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    using namespace tsuya::garment;
    const std::string_view bytes(reinterpret_cast<const char *>(data), size);
    const bool off = bytes.substr(0, bytes.find('\n')).find("OFF") != bytes.npos;
    test::fuzz_load({data, size}, [&] {
        return MeshFile{.mesh = off ? parse_off(bytes, "fuzz.off") : parse_ply(bytes, "fuzz.ply")};
    });
    return 0;
}
