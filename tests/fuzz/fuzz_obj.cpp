// OBJ from any bytes: a mesh or an Error.

#include <cstdint>

#include "fuzz_load.h"
#include "tsuya/garment/obj.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    using namespace tsuya::garment;
    test::fuzz_load({data, size}, [&] {
        return MeshFile{.mesh =
                            parse_obj({reinterpret_cast<const char *>(data), size}, "fuzz.obj")};
    });
    return 0;
}
