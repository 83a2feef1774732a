// The contacts of a query shape with the items of a world, without ghost collisions at the internal edges between them.

#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/world/world.hpp>

namespace abut {

using namespace detail;

namespace {

/// The contacts of a shape with items that are one surface for it. EachItem calls a visitor with (id, view) for the
/// items whose AABBs overlap a box.
template <int D, class EachItem>
class QueryContacts {
public:
    QueryContacts(const View<D>& shape, const QueryOptions<D>& options, const EachItem& each_item)
        : shape_(shape), options_(options), box_(grown(bounds(shape), options.margin)), each_item_(each_item) {}

    void report(FunctionRef<bool(Id, const Contact<D>&)> visit) const {
        each_item_(box_, [&](Id id, const View<D>& item) {
            bool go_on = true;
            each_of_item(id, item, [&](const SurfaceContact<D>& found) {
                if (found.surface_normals || !is_covered(id, found))
                    go_on = visit(id, found.contact);
                else if (found.own_area)
                    go_on = visit(id, found.own_area);
                return go_on;
            });
            return go_on;
        });
    }

private:
    /// The contacts of the shape with an item; the other items continue its surface.
    void each_of_item(Id id, const View<D>& item, FunctionRef<bool(const SurfaceContact<D>&)> visit) const {
        if (std::holds_alternative<HalfSpaceView<D>>(shape_) && std::holds_alternative<HalfSpaceView<D>>(item)) return;
        const auto beside = [&](const DVec<D>& point, double within, ClosestPointVisitor<D> visit_point) {
            each_item_(box_around(point, within), [&](Id other, const View<D>& neighbour) {
                if (other != id)
                    each_closest_point_on<D>(neighbour, point, within, [&](const ClosestPoint<D>& closest) {
                        return within = visit_point(closest);
                    });
                return within > stop_visiting;
            });
        };
        const EachClosestPoint<D> neighbours(beside);
        each_surface_contact<D>(shape_, item, options_, {.of_a = &neighbours}, visit);
    }

    /// Whether a contact with another item covers a ghost. Of ghosts that cover each other, the one of the lowest id is
    /// reported.
    bool is_covered(Id id, const SurfaceContact<D>& ghost) const {
        bool covered = false;
        each_item_(box_, [&](Id other, const View<D>& item) {
            if (other == id) return true;
            each_of_item(other, item, [&](const SurfaceContact<D>& found) {
                covered = (found.surface_normals || other < id) &&
                          covers_contact<D>(DVec<D>(found.contact.normal), static_cast<double>(found.contact.depth),
                                            DVec<D>(ghost.contact.normal), static_cast<double>(ghost.contact.depth),
                                            ghost.size);
                return !covered;
            });
            return !covered;
        });
        return covered;
    }

    const View<D>& shape_;
    const QueryOptions<D>& options_;
    Aabb<D> box_;
    const EachItem& each_item_;
};

}  // namespace

template <int D>
void World<D>::visit_contacts(const View<D>& shape, const Query& query, const QueryOptions<D>& options,
                              FunctionRef<bool(Id, const Contact<D>&)> visit) const {
    if (!detail::is_valid_query(shape)) return;
    const auto each_item = [&](const Aabb<D>& box, FunctionRef<bool(Id, const View<D>&)> visit_item) {
        visit_in_box(box, query, visit_item);
    };
    QueryContacts<D, decltype(each_item)>(shape, options, each_item).report(visit);
}

template void World<2>::visit_contacts(const View<2>&, const Query&, const QueryOptions<2>&,
                                       FunctionRef<bool(Id, const Contact<2>&)>) const;
template void World<3>::visit_contacts(const View<3>&, const Query&, const QueryOptions<3>&,
                                       FunctionRef<bool(Id, const Contact<3>&)>) const;

}  // namespace abut
