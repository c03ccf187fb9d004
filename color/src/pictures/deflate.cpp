// Compressed bytes, by zlib.

#include <limits>
#include <string>

#include <zlib.h>

#include "pictures/writer_parts.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

std::string deflate_bytes(std::string_view bytes) {
    if (bytes.size() > std::numeric_limits<uInt>::max())
        throw Error({std::to_string(bytes.size()) + " bytes to compress", "compressed bytes",
                     "expected less than 4 GB: a smaller picture"});
    constexpr int kWindowBits = 15, kMemory = 9; // the largest
    z_stream stream{};
    // Differences from neighbours: short matches are chance.
    int status =
        deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowBits, kMemory, Z_FILTERED);
    std::string compressed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    stream.next_in = const_cast<Bytef *>(reinterpret_cast<const Bytef *>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef *>(compressed.data());
    stream.avail_out = static_cast<uInt>(compressed.size());
    if (status == Z_OK)
        status = deflate(&stream, Z_FINISH);
    compressed.resize(stream.total_out);
    deflateEnd(&stream);
    if (status != Z_STREAM_END)
        throw Error({"zlib: status " + std::to_string(status), "compressed bytes",
                     "expected enough memory"});
    return compressed;
}

} // namespace tsuya
