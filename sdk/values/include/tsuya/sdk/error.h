#pragma once
/// \file
/// The one exception of Tsuya: what is wrong, where, and what would be accepted.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya {

/// One thing that is wrong with an input.
struct Problem {
    std::string what;       ///< what is wrong, one sentence without a full stop
    std::string where{};    ///< file:line:column, or a path such as `fabrics.satin.bard`
    std::string accepted{}; ///< what would be accepted; may be empty
};

/// Readers collect at most this many problems before they throw.
inline constexpr std::size_t kMaxProblems = 20;

/// Thrown by every public function whose input is wrong. `what()` is all problems as text, one a
/// line: `where: what; accepted`.
class Error : public std::runtime_error {
  public:
    /// One problem.
    explicit Error(Problem problem);
    /// \param problems at least one
    explicit Error(std::vector<Problem> problems);
    /// At least one.
    const std::vector<Problem> &problems() const noexcept { return problems_; }
    /// The same problems, all at another place: for a caller who knows it better.
    Error at(const std::string &where) const;
    /// The same problems, `where: ` before the place of each that does not begin with it.
    Error within(const std::string &where) const;

  private:
    std::vector<Problem> problems_;
};

/// Collects problems, to throw them together.
class Problems {
  public:
    /// Notes a problem; those after the first kMaxProblems are dropped.
    void add(Problem problem);
    /// Notes all problems of an error.
    void add(const Error &error);
    /// Notes a problem unless the rule holds. \return the rule
    bool need(bool rule, std::string what, std::string where, std::string accepted);
    /// Nothing was noted.
    bool empty() const { return problems_.empty(); }
    /// Further problems would be dropped: a reader may stop.
    bool full() const { return problems_.size() >= kMaxProblems; }
    /// In the order in which they were noted.
    const std::vector<Problem> &all() const { return problems_; }
    /// Throws Error with all that were noted; returns where there are none.
    void throw_if_any() const;

  private:
    std::vector<Problem> problems_{};
};

/// Thrown when the caller's stop flag was seen; what was done is kept by the caller.
class Interrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The entry of `known` nearest to `name` in edit distance, or an empty string where none is near
/// (more than a third of the letters differ).
std::string nearest_name(std::string_view name, std::span<const std::string> known);

/// `expected one of: a, b, c; did you mean b?` for an error about a name.
std::string accepted_names(std::string_view name, std::span<const std::string> known);

} // namespace tsuya
