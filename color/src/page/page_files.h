#pragma once
/// \file
/// The files of color/page as text of the library.

#include <span>
#include <string_view>

namespace tsuya {

/// A file by its name, without a folder.
struct PageFile {
    std::string_view name;
    std::string_view text;
};

/// All files, scripts in the order in which they stand in the page.
std::span<const PageFile> page_files();

} // namespace tsuya
