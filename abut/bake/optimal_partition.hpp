#pragma once

// The fewest convex parts of a simple polygon.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::outline {

/// Cuts a polygon between its corners into as few convex parts as there can be, as Keil and Snoeyink (2002) do: for
/// each chord the fewest cuts of what is on its right, and of those that need no more the parts at the chord with the
/// narrowest corners. They take O(n + r^2 min(r^2, n)) for r reflex corners; this is their table for all corners,
/// O(n^3), which straight corners are no exceptions to.
class OptimalPartition {
public:
    /// Corners as a loop, counter-clockwise; none lies on an edge, but corners may be straight and touch others.
    /// `may_be_straight`: one a corner, or none at all for all of them: whether a part may have a straight corner where
    /// this one is, its edges there being those of the loop. Where it is given, no part has another straight corner.
    void solve(std::span<const Vec2> loop, std::span<const std::uint8_t> may_be_straight = {});

    std::size_t size() const { return ends_.size(); }
    /// Corners of a part as numbers in the loop, rising.
    std::span<const std::uint32_t> part(std::size_t i) const {
        const std::uint32_t begin = i == 0 ? 0 : ends_[i - 1];
        return std::span(corners_).subspan(begin, ends_[i] - begin);
    }

private:
    enum class Kind : std::uint8_t {
        blocked,
        grazing,  ///< blocked, at least by corners that lie on it
        edge,     ///< of the loop
        cut,      ///< inside of the loop but for its ends
        beside,   ///< corners of a higher number than its ends lie on it: part of a side, when they are corners of it
        flat      ///< corners between its ends lie on it, and are those of a part that has no area yet
    };
    /// The neighbours of a chord's ends in the part beside it.
    struct Pair {
        std::uint32_t first, last;
    };
    struct Chord {
        Kind kind = Kind::blocked;
        std::uint32_t cuts = 0;  ///< the fewest on its right
        std::uint32_t begin = 0, count = 0;
    };

    Chord& chord(std::uint32_t i, std::uint32_t k) { return chords_[i * size_ + k]; }
    const Chord& chord(std::uint32_t i, std::uint32_t k) const { return chords_[i * size_ + k]; }
    std::uint32_t after(std::uint32_t i) const { return i + 1 == size_ ? 0 : i + 1; }
    std::uint32_t before(std::uint32_t i) const { return i == 0 ? size_ - 1 : i - 1; }
    void find_turns();
    int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    bool between(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    bool real(Kind kind) const { return kind == Kind::edge || kind == Kind::cut; }
    bool straight_is_fine(std::uint32_t corner, std::uint32_t neighbour, std::uint32_t other) const;
    bool convex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    std::uint32_t cost(std::uint32_t i, std::uint32_t k) const;

    int side_of_corner(std::uint32_t corner, std::uint32_t to) const;
    void find_sides(std::uint32_t i, std::uint32_t k);
    Kind look(std::uint32_t i, std::uint32_t k);
    void find_chords();
    void fill(std::uint32_t i, std::uint32_t k);
    void fill_flat(std::uint32_t i, std::uint32_t k);
    void offer(Chord& at, std::uint32_t cuts, Pair pair);
    void collect();

    std::span<const Vec2> loop_;
    std::span<const std::uint8_t> may_be_straight_;
    std::uint32_t size_ = 0;
    std::vector<std::int8_t> turns_;  ///< of three corners with rising numbers
    std::vector<Chord> chords_;
    std::vector<Pair> pairs_;
    std::vector<std::int8_t> sides_;
    std::vector<int> bends_;
    std::vector<std::uint32_t> corners_, ends_;
};

}  // namespace abut::outline
