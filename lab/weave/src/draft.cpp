#include "tsuya/lab/draft.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

template <class Up> Draft draft_of(int ends, int picks, Up up) {
    Draft draft{ends, picks, {}};
    for (int p = 0; p < picks; ++p)
        for (int e = 0; e < ends; ++e)
            draft.warp_up.push_back(up(e, p) ? 1 : 0);
    return draft;
}

/// `3/1` as two numbers.
std::optional<std::pair<int, int>> two_numbers(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos)
        return std::nullopt;
    const auto number = [](std::string_view digits) {
        int value = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size() ? value : -1;
    };
    const int a = number(text.substr(0, slash)), b = number(text.substr(slash + 1));
    if (a < 0 || b < 0)
        return std::nullopt;
    return std::pair(a, b);
}

/// Runs of `true` in a cyclic row.
template <class Up> void append_runs(int count, Up up, std::vector<int> &runs) {
    int start = 0;
    while (start < count && up(start))
        ++start;
    if (start == count) {
        runs.push_back(count);
        return;
    }
    int run = 0;
    for (int i = 1; i <= count; ++i) {
        if (up((start + i) % count)) {
            ++run;
        } else if (run > 0) {
            runs.push_back(run);
            run = 0;
        }
    }
}

/// The yarns that lie below yarn 0 directly or through others; above it where `above`. Ends come
/// first, then picks.
std::size_t reached_yarns(const Draft &draft, bool above) {
    const int total = draft.ends + draft.picks;
    std::vector<char> seen(static_cast<std::size_t>(total), 0);
    std::vector<int> open{0};
    seen[0] = 1;
    std::size_t count = 1;
    while (!open.empty()) {
        const int yarn = open.back();
        open.pop_back();
        const bool is_end = yarn < draft.ends;
        for (int other = is_end ? draft.ends : 0; other < (is_end ? total : draft.ends); ++other) {
            const bool warp_above =
                is_end ? draft.up(yarn, other - draft.ends) : draft.up(other, yarn - draft.ends);
            char &mark = seen[static_cast<std::size_t>(other)];
            if ((warp_above == is_end) != above && mark == 0) {
                mark = 1;
                ++count;
                open.push_back(other);
            }
        }
    }
    return count;
}

std::string counted_ends(int ends) {
    return tsuya::detail::counted(static_cast<std::size_t>(std::max(ends, 0)), "end");
}

} // namespace

Draft satin(int ends, int step) {
    if (ends < 5 || ends > kMaxDraft || step < 2 || step > ends - 2 || std::gcd(ends, step) != 1)
        throw Error(
            {"a satin of " + counted_ends(ends) + " has no step " + std::to_string(step), "draft",
             "expected at least 5 ends and a step from 2 to ends - 2 that shares no divisor "
             "with them"});
    return draft_of(ends, ends, [=](int e, int p) { return e != step * p % ends; });
}

Draft twill(int over, int under) {
    if (over < 1 || under < 1 || over + under < 3 || over > kMaxDraft || under > kMaxDraft - over)
        throw Error(
            {"a twill " + std::to_string(over) + "/" + std::to_string(under) + " does not exist",
             "draft", "expected two numbers above 0, not both 1"});
    const int n = over + under;
    return draft_of(n, n, [=](int e, int p) { return (e - p + n) % n < over; });
}

Draft plain_weave() {
    return draft_of(2, 2, [](int e, int p) { return (e + p) % 2 == 0; });
}

std::vector<std::string> draft_names() {
    return {"plain", "twill 2/2", "twill 3/1", "satin 5", "satin 8"};
}

Draft parse_draft(std::string_view name, const std::string &where) {
    if (name == "plain")
        return plain_weave();
    if (name == "satin 5")
        return satin(5, 2);
    if (name == "satin 8")
        return satin(8, 3);
    try {
        if (name.starts_with("twill "))
            if (const auto pair = two_numbers(name.substr(6)))
                return twill(pair->first, pair->second);
        if (name.starts_with("satin "))
            if (const auto pair = two_numbers(name.substr(6)))
                return satin(pair->first, pair->second);
    } catch (const Error &error) {
        throw error.at(where);
    }
    throw Error({"unknown draft \"" + std::string(name) + "\"", where,
                 accepted_names(name, draft_names())});
}

