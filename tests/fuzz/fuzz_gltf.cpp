// glTF and GLB from any bytes: a mesh or an Error.

#include <cstdint>

#include "fuzz_load.h"
#include "tsuya/garment/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    using namespace tsuya::garment;
    test::fuzz_load({data, size}, [&] {
        return parse_gltf({reinterpret_cast<const char *>(data), size}, "fuzz.glb");
    });
    return 0;
}
