#include <abut/walk/walk_path_pull.hpp>
#include <abut/walk/walk_path_search.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

namespace abut {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// A triangle that a way was found to, as it is found: a cache line or two.
struct alignas(128) Node {
    DVec<2> left, right;              ///< ends of the side that it is entered by, in the plane of its way
    DVec<2> tip;                      ///< its third corner there
    DVec<2> root;                     ///< where the way turned last, or began
    DVec<2> left_limit, right_limit;  ///< of what is seen from there
    double to_root;                   ///< what the way to there costs
    std::uint32_t triangle, parent;
    std::uint8_t entered, left_by;  ///< the sides, of this triangle and of the parent
    bool mirrored;                  ///< laid out upside down
};

/// Nodes that stay where they are, in blocks of which each is as long as all before it: large ones are given back to
/// the system less eagerly than many small ones.
class Nodes {
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

/// What is known of a triangle.
struct Known {
    double estimate = std::numeric_limits<double>::infinity();  ///< of a way from end to end by it
    std::uint32_t node = none;
    bool closed = false;
};

/// By triangle; costs what is used of it.
class KnownTriangles {
public:
    explicit KnownTriangles(std::size_t triangles) : blocks_((triangles >> bits) + 1) {}

    Known& operator[](std::uint32_t triangle) {
        std::unique_ptr<Known[]>& block = blocks_[triangle >> bits];
        if (!block) block = std::make_unique<Known[]>(size);
        return block[triangle & (size - 1)];
    }

private:
    static constexpr std::uint32_t bits = 6, size = 1u << bits;
    std::vector<std::unique_ptr<Known[]>> blocks_;
};

/// The least first, but for steps of 2^-15 of the first estimate: within these the last one first. A queue of buckets
/// (Dial 1969), of which each becomes two steps wide where they don't suffice.
class Frontier {
public:
    Frontier(double least, double step) : least_(least), per_step_(1 / step) {}

    void push(double estimate, std::uint32_t node) {
        // Rounding may bring it below what was taken out last.
        while ((estimate - least_) * per_step_ >= buckets) widen();
        const double place = (estimate - least_) * per_step_;
        const std::uint32_t bucket = std::max(place > 0 ? static_cast<std::uint32_t>(place) : 0, now_);
        put(bucket, {estimate, node, first_[bucket]});
    }
    /// False where there is nothing left.
    bool pop(std::uint32_t& node) {
        for (std::uint32_t word = now_ >> 6; word < words; ++word) {
            if (filled_[word] == 0) continue;
            now_ = word << 6 | static_cast<std::uint32_t>(std::countr_zero(filled_[word]));
            const std::uint32_t entry = first_[now_];
            node = entries_[entry].node;
            first_[now_] = entries_[entry].next;
            if (first_[now_] == none) filled_[word] &= filled_[word] - 1;
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
        std::uint32_t next = none;
    };

    void put(std::uint32_t bucket, const Entry& entry) {
        std::uint32_t place = free_;
        if (place == none) {
            place = static_cast<std::uint32_t>(entries_.size());
            entries_.push_back(entry);
        } else {
            free_ = entries_[place].next;
            entries_[place] = entry;
        }
        first_[bucket] = place;
        filled_[bucket >> 6] |= std::uint64_t{1} << (bucket & 63);
    }
    /// Two buckets become one, the entries of the second behind those of the first.
    void widen() {
        per_step_ *= 0.5;
        now_ >>= 1;
        for (std::uint32_t i = 0; i < buckets; ++i) {
            const std::uint32_t first = 2 * i < buckets ? first_[2 * i] : none;
            const std::uint32_t second = 2 * i < buckets ? first_[2 * i + 1] : none;
            first_[i] = first == none ? second : first;
            if (first != none && second != none) {
                std::uint32_t last = first;
                while (entries_[last].next != none) last = entries_[last].next;
                entries_[last].next = second;
            }
        }
        filled_.fill(0);
        for (std::uint32_t i = 0; i < buckets; ++i)
            if (first_[i] != none) filled_[i >> 6] |= std::uint64_t{1} << (i & 63);
    }

    double least_, per_step_;
    std::vector<Entry> entries_;
    std::uint32_t free_ = none, now_ = 0;
    std::vector<std::uint32_t> first_ = std::vector<std::uint32_t>(buckets, none);
    std::array<std::uint64_t, words> filled_{};
};

class Search {
public:
    Search(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to)
        : rules_(rules),
          walk_(rules.data.walk.data()),
          from_(from),
          to_(to),
          known_(rules.data.walk.size()),
          goal_(in_space(walk_[to.triangle], to)),
          weight_(rules.least_cost()),
          frontier_(0, 1) {
        // As short as need be, but not shorter than steps that a triangle of the start can tell apart.
        const WalkTriangle& walk = walk_[from.triangle];
        const double least = weight_ * length(goal_ - in_space(walk, from));
        frontier_ = Frontier(least, 0x1p-15 * (least + weight_ / walk.inverse_width));
    }

