#include <abut/walk/walk_path_search.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// A triangle that a way was found to.
struct alignas(128) Node {
    DVec<2> left, right;              ///< ends of the side that it is entered by, in the plane of its way
    DVec<2> tip;                      ///< its third corner there
    DVec<2> root;                     ///< where the way turned last, or began
    DVec<2> left_limit, right_limit;  ///< of what is seen from there
    double to_root = 0;               ///< what the way to there costs
    double estimate = 0;              ///< of the whole way
    std::uint32_t triangle = 0;
    std::uint32_t parent = none;
    std::uint8_t entered = 3;  ///< the side
    std::uint8_t left_by = 3;  ///< the side of the parent
    bool mirrored = false;     ///< laid out upside down
    bool closed = false;
};

/// Numbers of nodes by triangle; costs what is used of it.
class NodeNumbers {
public:
    explicit NodeNumbers(std::size_t triangles) : block_of_((triangles >> bits) + 1, 0), numbers_(size, none) {}

    std::uint32_t& operator[](std::uint32_t triangle) {
        std::uint32_t& block = block_of_[triangle >> bits];
        if (block == 0) {
            block = static_cast<std::uint32_t>(numbers_.size() >> bits);
            numbers_.resize(numbers_.size() + size, none);
        }
        return numbers_[(std::size_t{block} << bits) | (triangle & (size - 1))];
    }

private:
    static constexpr std::uint32_t bits = 8, size = 1u << bits;
    std::vector<std::uint32_t> block_of_;  ///< 0: nothing there yet
    std::vector<std::uint32_t> numbers_;
};

struct Entry {
    double estimate = 0;
    std::uint32_t node = 0;
    bool operator<(const Entry& other) const {
        return estimate < other.estimate || (estimate == other.estimate && node < other.node);
    }
};

/// The least first; four below each, which are in one cache line.
class Frontier {
public:
    bool is_empty() const { return entries_.empty(); }
    void push(const Entry& entry) {
        std::size_t at = entries_.size();
        entries_.push_back(entry);
        while (at > 0) {
            const std::size_t above = (at - 1) / 4;
            if (!(entry < entries_[above])) break;
            entries_[at] = entries_[above];
            at = above;
        }
        entries_[at] = entry;
    }
    Entry pop() {
        const Entry result = entries_.front(), moved = entries_.back();
        entries_.pop_back();
        const std::size_t count = entries_.size();
        std::size_t at = 0;
        while (4 * at + 1 < count) {
            const std::size_t first = 4 * at + 1, end = std::min(first + 4, count);
            std::size_t least = first;
            for (std::size_t i = first + 1; i < end; ++i) least = entries_[i] < entries_[least] ? i : least;
            if (!(entries_[least] < moved)) break;
            entries_[at] = entries_[least];
            at = least;
        }
        if (count > 0) entries_[at] = moved;
        return result;
    }

private:
    std::vector<Entry> entries_;
};

class Search {
public:
    Search(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to, double stretch)
        : rules_(rules),
          walk_(rules.data.walk.data()),
          from_(from),
          to_(to),
          numbers_(rules.data.walk.size()),
          weight_(stretch * rules.least_cost()) {
        const WalkTriangle& end = walk_[to.triangle];
        const WalkWeights weights = shares(to.weights);
        const DVec<3> first(end.corner[0]);
        goal_ = first + (DVec<3>(end.corner[1]) - first) * weights.second +
                (DVec<3>(end.corner[2]) - first) * weights.third;
    }

    std::optional<WalkStrip> run() {
        start();
        // Each push is a side that a triangle is left by, or the start.
        while (!frontier_.is_empty()) {
            const Entry entry = frontier_.pop();
            if (nodes_[entry.node].closed) continue;
            nodes_[entry.node].closed = true;
            if (nodes_[entry.node].triangle == to_.triangle) return strip(entry.node);
            open(entry.node);
        }
        return std::nullopt;
    }

    std::vector<std::uint32_t> reached() const {
        std::vector<std::uint32_t> result;
        for (const Node& node : nodes_) result.push_back(node.triangle);
        return result;
    }

private:
    void start() {
        const WalkTriangle& walk = walk_[from_.triangle];
        const WalkWeights weights = shares(from_.weights);
        Node node;
        node.triangle = from_.triangle;
        // As if it was entered over its first side.
        node.right = {1 / walk.inverse_width, 0};
        node.tip = {walk.third, 1 / walk.inverse_height};
        node.root = node.right * weights.second + node.tip * weights.third;
        numbers_[node.triangle] = 0;
        nodes_.push_back(node);
        frontier_.push({0, 0});
    }

    void open(std::uint32_t number) {
        const Node node = nodes_[number];
        const WalkTriangle& walk = walk_[node.triangle];
        const std::uint32_t entered = node.entered == 3 ? 0 : node.entered;
        const bool at_start = node.entered == 3;
        // Side `entered + 1` begins at its right end, or its left one where the triangle is laid out upside down.
        leave(number, node, walk, next_corner(entered), node.mirrored, at_start);
        leave(number, node, walk, next_corner(next_corner(entered)), !node.mirrored, at_start);
        if (at_start) {
            Node turned = node;
            turned.left = node.right;
            turned.tip = node.left;
            leave(number, turned, walk, 0, true, true);
        }
    }

