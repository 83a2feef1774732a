#pragma once

// Two polygons of few sides, in double and without a search in the dark: all sides are tried at once as separating
// axes, and where one parts them, the nearest places are a few steps away from it.
//
// The steps are those of Mirtich's V-Clip (1998) in the plane: from corner and corner, or side and corner, to whatever
// the other one's region points to, until each lies in the region of the other. That proves the distance: the line
// through the two places is then a normal of both. Whether a direction is in a corner's region is told by the normals
// of its two sides, which are known to the last digit, and not by differences of corners.

#include <abut/convex/cache.hpp>
#include <abut/convex/side_gaps.hpp>

#include <limits>

namespace abut {

/// Where two cores are nearest, or the least move apart is measured; seen from one of them, the reference.
struct Meeting {
    std::uint32_t of = 0;  ///< the reference. 0: A, 1: B
    DVec<2> normal{0.0};   ///< of length 1, out of the reference
    double gap = 0;        ///< between the cores; below zero: they overlap
    DVec<2> on_reference{0.0}, on_other{0.0};
    std::array<std::uint32_t, 2> reference_corners{}, other_corners{};  ///< on which the places lie, as `Sides` count
};

class PolygonPair {
public:
    /// Neither is a point. They must outlive it.
    PolygonPair(const Outline& a, const Outline& b);

    enum class Answer {
        beyond,   ///< they are farther apart than `enough`
        within,   ///< they are not; `meeting` says where they meet
        unknown,  ///< ask in another way
    };

    /// Where they meet.
    Answer meet(double enough, Cache* cache, Meeting& meeting) const;

    /// Only whether they are at most `enough` apart.
    Answer near(double enough, Cache* cache) const;

    const Outline& outline(std::uint32_t of) const { return *outlines_[of]; }
    const Sides& sides(std::uint32_t of) const { return outlines_[of]->sides; }
    /// The other one as seen from this one.
    const Rigid2& seen_from(std::uint32_t of) const { return seen_[of]; }
    /// A corner of the other one, as seen from this one.
    DVec<2> other_corner(std::uint32_t of, std::uint32_t i) const { return seen_[of].point(sides(1 - of).corner(i)); }

private:
    enum class Step { apart, on, lost };

    bool apart_by_cache(const Cache& cache, Meeting& meeting) const;
    bool walk(std::array<std::uint32_t, 2> corners, int most_steps, Meeting& meeting) const;
    Step before_side(std::uint32_t of, std::uint32_t side, std::array<std::uint32_t, 2>& corners,
                     Meeting& meeting) const;
    bool apart(const SideGap& found, Meeting& meeting) const;
    bool overlapping(const SideGap& found, Meeting& meeting) const;
    bool sides_are_all(const SideGap& found) const;
    bool parted_by_cache(const Cache& cache, double enough) const;
    void remember(const Meeting& meeting, Cache* cache) const;
    void remember_side(const SideGap& found, Cache* cache) const;
    double scale() const;

    const Outline* outlines_[2];
    Rigid2 seen_[2];
};

}  // namespace abut
