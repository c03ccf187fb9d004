// libpng tells an error to OpenImageIO, which tells it to us, and then writes it to stderr as well:
// OpenImageIO 2.4 returns from its handler, where libpng wants it to leave by a jump. Its calls of
// png_set_error_fn come here, because the loader looks into a module before it looks into the
// libraries of the module.

#include <map>
#include <mutex>

#include <dlfcn.h>

namespace {

// As in png.h, which the packages of OpenImageIO need not bring along
using Report = void (*)(void *png, const char *message);
using SetErrorFn = void (*)(void *png, void *user, Report error, Report warning);
using Jump = void (*)(void *png, int value);

/// Who is told of errors, by the picture.
class Handlers {
  public:
    void set(void *png, Report handler) {
        const std::lock_guard lock(mutex_);
        of_[png] = handler;
    }
    Report of(void *png) {
        const std::lock_guard lock(mutex_);
        return of_[png];
    }

  private:
    std::mutex mutex_{};
    std::map<void *, Report> of_{};
};

Handlers &handlers() {
    static Handlers all;
    return all;
}

void tell_and_jump(void *png, const char *message) {
    static const auto jump = reinterpret_cast<Jump>(dlsym(RTLD_NEXT, "png_longjmp"));
    if (const Report told = handlers().of(png))
        told(png, message);
    if (jump)
        jump(png, 1);
}

} // namespace

extern "C" [[gnu::visibility("default")]] void png_set_error_fn(void *png, void *user, Report error,
                                                                Report warning) {
    static const auto set = reinterpret_cast<SetErrorFn>(dlsym(RTLD_NEXT, "png_set_error_fn"));
    if (!set)
        return;
    if (error)
        handlers().set(png, error);
    set(png, user, error ? tell_and_jump : nullptr, warning);
}
