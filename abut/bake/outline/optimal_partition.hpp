#pragma once

// The minimum convex partition of a simple polygon.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::outline {

/// Partitions a polygon by cuts between its corners into the minimum number of convex parts, after Keil and Snoeyink
/// (2002). Dynamic programming finds, for each chord, the fewest cuts of the region on its right. Of equally good
/// solutions it stores those whose part at the chord has the narrowest corners. The paper takes O(n + r^2 min(r^2, n))
/// for r reflex corners; this implementation fills the table for all corners in O(n^3), which needs no special case for
/// straight corners.
class OptimalPartition {
public:
    /// `loop` is counter-clockwise. No corner lies on an edge, but corners may be straight and may touch other corners.
    /// `may_be_straight` has one entry per corner, or none to allow all. It says whether a part may have a straight
    /// corner there with the loop's two edges; no other straight corners are made if it is given.
    void solve(std::span<const Vec2> loop, std::span<const std::uint8_t> may_be_straight = {});

    std::size_t size() const { return ends_.size(); }
    /// The corners of a part as ascending numbers in the loop.
    std::span<const std::uint32_t> part(std::size_t i) const {
        const std::uint32_t begin = i == 0 ? 0 : ends_[i - 1];
        return std::span(corners_).subspan(begin, ends_[i] - begin);
    }

private:
    enum class Kind : std::uint8_t {
        blocked,
        grazing,  ///< blocked, at least by corners that lie on it
        edge,     ///< an edge of the loop
        cut,      ///< inside the loop, except for its ends
        beside,   ///< later corners than its ends lie on it: part of a side that has these as corners
        flat      ///< corners between its ends lie on it: the start of a part without area so far
    };
    /// The neighbours of a chord's ends in the part beside it.
    struct Pair {
        std::uint32_t first, last;
    };
    struct Chord {
        Kind kind = Kind::blocked;
        std::uint32_t cuts = 0;  ///< minimum on its right
        std::uint32_t begin = 0, count = 0;
    };

    Chord& chord(std::uint32_t i, std::uint32_t k) { return chords_[i * size_ + k]; }
    const Chord& chord(std::uint32_t i, std::uint32_t k) const { return chords_[i * size_ + k]; }
    std::uint32_t after(std::uint32_t i) const { return i + 1 == size_ ? 0 : i + 1; }
    std::uint32_t before(std::uint32_t i) const { return i == 0 ? size_ - 1 : i - 1; }
    void compute_orientations();
    int orientation_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    bool between(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    bool real(Kind kind) const { return kind == Kind::edge || kind == Kind::cut; }
    bool is_straight_allowed(std::uint32_t corner, std::uint32_t neighbour, std::uint32_t other) const;
    bool convex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    std::uint32_t cost(std::uint32_t i, std::uint32_t k) const;

    int side_of_corner(std::uint32_t corner, std::uint32_t to) const;
    void find_sides(std::uint32_t i, std::uint32_t k);
    Kind classify(std::uint32_t i, std::uint32_t k);
    void classify_chords();
    void fill(std::uint32_t i, std::uint32_t k);
    void fill_flat(std::uint32_t i, std::uint32_t k);
    void offer(Chord& at, std::uint32_t cuts, Pair pair);
    void collect();

    std::span<const Vec2> loop_;
    std::span<const std::uint8_t> may_be_straight_;
    std::uint32_t size_ = 0;
    std::vector<std::int8_t> orientations_;  ///< of three corners with ascending numbers
    std::vector<Chord> chords_;
    std::vector<Pair> pairs_;
    std::vector<std::int8_t> sides_;
    std::vector<int> corner_turns_;
    std::vector<std::uint32_t> corners_, ends_;
};

}  // namespace abut::outline
