#include <abut/math/detail/no_index.hpp>
#include <abut/math/simd/compiler-inl.h>
#include <abut/math/simd/square_root.hpp>
#include <abut/walk/path/search.hpp>
#include <abut/walk/path/string_pulling.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <memory>

namespace abut::detail {
namespace {

/// A triangle that the search has reached, in one or two cache lines.
struct alignas(128) Node {
    DVec<2> left, right;              ///< ends of the side by which it is entered, in the plane of its path
    DVec<2> tip;                      ///< its third corner
    DVec<2> root;                     ///< where the path bends last, or begins
    DVec<2> left_limit, right_limit;  ///< limits of the visible cone
    double to_root;                   ///< cost of the path to the root
    std::uint32_t triangle, parent;
    std::uint8_t entered, left_by;  ///< sides of this triangle and of its parent
    bool mirrored;                  ///< unfolded upside down
};

/// Nodes with stable addresses, in blocks of doubling size: memory in few large blocks is returned to the system less
/// often than in many small ones.
class NodePool {
public:
    std::uint32_t count() const { return count_; }
    Node& operator[](std::uint32_t number) {
        const std::uint32_t shifted = number + first_block;
        const auto block = static_cast<std::uint32_t>(std::bit_width(shifted)) - 1;
        return blocks_[block - first_bit][shifted - (1u << block)];
    }
    Node& add() {
        if (std::has_single_bit(count_ + first_block))
            blocks_.push_back(std::make_unique_for_overwrite<Node[]>(count_ + first_block));
        return (*this)[count_++];
    }

private:
    static constexpr std::uint32_t first_bit = 8, first_block = 1u << first_bit;
    std::vector<std::unique_ptr<Node[]>> blocks_;
    std::uint32_t count_ = 0;
};

/// The search state of a triangle.
struct Visited {
    double estimate = std::numeric_limits<double>::infinity();  ///< of the total cost of a path through it
    std::uint32_t node = no_index;
    bool closed = false;
};

/// Indexed by triangle; allocates only what is used.
class VisitedTriangles {
public:
    explicit VisitedTriangles(std::size_t triangles) : blocks_((triangles >> bits) + 1) {}

    Visited& operator[](std::uint32_t triangle) {
        std::unique_ptr<Visited[]>& block = blocks_[triangle >> bits];
        if (!block) block = std::make_unique<Visited[]>(size);
        return block[triangle & (size - 1)];
    }

private:
    static constexpr std::uint32_t bits = 6, size = 1u << bits;
    std::vector<std::unique_ptr<Visited[]>> blocks_;
};

/// A bucket queue (Dial 1969): smallest estimate first, rounded to steps of 2^-15 of the first estimate; within a step,
/// last in, first out. All buckets double their width if they don't cover an estimate.
class BucketQueue {
public:
    BucketQueue(double shortest, double step) : min_(shortest), per_step_(1 / step) {}

    void push(double estimate, std::uint32_t node) {
        // Rounding may make an estimate smaller than the last one popped.
        while ((estimate - min_) * per_step_ >= buckets) widen();
        const double index = (estimate - min_) * per_step_;
        const std::uint32_t bucket = std::max(index > 0 ? static_cast<std::uint32_t>(index) : 0, now_);
        insert(bucket, {estimate, node, first_[bucket]});
    }
    /// Returns false if the queue is empty.
    bool pop(std::uint32_t& node) {
        for (std::uint32_t word = now_ >> 6; word < words; ++word) {
            if (filled_[word] == 0) continue;
            now_ = word << 6 | static_cast<std::uint32_t>(std::countr_zero(filled_[word]));
            const std::uint32_t entry = first_[now_];
            node = entries_[entry].node;
            first_[now_] = entries_[entry].next;
            if (first_[now_] == no_index) filled_[word] &= filled_[word] - 1;
            entries_[entry].next = free_;
            free_ = entry;
            return true;
        }
        return false;
    }

private:
    static constexpr std::uint32_t buckets = 1u << 12, words = buckets / 64;
    struct Entry {
        double estimate = 0;
        std::uint32_t node = 0;
        std::uint32_t next = no_index;
    };

