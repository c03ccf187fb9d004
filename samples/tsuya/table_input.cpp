#include "table_input.h"

#include <algorithm>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
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

ReflectanceTable read_channel(const std::filesystem::path &file, const std::string &name,
                              Console &console) {
    ReflectanceFile read = read_table(file, console);
    std::vector<std::string> names;
    for (const TableChannel &channel : read.channels)
        names.push_back(channel.name);
    if (name.empty() && names.size() == 1)
        return std::move(read.channels.front().table);
    const auto found = std::ranges::find(names, name);
    if (names.front().empty())
        throw Error({file.string() + " has one column of values and no channels", "--channel",
                     "leave the option out"});
    if (name.empty() || found == names.end())
        throw Error({file.string() + " has " + detail::counted(names.size(), "channel") +
                         (name.empty() ? "" : ", and none is '" + name + "'"),
                     "--channel", accepted_names(name, names)});
    return std::move(read.channels[static_cast<std::size_t>(found - names.begin())].table);
}

ReflectanceTable read_single_table(const std::filesystem::path &file, Console &console) {
    ReflectanceFile read = read_table(file, console);
    check_single_channel(read, file.string());
    return std::move(read.channels.front().table);
}

} // namespace tsuya::program
