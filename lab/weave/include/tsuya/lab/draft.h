#pragma once
/// \file
/// A weaving draft: which yarn lies on the face at every crossing of one repeat of the weave.
///
///     const Draft draft = parse_draft("satin 5");
///     check_draft(draft, "satin 5");

#include <string>
#include <string_view>
#include <vector>

namespace tsuya::lab {

/// The largest repeat in ends and in picks.
inline constexpr int kMaxDraft = 512;

/// Ends (warp yarns) are numbered along the weft, +x, and picks (weft yarns) along the warp, +y,
/// as on a drawdown that is read from its lower left corner. `warp_up[pick * ends + end]` is 1
/// where the warp end lies above the weft pick, seen from the face of the cloth.
struct Draft {
    int ends = 0;  ///< warp yarns in the repeat, 2 to kMaxDraft
    int picks = 0; ///< weft yarns in the repeat, 2 to kMaxDraft
    std::vector<unsigned char> warp_up{};

    /// Any integers: the draft is periodic.
    bool up(int end, int pick) const {
        const int e = ((end % ends) + ends) % ends, p = ((pick % picks) + picks) % picks;
        return warp_up[static_cast<std::size_t>(p) * static_cast<std::size_t>(ends) +
                       static_cast<std::size_t>(e)] != 0;
    }
    bool operator==(const Draft &) const = default;
};

/// A regular satin, warp-faced: at pick p the one weft binding is on end `(step * p) mod ends`.
/// Throws Error unless ends >= 5, 1 < step < ends - 1, and the two have no common divisor.
Draft satin(int ends, int step);
/// A twill whose line rises to the right: the warp is up for `over` picks and down for `under`.
/// Throws Error unless both are above 0 and not both are 1.
Draft twill(int over, int under);
/// One over, one under, shifted by one at each pick.
Draft plain_weave();

/// `plain`, `twill 2/2`, `twill 3/1`, `satin 5` (step 2), `satin 8` (step 3).
std::vector<std::string> draft_names();
/// A draft by one of those names; other twills and satins by `twill OVER/UNDER` and
/// `satin ENDS/STEP`. Throws Error naming `where` with the names that would be accepted.
Draft parse_draft(std::string_view name, const std::string &where = "draft");

/// Throws Error naming `where`: a size out of range, a matrix of another size, a yarn that floats
/// for ever because nothing binds it, or a cloth that falls apart because some of its yarns lie
/// above all others ([Clapham]: the yarns hang together exactly if "lies above" connects each yarn
/// with every other).
void check_draft(const Draft &draft, const std::string &where);

/// Lengths of the floats on the face, in crossings, one for each float: warp floats of each end (a
/// run of crossings with the warp up) or weft floats of each pick (with the warp down).
std::vector<int> warp_floats(const Draft &draft);
/// The weft floats, see warp_floats.
std::vector<int> weft_floats(const Draft &draft);
/// Of all crossings, those with the warp above; 0 to 1.
double warp_share(const Draft &draft);
/// Whether the weave is the same but for a shift when its ends and/or its picks are counted
/// backwards: a mirror image, or with both a half turn.
bool is_same_reversed(const Draft &draft, bool ends, bool picks);
/// The same weave with the smallest repeat.
Draft smallest_repeat(const Draft &draft);

} // namespace tsuya::lab
