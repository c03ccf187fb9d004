#include "files/interchange/importer.h"

#include <dlfcn.h>

#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

const Importer *load(std::string &cause) {
    // Found by the run path that programs get from the package. It stays loaded to the end.
    void *const module = dlopen("libtsuya_interchange.so", RTLD_NOW | RTLD_LOCAL);
    void *const make = module ? dlsym(module, "tsuya_importer") : nullptr;
    if (make)
        return reinterpret_cast<const Importer *(*)()>(make)();
    const char *const told = dlerror();
    cause = told ? told : "unknown cause";
    return nullptr;
}

} // namespace

const Importer &importer(const std::string &where) {
    static std::string cause;
    static const Importer *const loaded = load(cause);
    if (!loaded)
        throw Error({"the module that reads FBX, Collada and STL cannot be loaded: " + cause, where,
                     "expected a build with Assimp (libassimp-dev, CMake option TSUYA_ASSIMP), or "
                     "the mesh as .obj or .glb: garment/docs/EXPORT.md says how it is exported"});
    return *loaded;
}

} // namespace tsuya::garment
