#include <abut/bake/outline/optimal_partition.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <limits>
#include <tuple>

namespace abut::outline {
namespace {

constexpr std::uint32_t infinite = std::numeric_limits<std::uint32_t>::max();

}  // namespace

int OptimalPartition::orientation_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    if (a == b || b == c || c == a) return 0;
    // Cyclic rotation moves the smallest first; then they are ascending or in reverse order.
    while (a > b || a > c) std::tie(a, b, c) = std::tuple(b, c, a);
    return b < c ? orientations_[(a * size_ + b) * size_ + c] : -orientations_[(a * size_ + c) * size_ + b];
}

void OptimalPartition::compute_orientations() {
    orientations_.resize(std::size_t{size_} * size_ * size_);
    for (std::uint32_t a = 0; a < size_; ++a)
        for (std::uint32_t b = a + 1; b < size_; ++b)
            for (std::uint32_t c = b + 1; c < size_; ++c)
                orientations_[(a * size_ + b) * size_ + c] =
                    static_cast<std::int8_t>(orientation(loop_[a], loop_[b], loop_[c]));
}

/// True if b lies strictly between a and c. The three points are collinear.
bool OptimalPartition::between(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec2 &p = loop_[a], &q = loop_[b], &r = loop_[c];
    const auto strictly = [](float low, float x, float high) { return (low < x && x < high) || (high < x && x < low); };
    return p.x != r.x ? strictly(p.x, q.x, r.x) : strictly(p.y, q.y, r.y);
}

bool OptimalPartition::is_straight_allowed(std::uint32_t corner, std::uint32_t neighbour, std::uint32_t other) const {
    if (may_be_straight_.empty()) return true;
    return may_be_straight_[corner] != 0 && neighbour == before(corner) && other == after(corner);
}

/// True if a part may go from a over b to c.
bool OptimalPartition::convex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const int side = orientation_of(a, b, c);
    return side > 0 || (side == 0 && is_straight_allowed(b, a, c));
}

/// The number of cuts for a part with the chord as an edge and everything beyond it, including the chord if it is a
/// cut.
std::uint32_t OptimalPartition::cost(std::uint32_t i, std::uint32_t k) const {
    const Chord& at = chord(i, k);
    return at.cuts + (at.kind == Kind::cut ? 1 : 0);
}

/// The direction to another corner: 1 into the interior, 0 along one of the edges, -1 outside.
int OptimalPartition::side_of_corner(std::uint32_t corner, std::uint32_t to) const {
    const std::uint32_t last = before(corner), next = after(corner);
    const int left = orientation_of(corner, next, to), right = orientation_of(last, corner, to);
    if ((left == 0 && !between(to, corner, next)) || (right == 0 && !between(to, corner, last))) return 0;
    const bool inside = corner_turns_[corner] > 0 ? left > 0 && right > 0 : left > 0 || right > 0;
    return inside ? 1 : -1;
}

/// Computes on which side of the line from i to a later corner k all other corners lie.
void OptimalPartition::find_sides(std::uint32_t i, std::uint32_t k) {
    for (std::uint32_t corner = 0; corner < i; ++corner)
        sides_[corner] = orientations_[(corner * size_ + i) * size_ + k];
    for (std::uint32_t corner = i + 1; corner < k; ++corner) {
        const int side = orientations_[(i * size_ + corner) * size_ + k];
        sides_[corner] = static_cast<std::int8_t>(-side);
    }
    for (std::uint32_t corner = k + 1; corner < size_; ++corner)
        sides_[corner] = orientations_[(i * size_ + k) * size_ + corner];
    sides_[i] = sides_[k] = 0;
}

OptimalPartition::Kind OptimalPartition::classify(std::uint32_t i, std::uint32_t k) {
    const int at_i = side_of_corner(i, k);
    if (at_i < 0) return Kind::blocked;
    const int at_k = side_of_corner(k, i);
    if (at_k < 0) return Kind::blocked;
    find_sides(i, k);
    bool grazes = at_i == 0 || at_k == 0;
    for (std::uint32_t a = size_ - 1, b = 0; b < size_; a = b++) {
        if (sides_[b] == 0 && between(i, b, k)) grazes = true;
        if (sides_[a] * sides_[b] < 0 && orientation_of(a, b, i) * orientation_of(a, b, k) < 0) return Kind::blocked;
    }
    return grazes ? Kind::grazing : Kind::cut;
}

void OptimalPartition::classify_chords() {
    chords_.assign(std::size_t{size_} * size_, {});
    sides_.resize(size_);
    corner_turns_.resize(size_);
    for (std::uint32_t i = 0; i < size_; ++i) corner_turns_[i] = orientation_of(before(i), i, after(i));
    for (std::uint32_t i = 0; i < size_; ++i)
        for (std::uint32_t k = i + 1; k < size_; ++k)
            chord(i, k).kind = k == i + 1 || (i == 0 && k + 1 == size_) ? Kind::edge : classify(i, k);
    for (std::uint32_t i = 0; i < size_; ++i)
        for (std::uint32_t k = size_; k-- > i + 1;) {
            if (chord(i, k).kind != Kind::grazing) continue;
            for (std::uint32_t corner = k + 1; corner < size_; ++corner) {
                const Kind rest = chord(i, corner).kind;
                if (!real(chord(k, corner).kind) || !(real(rest) || rest == Kind::beside)) continue;
                if (orientation_of(i, corner, k) == 0 && between(i, corner, k)) chord(i, k).kind = Kind::beside;
            }
        }
}