    /// Over the side from the tip to the left end, or to the right one.
    void leave(std::uint32_t number, const Node& node, const WalkTriangle& walk, std::uint32_t side, bool by_left,
               bool at_start) {
        const WalkLink link = walk.link[side];
        if (link.is_border()) return;
        const std::uint32_t beyond = numbers_[link.triangle()];
        if (beyond != none && nodes_[beyond].closed) return;
        if (!rules_.may_cross({node.triangle, side}, link)) return;

        Node next;
        next.left = by_left ? node.left : node.tip;
        next.right = by_left ? node.tip : node.right;
        next.root = node.root;
        next.to_root = node.to_root;
        next.left_limit = next.left;
        next.right_limit = next.right;
        const double cost = rules_.alike ? 1.0 : rules_.cost(walk);
        if (!at_start) look(node, next, by_left, cost);

        // The goal, unfolded into the plane beyond the side.
        const std::uint32_t left = left_leaving(side, node.mirrored);
        const DVec<3> left_end(walk.corner[left]);
        const DVec<3> across = DVec<3>(walk.corner[left == side ? next_corner(side) : side]) - left_end;
        const DVec<3> to_goal = goal_ - left_end;
        const double square = dot(across, across), share = dot(to_goal, across) / square;
        const double far = std::sqrt(std::max(dot(to_goal, to_goal) / square - share * share, 0.0));
        const DVec<2> along = next.right - next.left, ahead{-along.y, along.x};
        const DVec<2> goal = next.left + along * share + ahead * far;

        DVec<2> by;  // where the straightest way crosses the side, or turns before
        const DVec<2> sight = goal - next.root;
        if (cross(next.left_limit - next.root, sight) > 0) {
            by = next.left_limit;
        } else if (cross(next.right_limit - next.root, sight) < 0) {
            by = next.right_limit;
        } else {
            const double behind = dot(next.left - next.root, ahead), beyond_it = far * square;
            const double sum = behind + beyond_it;
            by = next.root + sight * (sum > 0 ? std::max(behind, 0.0) / sum : 0.0);
        }
        const double g = next.to_root + cost * length(by - next.root);
        next.estimate = g + weight_ * length(goal - by);
        if (beyond != none && next.estimate >= nodes_[beyond].estimate) return;

        if (!rules_.alike && rules_.cost(walk_[link.triangle()]) != cost) {
            next.to_root = g;
            next.root = by;
            next.left_limit = next.left;
            next.right_limit = next.right;
        }
        next.tip = beyond_side(walk, side, node.mirrored, next.left, next.right);
        next.triangle = link.triangle();
        next.parent = number;
        next.entered = static_cast<std::uint8_t>(link.side());
        next.left_by = static_cast<std::uint8_t>(side);
        next.mirrored = node.mirrored != link.mirrored();
        if (beyond == none) {
            numbers_[link.triangle()] = static_cast<std::uint32_t>(nodes_.size());
            frontier_.push({next.estimate, static_cast<std::uint32_t>(nodes_.size())});
            nodes_.push_back(next);
        } else {
            nodes_[beyond] = next;
            frontier_.push({next.estimate, beyond});
        }
    }

    /// What of the side that is left by is seen from the root; from a new one where nothing is.
    static void look(const Node& node, Node& next, bool by_left, double cost) {
        const DVec<2> left = node.left_limit - node.root, right = node.right_limit - node.root;
        const DVec<2> tip = node.tip - node.root;
        next.left_limit = node.left_limit;
        next.right_limit = node.right_limit;
        if (by_left) {
            if (cross(left, tip) > 0) {
                turn_at(next, node.left_limit, cost);
            } else if (cross(right, tip) >= 0) {
                next.right_limit = node.tip;
            }
        } else {
            if (cross(right, tip) < 0) {
                turn_at(next, node.right_limit, cost);
            } else if (cross(left, tip) <= 0) {
                next.left_limit = node.tip;
            }
        }
    }
    static void turn_at(Node& next, const DVec<2>& corner, double cost) {
        next.to_root += cost * length(corner - next.root);
        next.root = corner;
        next.left_limit = next.left;
        next.right_limit = next.right;
    }

    WalkStrip strip(std::uint32_t last) const {
        WalkStrip result{from_, to_, {}};
        for (std::uint32_t i = last; nodes_[i].parent != none; i = nodes_[i].parent)
            result.sides.push_back({nodes_[nodes_[i].parent].triangle, nodes_[i].left_by});
        std::reverse(result.sides.begin(), result.sides.end());
        return result;
    }

    const WalkPathRules& rules_;
    const WalkTriangle* walk_;
    const WalkPoint from_, to_;
    NodeNumbers numbers_;
    std::vector<Node> nodes_;
    Frontier frontier_;
    DVec<3> goal_{0.0};
    const double weight_;
};

}  // namespace

std::optional<WalkStrip> find_strip(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to,
                                    double stretch, std::vector<std::uint32_t>* reached) {
    Search search(rules, from, to, stretch);
    std::optional<WalkStrip> result = search.run();
    if (!result && reached != nullptr) *reached = search.reached();
    return result;
}

}  // namespace abut
