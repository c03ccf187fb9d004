#include "table_input.h"

#include "tsuya/sdk/table_warnings.h"

namespace tsuya::program {

ReflectanceFile read_table(const std::filesystem::path &file, Console &console) {
    ReflectanceFile read = read_reflectance_file(file);
    for (const std::string &warning : read.warnings)
        console.warning(file.string() + ": " + warning);
    for (const TableChannel &channel : read.channels) {
        const std::string of = channel.name.empty() ? "" : ": channel " + channel.name;
        for (const std::string &warning : table_warnings(channel.table))
            console.warning(file.string() + of + ": " + warning);
    }
    return read;
}

ReflectanceTable read_single_table(const std::filesystem::path &file, Console &console) {
    ReflectanceFile read = read_table(file, console);
    check_single_channel(read, file.string());
    return std::move(read.channels.front().table);
}

} // namespace tsuya::program