/// Pairs arrive with ascending `last`; one with a smaller `first` as well is dominated.
void OptimalPartition::offer(Chord& at, std::uint32_t cuts, Pair pair) {
    if (cuts > at.cuts) return;
    if (cuts < at.cuts) {
        at.cuts = cuts;
        at.count = 0;
        pairs_.resize(at.begin);
    }
    if (at.count > 0 && pairs_.back().first >= pair.first) return;
    pairs_.push_back(pair);
    ++at.count;
}

void OptimalPartition::fill(std::uint32_t i, std::uint32_t k) {
    Chord& at = chord(i, k);
    for (std::uint32_t j = i + 1; j < k; ++j) {
        const Chord& side = chord(i, j);
        if (side.kind == Kind::blocked || side.kind == Kind::grazing || !real(chord(j, k).kind)) continue;
        const std::uint32_t beyond = cost(j, k);
        const int bend = orientation_of(i, j, k);
        if (side.kind == Kind::beside) {
            // The part is that of the chord to j, and k is a straight corner on its way back.
            if (bend != 0 || !between(i, k, j) || side.count == 0) continue;
            if (!is_straight_allowed(k, j, after(k)) || (!may_be_straight_.empty() && at.kind == Kind::cut)) continue;
            offer(at, side.cuts + beyond, {pairs_[side.begin + side.count - 1].first, j});
            continue;
        }
        if (bend <= 0) continue;
        std::uint32_t pair = side.count;
        while (pair > 0 && !convex(pairs_[side.begin + pair - 1].last, j, k)) --pair;
        if (pair > 0 && convex(k, i, pairs_[side.begin + pair - 1].first))
            offer(at, side.cuts + beyond, {pairs_[side.begin + pair - 1].first, j});
        else if (real(side.kind))
            offer(at, cost(i, j) + beyond, {j, j});
    }
}

/// A part that begins with collinear corners.
void OptimalPartition::fill_flat(std::uint32_t i, std::uint32_t k) {
    for (std::uint32_t j = i + 1; j < k; ++j) {
        const Chord& side = chord(i, j);
        if (!real(chord(j, k).kind) || !(real(side.kind) || side.kind == Kind::flat)) continue;
        if (orientation_of(i, j, k) != 0 || !between(i, j, k)) continue;
        const std::uint32_t last = side.kind == Kind::flat ? pairs_[side.begin].last : i;
        if (!is_straight_allowed(j, last, k)) continue;
        Chord& at = chord(i, k);
        at.kind = Kind::flat;
        offer(at, cost(i, j) + cost(j, k), {side.kind == Kind::flat ? pairs_[side.begin].first : j, j});
        return;
    }
}

void OptimalPartition::collect() {
    struct Task {
        std::uint32_t i, k;
    };
    corners_.clear();
    ends_.clear();
    std::vector<Task> queue{{0, size_ - 1}};
    while (!queue.empty()) {
        const auto [i, base] = queue.back();
        queue.pop_back();
        const auto begin = corners_.size();
        std::uint32_t k = base, first = pairs_[chord(i, k).begin].first;
        corners_.push_back(k);
        for (;;) {
            const Chord& at = chord(i, k);
            const auto pairs = std::span(pairs_).subspan(at.begin, at.count);
            const std::uint32_t j = std::ranges::find(pairs, first, &Pair::first)->last;
            corners_.push_back(j);
            if (chord(j, k).kind == Kind::cut) queue.push_back({j, k});
            k = j;
            if (first == j) break;
        }
        if (chord(i, k).kind == Kind::cut) queue.push_back({i, k});
        corners_.push_back(i);
        std::reverse(corners_.begin() + static_cast<std::ptrdiff_t>(begin), corners_.end());
        ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }
}

void OptimalPartition::solve(std::span<const Vec2> loop, std::span<const std::uint8_t> may_be_straight) {
    loop_ = loop;
    may_be_straight_ = may_be_straight;
    size_ = static_cast<std::uint32_t>(loop.size());
    compute_orientations();
    classify_chords();
    pairs_.clear();
    for (std::uint32_t i = size_; i-- > 0;)
        for (std::uint32_t k = i + 2; k < size_; ++k) {
            Chord& at = chord(i, k);
            if (at.kind == Kind::blocked) continue;
            at.begin = static_cast<std::uint32_t>(pairs_.size());
            at.cuts = infinite;
            if (at.kind == Kind::grazing)
                fill_flat(i, k);
            else
                fill(i, k);
        }
    collect();
}

}  // namespace abut::outline
