#include "pictures.h"

#include <dlfcn.h>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr const char *kModule = "libtsuya_pictures.so";

const Pictures &load() {
    // Found by the run path that programs get from the package. It stays loaded to the end.
    void *const module = dlopen(kModule, RTLD_NOW | RTLD_LOCAL);
    void *const make = module ? dlsym(module, "tsuya_pictures") : nullptr;
    if (!make) {
        const char *const cause = dlerror();
        throw Error({std::string("the module for pictures cannot be loaded: ") +
                         (cause ? cause : "unknown cause"),
                     kModule, "expected in lib/tsuya of the installation, with OpenImageIO 2.4"});
    }
    return *reinterpret_cast<const Pictures *(*)()>(make)();
}

} // namespace

const Pictures &pictures() {
    static const Pictures &loaded = load();
    return loaded;
}

} // namespace tsuya