    std::optional<WalkStrip> run() {
        if (from_.triangle == to_.triangle) return WalkStrip{from_, to_, {}, {}, {}};
        open_start();
        std::uint32_t number = 0;
        // Each push is a side that a triangle is left by, and none is left twice.
        while (frontier_.pop(number)) {
            const std::uint32_t triangle = nodes_[number].triangle;
            Known& known = known_[triangle];
            if (known.closed) continue;
            known.closed = true;
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
        const WalkWeights weights = shares(from_.weights);
        Node& node = nodes_.add();
        node = Node{};
        node.triangle = from_.triangle;
        node.parent = none;
        // As if it was entered over its first side.
        node.right = WalkFrame(walk).corner(1);
        node.tip = WalkFrame(walk).corner(2);
        node.root = node.right * weights.second + node.tip * weights.third;
        known_[node.triangle] = {0, 0, true};
        leave(0, node, walk, 1, false);
        leave(0, node, walk, 2, true);
        Node turned = node;
        turned.left = node.right;
        turned.tip = node.left;
        leave(0, turned, walk, 0, true);
    }

    void open(std::uint32_t number) {
        const Node& node = nodes_[number];
        const WalkTriangle& walk = walk_[node.triangle];
        // The side after the one that it is entered by begins at the right end of that, or at the left one where the
        // triangle is laid out upside down.
        leave(number, node, walk, next_corner(node.entered), node.mirrored);
        leave(number, node, walk, next_corner(next_corner(node.entered)), !node.mirrored);
    }

    /// Over the side from the tip to the left end, or to the right one.
    void leave(std::uint32_t number, const Node& node, const WalkTriangle& walk, std::uint32_t side, bool by_left) {
        const WalkLink link = walk.link[side];
        if (link.is_border()) return;
        Known& known = known_[link.triangle()];
        if (known.closed || !rules_.may_cross({node.triangle, side}, link)) return;
        const double cost = rules_.alike ? 1.0 : rules_.cost(walk);
        Cone cone{node.root, node.left_limit, node.right_limit, node.to_root};
        const DVec<2> left = by_left ? node.left : node.tip, right = by_left ? node.tip : node.right;
        if (number == 0) {
            cone.left = left;
            cone.right = right;
        } else {
            look(cone, node.tip, left, right, by_left, cost);
        }

        // The goal, unfolded into the plane beyond the side.
        const std::uint32_t left_corner = left_leaving(side, node.mirrored);
        const DVec<3> left_end(walk.corner[left_corner]);
        const DVec<3> across = DVec<3>(walk.corner[left_corner == side ? next_corner(side) : side]) - left_end;
        const DVec<3> to_goal = goal_ - left_end;
        const double square = dot(across, across), share = dot(to_goal, across) / square;
        const double far = std::sqrt(std::max(dot(to_goal, to_goal) / square - share * share, 0.0));
        const DVec<2> along = right - left, ahead{-along.y, along.x};
        const DVec<2> goal = left + along * share + ahead * far;

        const DVec<2> sight = goal - cone.root;
        DVec<2> turn = cone.root;
        if (cross(cone.left - cone.root, sight) > 0) {
            turn = cone.left;
        } else if (cross(cone.right - cone.root, sight) < 0) {
            turn = cone.right;
        }
        const bool changes = !rules_.alike && rules_.cost(walk_[link.triangle()]) != cost;
        DVec<2> by = turn;  // where it crosses the side
        double to_side = cone.to_root, estimate = 0;
        if (rules_.alike) {
            estimate = turn == cone.root ? cone.to_root + length(sight)
                                         : cone.to_root + length(turn - cone.root) + length(goal - turn);
        } else {
            const WalkPortal portal{left, right, false};
            by = left + along * (changes ? cheapest_share(portal, turn, cost, goal, weight_, 12)
                                         : crossed_at(portal, turn, goal));
            to_side += cost * (length(turn - cone.root) + length(by - turn));
            estimate = to_side + weight_ * length(goal - by);
        }
        if (!(estimate < known.estimate)) return;
        known.estimate = estimate;
        if (known.node == none) {
            known.node = nodes_.count();
            nodes_.add();
        }
        __builtin_prefetch(&walk_[link.triangle()]);
        __builtin_prefetch(reinterpret_cast<const char*>(&walk_[link.triangle()]) + 64);

        Node& next = nodes_[known.node];
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
        frontier_.push(estimate, known.node);
    }

    /// What is seen of a side from where the way turned last.
    struct Cone {
        DVec<2> root, left, right;
        double to_root = 0;
    };
    /// Of the side that is left by; from a new root where nothing is.
    static void look(Cone& cone, const DVec<2>& tip, const DVec<2>& left, const DVec<2>& right, bool by_left,
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
        for (std::uint32_t i = last; nodes_[i].parent != none; i = nodes_[i].parent)
            result.sides.push_back({nodes_[nodes_[i].parent].triangle, nodes_[i].left_by});
        std::reverse(result.sides.begin(), result.sides.end());
        return result;
    }

    const WalkPathRules& rules_;
    const WalkTriangle* walk_;
    const WalkPoint from_, to_;
    KnownTriangles known_;
    Nodes nodes_;
    DVec<3> goal_;
    const double weight_;
    Frontier frontier_;
};

}  // namespace

std::optional<WalkStrip> find_strip(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to,
                                    std::vector<std::uint32_t>* reached) {
    Search search(rules, from, to);
    std::optional<WalkStrip> result = search.run();
    if (!result && reached != nullptr) *reached = search.reached();
    return result;
}

}  // namespace abut
