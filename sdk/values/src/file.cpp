#include "tsuya/sdk/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include "tsuya/sdk/error.h"

namespace tsuya {

std::string read_file(const std::filesystem::path &file) {
    std::error_code code;
    if (std::filesystem::is_directory(file, code))
        throw Error({"it is a folder", file.string(), "expected a file"});
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw Error(
            {std::string("the file cannot be opened: ") + std::strerror(errno), file.string(), ""});
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (in.bad())
        throw Error({"the file cannot be read", file.string(), ""});
    return bytes;
}

std::filesystem::path temporary_name(const std::filesystem::path &file) {
    std::filesystem::path name = file;
    name.replace_filename("." + file.stem().string() + "." + std::to_string(getpid()) + ".part" +
                          file.extension().string());
    return name;
}

void write_file(const std::filesystem::path &file, std::string_view bytes) {
    const std::filesystem::path part = temporary_name(file);
    std::ofstream out(part, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    std::error_code code;
    if (out)
        std::filesystem::rename(part, file, code);
    if (!out || code) {
        const std::string reason = code ? code.message() : std::strerror(errno);
        std::filesystem::remove(part, code);
        throw Error({"the file cannot be written: " + reason, file.string(),
                     "expected a folder that exists and may be written to"});
    }
}

} // namespace tsuya
