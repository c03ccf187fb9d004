#include "pictures/oiio_input.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <tbb/task_arena.h>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

std::string one_line(const std::string &text) {
    constexpr const char *kNoCause = "PNG library error"; // follows the cause
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    std::string all;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool told = all.find(lines[i]) != std::string::npos ||
                          std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                      lines.end(), [&](const std::string &later) {
                                          return later.find(lines[i]) != std::string::npos;
                                      });
        if (!told && lines[i] != kNoCause)
            all += (all.empty() ? "" : "; ") + lines[i];
    }
    return all.empty() ? "unknown cause" : all;
}

void use_threads_of_arena() {
    const int threads = tbb::this_task_arena::max_concurrency();
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads);
}

namespace {

[[noreturn]] void fail_opening(const std::string &cause, const std::string &name) {
    throw Error({"cannot read the picture: " + one_line(cause), name,
                 "expected a picture such as PNG, JPEG, TIFF or EXR"});
}

/// \param input open
std::unique_ptr<OIIO::ImageInput> flat_picture(std::unique_ptr<OIIO::ImageInput> input,
                                               const std::string &name) {
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.deep || spec.depth > 1)
        throw Error({"the picture is deep or a volume", name, "expected a flat picture"});
    return input;
}

} // namespace

std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path &path,
                                               const OIIO::ImageSpec *config) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw Error({std::filesystem::exists(path, ignored) ? "it is no regular file"
                                                            : "there is no such file",
                     path.string(), "expected a readable picture"});
    use_threads_of_arena();
    auto input = OIIO::ImageInput::open(path.string(), config);
    if (!input)
        fail_opening(OIIO::geterror(), path.string());
    return flat_picture(std::move(input), path.string());
}

std::unique_ptr<OIIO::ImageInput> open_png(OIIO::Filesystem::IOProxy &bytes,
                                           const std::string &name, const OIIO::ImageSpec &config) {
    use_threads_of_arena();
    auto input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec spec;
    if (!input || !input->set_ioproxy(&bytes))
        fail_opening(OIIO::geterror(), name);
    if (!input->open("", spec, config))
        fail_opening(input->geterror(), name);
    return flat_picture(std::move(input), name);
}

void need_memory_for(const std::filesystem::path &path, const OIIO::ImageSpec &spec, int rows,
                     std::size_t bytes_a_sample) {
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    detail::need_memory(static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(rows) *
                            channels * bytes_a_sample,
                        std::to_string(spec.width) + " x " + std::to_string(rows) + " pixels of " +
                            detail::counted(channels, "channel"),
                        path.string(), "expected a smaller picture");
}

void fail_reading(const std::filesystem::path &path, const std::string &cause) {
    throw Error({"cannot read the picture: " + one_line(cause), path.string(),
                 "expected a complete picture"});
}

} // namespace tsuya
