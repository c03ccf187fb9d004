#pragma once
/// \file
/// The lines of a Weaving Information File, without their meaning.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/error.h"

namespace tsuya::lab::detail {

/// `key = value` with its place in the file.
struct WifEntry {
    std::string key{}; ///< lower case
    std::string value{};
    int line = 0, key_column = 0, value_column = 0; ///< from 1
};

struct WifSection {
    int line = 0;
    std::vector<WifEntry> entries{};
    const WifEntry *find(std::string_view key) const;
};

/// The sections of a text by lower-case name, and the problems found so far.
class WifText {
  public:
    WifText(std::string_view text, std::string name);

    const WifSection *find(std::string_view section) const;
    /// Notes a problem if the section is absent.
    const WifSection *require(std::string_view section);
    void problem(int line, int column, std::string what, std::string accepted);
    void value_problem(const WifEntry &entry, std::string what, std::string accepted);
    /// Throws all problems, if any.
    void finish() const;

    /// A whole number of an entry, or `low` with a problem noted.
    int integer(const WifEntry &entry, int low, int high);
    /// Whole numbers separated by commas; those wrong are left out with a problem noted.
    std::vector<int> integers(const WifEntry &entry, int low, int high);
    double number(const WifEntry &entry, double low, double high);
    bool flag(const WifEntry &entry);
    /// The number that a key stands for (a thread, a treadle, a colour), or 0 with a problem noted.
    int key_number(const WifEntry &entry, int high);

  private:
    std::string name_;
    std::map<std::string, WifSection, std::less<>> sections_{};
    Problems problems_{};
};

std::string lower_case(std::string_view text);

} // namespace tsuya::lab::detail
