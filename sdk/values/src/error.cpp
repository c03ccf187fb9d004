#include "tsuya/sdk/error.h"

#include <algorithm>
#include <numeric>

namespace tsuya {
namespace {

std::string as_text(const std::vector<Problem> &problems) {
    std::string text;
    for (const Problem &p : problems) {
        if (!text.empty())
            text += '\n';
        if (!p.where.empty())
            text += p.where + ": ";
        text += p.what;
        if (!p.accepted.empty())
            text += "; " + p.accepted;
    }
    return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

} // namespace

Error::Error(Problem problem) : Error(std::vector<Problem>{std::move(problem)}) {}

Error::Error(std::vector<Problem> problems)
    : std::runtime_error(as_text(problems)), problems_(std::move(problems)) {}

Error Error::at(const std::string &where) const {
    std::vector<Problem> moved = problems_;
    for (Problem &p : moved)
        p.where = where;
    return Error(std::move(moved));
}

Error Error::within(const std::string &where) const {
    std::vector<Problem> moved = problems_;
    for (Problem &p : moved)
        if (!p.where.starts_with(where))
            p.where = p.where.empty() ? where : where + ": " + p.where;
    return Error(std::move(moved));
}

void Problems::add(Problem problem) {
    if (!full())
        problems_.push_back(std::move(problem));
}

void Problems::add(const Error &error) {
    for (const Problem &p : error.problems())
        add(p);
}

bool Problems::need(bool rule, std::string what, std::string where, std::string accepted) {
    if (!rule)
        add({std::move(what), std::move(where), std::move(accepted)});
    return rule;
}

void Problems::throw_if_any() const {
    if (!problems_.empty())
        throw Error(problems_);
}

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
    for (const std::string &candidate : known) {
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string accepted_names(std::string_view name, std::span<const std::string> known) {
    if (known.empty())
        return "there is none to choose from";
    std::string text = "expected one of: ";
    for (std::size_t i = 0; i < known.size(); ++i)
        text += (i ? ", " : "") + known[i];
    if (const std::string near = nearest_name(name, known); !near.empty())
        text += "; did you mean " + near + "?";
    return text;
}

} // namespace tsuya
