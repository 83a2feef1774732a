#pragma once

// The convex parts of what is near in a world, kept for many questions about the same place. For .cpp files.

#include <abut/query/felt_normal.hpp>
#include <abut/world/world.hpp>

namespace abut {

/// Whose part it is.
struct PartName {
    Id id;
    std::uint32_t part = 0;

    friend auto operator<=>(const PartName&, const PartName&) = default;
};

/// Told in the order of their names, so that no answer is up to the order in which they were found. Allocates nothing
/// once it has seen as many.
template <int D>
class NearParts {
public:
    void forget();
    /// Forgets what it had, and takes all parts whose boxes overlap this one.
    void gather(const World<D>& world, const Aabb<D>& box, const Filter& filter);
    /// The box that was asked for.
    const Aabb<D>& box() const { return box_; }
    std::size_t size() const { return order_.size(); }
    /// Whether some part may be met from its front alone.
    bool has_one_sided() const { return has_one_sided_; }

    /// visit(name, part) for those whose boxes overlap this one; a part is a Convex, a Solid or a DistanceFunction.
    template <class Visit>
    void each(const Aabb<D>& box, Visit&& visit) const {
        for (std::size_t i = 0; i < order_.size(); ++i) {
            if (!overlaps(boxes_[i], box)) continue;
            const PartName& name = order_[i].name;
            const Kept& kept = kept_[order_[i].place];
            if (kept.made_up)
                look_again(composites_[kept.composite], boxes_[i], name.part,
                           [&](const Convex<D>& part) { visit(name, part); });
            else if (const auto* convex = std::get_if<Convex<D>>(&kept.part))
                visit(name, *convex);
            else if (const auto* function = std::get_if<DistanceFunction<D>>(&kept.part))
                visit(name, *function);
            else
                visit(name, std::get<Solid<D>>(kept.part));
        }
    }

private:
    struct Kept {
        std::variant<Convex<D>, Solid<D>, DistanceFunction<D>> part;
        std::size_t first_point = 0;  // in points_, of a part that was given with points of its own
        bool has_points = false;
        bool made_up = false;         // by the shape, for one visit: to be visited again
        std::uint32_t composite = 0;  // in composites_, which it is then a part of
    };
    struct Entry {
        PartName name;
        std::uint32_t place;
        Aabb<D> box;
    };

    void take(const PartName& name, const Convex<D>& part);
    static void look_again(const Composite<D>& composite, const Aabb<D>& box, std::uint32_t part,
                           FunctionRef<void(const Convex<D>&)> visit);

    Aabb<D> box_ = Aabb<D>::empty();
    std::vector<Entry> order_;
    std::vector<Aabb<D>> boxes_;  // in that order, together
    std::vector<Kept> kept_;
    std::vector<Composite<D>> composites_;
    std::vector<Vec<D>> points_;
    bool has_one_sided_ = false;
};

extern template class NearParts<2>;
extern template class NearParts<3>;

}  // namespace abut