void check_draft(const Draft &draft, const std::string &where) {
    const auto fail = [&](std::string what, std::string accepted) {
        throw Error({std::move(what), where, std::move(accepted)});
    };
    if (std::min(draft.ends, draft.picks) < 2 || std::max(draft.ends, draft.picks) > kMaxDraft)
        fail("a repeat of " + counted_ends(draft.ends) + " and " +
                 tsuya::detail::counted(static_cast<std::size_t>(std::max(draft.picks, 0)), "pick"),
             "expected 2 to " + std::to_string(kMaxDraft) + " of each");
    if (draft.warp_up.size() !=
        static_cast<std::size_t>(draft.ends) * static_cast<std::size_t>(draft.picks))
        fail("the draft has " + tsuya::detail::counted(draft.warp_up.size(), "crossing"),
             "expected ends times picks");
    for (int e = 0; e < draft.ends; ++e) {
        int up = 0;
        for (int p = 0; p < draft.picks; ++p)
            up += draft.up(e, p);
        if (up == 0 || up == draft.picks)
            fail("warp end " + std::to_string(e + 1) + " floats for ever",
                 "expected each end to pass over and under at least one pick");
    }
    for (int p = 0; p < draft.picks; ++p) {
        int up = 0;
        for (int e = 0; e < draft.ends; ++e)
            up += draft.up(e, p);
        if (up == 0 || up == draft.ends)
            fail("weft pick " + std::to_string(p + 1) + " floats for ever",
                 "expected each pick to pass over and under at least one end");
    }
    // A cloth hangs together unless some of its yarns lie above all others [Clapham].
    const std::size_t yarns = static_cast<std::size_t>(draft.ends + draft.picks);
    if (reached_yarns(draft, false) != yarns || reached_yarns(draft, true) != yarns)
        fail("the cloth falls apart: some of its yarns lie above all others",
             "expected a draft that binds all yarns together");
}

std::vector<int> warp_floats(const Draft &draft) {
    std::vector<int> runs;
    for (int e = 0; e < draft.ends; ++e)
        append_runs(
            draft.picks, [&](int p) { return draft.up(e, p); }, runs);
    return runs;
}

std::vector<int> weft_floats(const Draft &draft) {
    std::vector<int> runs;
    for (int p = 0; p < draft.picks; ++p)
        append_runs(
            draft.ends, [&](int e) { return !draft.up(e, p); }, runs);
    return runs;
}

double warp_share(const Draft &draft) {
    const auto up = std::count(draft.warp_up.begin(), draft.warp_up.end(), 1);
    return static_cast<double>(up) / static_cast<double>(draft.warp_up.size());
}

bool is_same_reversed(const Draft &draft, bool ends, bool picks) {
    const auto is_same = [&](int right, int up) {
        for (int p = 0; p < draft.picks; ++p)
            for (int e = 0; e < draft.ends; ++e)
                if (draft.up(e, p) != draft.up(right + (ends ? -e : e), up + (picks ? -p : p)))
                    return false;
        return true;
    };
    for (int up = 0; up < draft.picks; ++up)
        for (int right = 0; right < draft.ends; ++right)
            if (is_same(right, up))
                return true;
    return false;
}

Draft smallest_repeat(const Draft &draft) {
    const auto repeats = [&](int step_end, int step_pick) {
        for (int p = 0; p < draft.picks; ++p)
            for (int e = 0; e < draft.ends; ++e)
                if (draft.up(e, p) != draft.up(e + step_end, p + step_pick))
                    return false;
        return true;
    };
    int ends = 1, picks = 1;
    while (draft.ends % ends != 0 || !repeats(ends, 0))
        ++ends;
    while (draft.picks % picks != 0 || !repeats(0, picks))
        ++picks;
    return draft_of(ends, picks, [&](int e, int p) { return draft.up(e, p); });
}

} // namespace tsuya::lab