    void insert(std::uint32_t bucket, const Entry& entry) {
        std::uint32_t index = free_;
        if (index == no_index) {
            index = static_cast<std::uint32_t>(entries_.size());
            entries_.push_back(entry);
        } else {
            free_ = entries_[index].next;
            entries_[index] = entry;
        }
        first_[bucket] = index;
        filled_[bucket >> 6] |= std::uint64_t{1} << (bucket & 63);
    }
    /// Merges pairs of buckets; the entries of the second follow those of the first.
    void widen() {
        per_step_ *= 0.5;
        now_ >>= 1;
        for (std::uint32_t i = 0; i < buckets; ++i) {
            const std::uint32_t first = 2 * i < buckets ? first_[2 * i] : no_index;
            const std::uint32_t second = 2 * i < buckets ? first_[2 * i + 1] : no_index;
            first_[i] = first == no_index ? second : first;
            if (first != no_index && second != no_index) {
                std::uint32_t last = first;
                while (entries_[last].next != no_index) last = entries_[last].next;
                entries_[last].next = second;
            }
        }
        filled_.fill(0);
        for (std::uint32_t i = 0; i < buckets; ++i)
            if (first_[i] != no_index) filled_[i >> 6] |= std::uint64_t{1} << (i & 63);
    }

    double min_, per_step_;
    std::vector<Entry> entries_;
    std::uint32_t free_ = no_index, now_ = 0;
    std::vector<std::uint32_t> first_ = std::vector<std::uint32_t>(buckets, no_index);
    std::array<std::uint64_t, words> filled_{};
};

class Search {
public:
    Search(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to)
        : rules_(rules),
          walk_(rules.data.walk.data()),
          from_(from),
          to_(to),
          visited_(rules.data.walk.size()),
          goal_(position_of(walk_[to.triangle], to)),
          weight_(rules.min_cost()),
          queue_(0, 1) {
        // The steps are as fine as necessary, but no finer than a triangle at the start can resolve.
        const WalkTriangle& walk = walk_[from.triangle];
        const double shortest = weight_ * length(goal_ - position_of(walk, from));
        queue_ = BucketQueue(shortest, 0x1p-15 * (shortest + weight_ / walk.inverse_width));
    }

    std::optional<WalkStrip> run() {
        if (from_.triangle == to_.triangle) return WalkStrip{from_, to_, {}, {}, {}};
        open_start();
        std::uint32_t number = 0;
        // Each push belongs to one side by which a triangle is left, and none is left twice.
        while (queue_.pop(number)) {
            const std::uint32_t triangle = nodes_[number].triangle;
            Visited& visited = visited_[triangle];
            if (visited.closed) continue;
            visited.closed = true;
            if (triangle == to_.triangle) return strip(number);
            open(number);
        }
        return std::nullopt;
    }

    std::vector<std::uint32_t> reached() {
        std::vector<std::uint32_t> result;
        for (std::uint32_t i = 0; i < nodes_.count(); ++i) result.push_back(nodes_[i].triangle);
        return result;
    }

private:
    void open_start() {
        const WalkTriangle& walk = walk_[from_.triangle];
        const WalkWeights weights = normalised_weights(from_.weights);
        Node& node = nodes_.add();
        node = Node{};
        node.triangle = from_.triangle;
        node.parent = no_index;
        // The start is treated as if entered over its first side.
        node.right = WalkFrame(walk).corner(1);
        node.tip = WalkFrame(walk).corner(2);
        node.root = node.right * weights.second + node.tip * weights.third;
        visited_[node.triangle] = {0, 0, true};
        leave(0, node, walk, 1, false);
        leave(0, node, walk, 2, true);
        Node rotated = node;
        rotated.left = node.right;
        rotated.tip = node.left;
        leave(0, rotated, walk, 0, true);
    }

    void open(std::uint32_t number) {
        const Node& node = nodes_[number];
        const WalkTriangle& walk = walk_[node.triangle];
        // The side after the entered one begins at its right end; in an upside-down triangle, at its left end.
        leave(number, node, walk, next_corner(node.entered), node.mirrored);
        leave(number, node, walk, next_corner(next_corner(node.entered)), !node.mirrored);
    }

