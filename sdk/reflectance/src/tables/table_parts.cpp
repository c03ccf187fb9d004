#include "tsuya/sdk/detail/table_parts.h"

#include "tsuya/sdk/error.h"

namespace tsuya::detail {

void TableReader::need(std::size_t count) const {
    if (count > bytes_.size())
        throw Error({"the tables end too soon", "", ""});
}

const char *TableReader::take(std::size_t count, std::size_t size) {
    need(count);
    need(count * size);
    const char *const from = bytes_.data();
    bytes_.remove_prefix(count * size);
    return from;
}

} // namespace tsuya::detail
