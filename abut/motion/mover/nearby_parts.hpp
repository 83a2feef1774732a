#pragma once

// A cache of the convex parts in a region of a world, for many queries at the same place. For .cpp files.

#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/world/world.hpp>

namespace abut::detail {

/// Identifies a part of an item.
struct PartName {
    Id id;
    std::uint32_t part = 0;

    friend auto operator<=>(const PartName&, const PartName&) = default;
};

/// Parts are visited in the order of their names, so that results don't depend on the search order. Doesn't allocate
/// once warm.
template <int D>
class NearbyParts {
public:
    void clear();
    /// Replaces the contents by all parts whose boxes overlap `box`.
    void gather(const World<D>& world, const Aabb<D>& box, const Filter& filter);
    /// The box of the last `gather`.
    const Aabb<D>& box() const { return box_; }
    std::size_t size() const { return order_.size(); }
    /// True if some part is one-sided.
    bool has_one_sided() const { return has_one_sided_; }

    /// Calls visit(name, part) for the parts whose boxes overlap `box`.
    template <class Visit>
    void each(const Aabb<D>& box, Visit&& visit) const {
        for (std::size_t i = 0; i < order_.size(); ++i) {
            if (!overlaps(boxes_[i], box)) continue;
            const PartName& name = order_[i].name;
            const StoredPart& stored = stored_[order_[i].index];
            if (stored.is_transient)
                visit_again(composites_[stored.composite], boxes_[i], name.part,
                            [&](const Part<D>& part) { visit(name, part); });
            else
                visit(name, detail::single_part(stored.part));
        }
    }

private:
    struct StoredPart {
        View<D> part;                 // not composite
        std::size_t first_point = 0;  // in points_, of a part that was given with points of its own
        bool has_points = false;
        bool is_transient = false;    // by the shape, for one visit: to be visited again
        std::uint32_t composite = 0;  // in composites_, which it is then a part of
    };
    struct Entry {
        PartName name;
        std::uint32_t index;
        Aabb<D> box;
    };

    void add_part(const PartName& name, const Convex<D>& part);
    static void visit_again(const Composite<D>& composite, const Aabb<D>& box, std::uint32_t part,
                            FunctionRef<void(const Convex<D>&)> visit);

    Aabb<D> box_ = Aabb<D>::empty();
    std::vector<Entry> order_;
    std::vector<Aabb<D>> boxes_;  // in that order, together
    std::vector<StoredPart> stored_;
    std::vector<Composite<D>> composites_;
    std::vector<Vec<D>> points_;
    bool has_one_sided_ = false;
};

extern template class NearbyParts<2>;
extern template class NearbyParts<3>;

}  // namespace abut::detail
