#include "pictures.h"

#include <dlfcn.h>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// \param entry the function that gives the part; \param needs what the module stands on
template <class Part> const Part &load(const char *name, const char *entry, const char *needs) {
    // Found by the run path that programs get from the package. It stays loaded to the end.
    void *const module = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    void *const make = module ? dlsym(module, entry) : nullptr;
    if (!make) {
        const char *const cause = dlerror();
        throw Error({std::string("the module for pictures cannot be loaded: ") +
                         (cause ? cause : "unknown cause"),
                     name,
                     std::string("expected in lib/tsuya of the installation, with ") + needs});
    }
    return *reinterpret_cast<const Part *(*)()>(make)();
}

} // namespace

const PictureWriter &picture_writer() {
    static const PictureWriter &loaded =
        load<PictureWriter>("libtsuya_picture_writer.so", "tsuya_picture_writer",
                            "OpenEXR 3.1, libpng, zlib and FreeType");
    return loaded;
}

const PictureReader &picture_reader() {
    static const PictureReader &loaded = load<PictureReader>(
        "libtsuya_picture_reader.so", "tsuya_picture_reader", "OpenImageIO 2.4");
    return loaded;
}

} // namespace tsuya