    /// Leaves by the side from the tip to the left end, or by the one to the right end.
    void leave(std::uint32_t number, const Node& node, const WalkTriangle& walk, std::uint32_t side, bool by_left) {
        const WalkLink link = walk.link[side];
        if (link.is_border()) return;
        Visited& visited = visited_[link.triangle()];
        if (visited.closed || !rules_.may_cross({node.triangle, side}, link)) return;
        const double cost = rules_.uniform_cost ? 1.0 : rules_.cost(walk);
        Cone cone{node.root, node.left_limit, node.right_limit, node.to_root};
        const DVec<2> left = by_left ? node.left : node.tip, right = by_left ? node.tip : node.right;
        if (number == 0) {
            cone.left = left;
            cone.right = right;
        } else {
            narrow(cone, node.tip, left, right, by_left, cost);
        }

        // The goal, unfolded into the plane beyond the side.
        const std::uint32_t left_corner = left_leaving(side, node.mirrored);
        const DVec<3> left_end(walk.corner[left_corner]);
        const DVec<3> across = DVec<3>(walk.corner[left_corner == side ? next_corner(side) : side]) - left_end;
        const DVec<3> to_goal = goal_ - left_end;
        const double square = dot(across, across), fraction = dot(to_goal, across) / square;
        const double distance_beyond = square_root(std::max(dot(to_goal, to_goal) / square - fraction * fraction, 0.0));
        const DVec<2> along = right - left, ahead{-along.y, along.x};
        const DVec<2> goal = left + along * fraction + ahead * distance_beyond;

        const DVec<2> to_goal_in_plane = goal - cone.root;
        DVec<2> turn = cone.root;
        if (cross(cone.left - cone.root, to_goal_in_plane) > 0) {
            turn = cone.left;
        } else if (cross(cone.right - cone.root, to_goal_in_plane) < 0) {
            turn = cone.right;
        }
        const bool changes = !rules_.uniform_cost && rules_.cost(walk_[link.triangle()]) != cost;
        DVec<2> by = turn;  // where the path crosses the side
        double to_side = cone.to_root, estimate = 0;
        if (rules_.uniform_cost) {
            estimate = turn == cone.root ? cone.to_root + length(to_goal_in_plane)
                                         : cone.to_root + length(turn - cone.root) + length(goal - turn);
        } else {
            const WalkPortal portal{left, right, false};
            by = left + along * (changes ? cheapest_fraction(portal, turn, cost, goal, weight_, 12)
                                         : crossing_fraction(portal, turn, goal));
            to_side += cost * (length(turn - cone.root) + length(by - turn));
            estimate = to_side + weight_ * length(goal - by);
        }
        if (!(estimate < visited.estimate)) return;
        visited.estimate = estimate;
        if (visited.node == no_index) {
            visited.node = nodes_.count();
            nodes_.add();
        }
        prefetch(&walk_[link.triangle()]);
        prefetch(reinterpret_cast<const char*>(&walk_[link.triangle()]) + 64);

        Node& next = nodes_[visited.node];
        next.left = left;
        next.right = right;
        next.tip = beyond_side(walk, side, node.mirrored, left, right);
        if (changes) cone = {by, left, right, to_side};
        next.root = cone.root;
        next.left_limit = cone.left;
        next.right_limit = cone.right;
        next.to_root = cone.to_root;
        next.triangle = link.triangle();
        next.parent = number;
        next.entered = static_cast<std::uint8_t>(link.side());
        next.left_by = static_cast<std::uint8_t>(side);
        next.mirrored = node.mirrored != link.mirrored();
        queue_.push(estimate, visited.node);
    }

    /// The part of a side that is visible from the last bend of the path.
    struct Cone {
        DVec<2> root, left, right;
        double to_root = 0;
    };
    /// Narrows the cone to the exit side. If nothing of it is visible, the cone starts at a new root.
    static void narrow(Cone& cone, const DVec<2>& tip, const DVec<2>& left, const DVec<2>& right, bool by_left,
                       double cost) {
        const double beside_left = cross(cone.left - cone.root, tip - cone.root);
        const double beside_right = cross(cone.right - cone.root, tip - cone.root);
        if (by_left ? beside_left > 0 : beside_right < 0) {
            const DVec<2> corner = by_left ? cone.left : cone.right;
            cone = {corner, left, right, cone.to_root + cost * length(corner - cone.root)};
        } else if (by_left && beside_right >= 0) {
            cone.right = tip;
        } else if (!by_left && beside_left <= 0) {
            cone.left = tip;
        }
    }

    WalkStrip strip(std::uint32_t last) {
        WalkStrip result{from_, to_, {}, {}, {}};
        for (std::uint32_t i = last; nodes_[i].parent != no_index; i = nodes_[i].parent)
            result.sides.push_back({nodes_[nodes_[i].parent].triangle, nodes_[i].left_by});
        std::reverse(result.sides.begin(), result.sides.end());
        return result;
    }

    const WalkPathRules& rules_;
    const WalkTriangle* walk_;
    const WalkPoint from_, to_;
    VisitedTriangles visited_;
    NodePool nodes_;
    DVec<3> goal_;
    const double weight_;
    BucketQueue queue_;
};

}  // namespace

std::optional<WalkStrip> find_strip(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to,
                                    std::vector<std::uint32_t>* reached) {
    Search search(rules, from, to);
    std::optional<WalkStrip> result = search.run();
    if (!result && reached != nullptr) *reached = search.reached();
    return result;
}

}  // namespace abut::detail
