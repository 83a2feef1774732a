#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/detail/surface/reported_contacts.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/query/each_contact.hpp>

namespace abut::detail {
namespace {

/// The limit on further passes over the parts for the next ghosts in their order. The remaining ghosts are reported in
/// the order of the parts.
constexpr int max_passes = 16;

/// The pairs of parts of a composite shape and a convex one, found once for several passes.
template <int D>
class PartPairCache {
public:
    /// Returns false if they can't be cached. Parts within `reach` of the contact are cached too.
    bool fill(const View<D>& a, const View<D>& b, double margin, double reach) {
        const auto *of_a = std::get_if<Composite<D>>(&a), *of_b = std::get_if<Composite<D>>(&b);
        a_is_composite_ = of_a != nullptr;
        convex_ = std::get_if<Convex<D>>(a_is_composite_ ? &b : &a);
        const Composite<D>* const composite = a_is_composite_ ? of_a : of_b;
        if (composite == nullptr || convex_ == nullptr) return false;
        const Aabb<D> box = bounds(*convex_);
        box_ = grown(box, static_cast<float>(margin));
        return parts_.fill(*composite, grown(box, static_cast<float>(margin + reach)));
    }

    const PartCache<D>& parts() const { return parts_; }

    /// visit(part_a, index_a, part_b, index_b); false stops.
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::uint32_t i = 0; i < parts_.size(); ++i) {
            if (!overlaps(parts_.box(i), box_)) continue;
            const Part<D> part(parts_.part(i)), other(*convex_);
            const bool go_on =
                a_is_composite_ ? visit(part, parts_.index(i), other, 0u) : visit(other, 0u, part, parts_.index(i));
            if (!go_on) return;
        }
    }

private:
    PartCache<D> parts_;
    const Convex<D>* convex_ = nullptr;
    Aabb<D> box_;
    bool a_is_composite_ = false;
};

/// Reports first the contacts with surface normals, in the order of the parts. Then it reports the ghosts that no
/// reported contact covers, in an order of their own, so that the numbering of the parts has no influence.
template <int D>
class ContactReporter {
public:
    ContactReporter(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                    const NeighbourSurfaces<D>& neighbours,
                    FunctionRef<bool(const Contact<D>&, const detail::SurfaceNormalFlags&)> visit)
        : a_(a), b_(b), options_(options), filter_(a, b, neighbours), visit_(visit) {
        is_cached_ = cache_.fill(a, b, static_cast<double>(options.margin), filter_.reach());
        if (is_cached_) filter_.use_cache(cache_.parts());
    }

    void report() {
        visit_pairs(
            [&](const PartContact<D>& found, const Contact<D>& contact) {
                surface_contacts_.add(found.distance.normal, -found.distance.distance);
                return go_on_ = visit_(contact, detail::SurfaceNormalFlags{});
            },
            [&](const Ghost<D>& ghost) {
                if (!is_reported(ghost)) ghosts_.add(ghost);
                return true;
            });
        for (int pass = 0; go_on_ && !ghosts_.all().empty(); ++pass) {
            if (surface_contacts_.is_full()) mark_reported();
            report_ghosts();
            if (!go_on_ || !ghosts_.is_truncated()) return;
            if (pass == max_passes) return report_all_after(ghosts_.all().back());
            find_next(Ghost<D>(ghosts_.all().back()));
        }
    }

private:
    using AtSurfaceContact = FunctionRef<bool(const PartContact<D>& found, const Contact<D>& contact)>;
    using AtGhost = FunctionRef<bool(const Ghost<D>& ghost)>;

    /// Calls at_surface_contact(found, contact) or at_ghost(ghost) for each pair of parts; they return false to stop.
    void visit_pairs(AtSurfaceContact at_surface_contact, AtGhost at_ghost) {
        const SearchOptions<D> search = search_options(a_, b_, options_);
        const auto visit = [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b,
                               std::uint32_t index_b) {
            return visit_pair(part_a, index_a, part_b, index_b, search, at_surface_contact, at_ghost);
        };
        if (is_cached_)
            cache_.each(visit);
        else
            detail::for_each_part_pair(a_, b_, options_.margin, visit);
    }
    bool visit_pair(const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b,
                    const SearchOptions<D>& search, AtSurfaceContact at_surface_contact, AtGhost at_ghost) {
        const double margin = static_cast<double>(options_.margin);
        PartContact<D> found;
        if (!part_distance_within<D>(part_a, part_b, margin, margin, search, found)) return true;
        if (!touch_at_fronts<D>(part_a, part_b, found.distance.normal)) return true;
        const auto manifold = [&]() -> const Manifold<D>& {
            add_points<D>(part_a, part_b, margin, search, found);
            return found.manifold;
        };
        const auto write_to = [&](Contact<D>& contact) {
            write(found.distance, found.manifold, contact);
            name_features(part_a, part_b, found.distance, index_a, index_b, contact);
        };
        const detail::SurfaceNormalFlags flags = filter_.surface_normal_flags(part_a, part_b, found.distance, manifold);
        if (flags) {
            manifold();
            Contact<D> contact;
            write_to(contact);
            return at_surface_contact(found, contact);
        }
        if (!filter_.replace(part_a, part_b, flags, found)) manifold();
        if (found.distance.distance > margin) return true;
        Ghost<D> ghost{{}, flags, found.distance.normal, -found.distance.distance, false};
        write_to(ghost.contact);
        return at_ghost(ghost);
    }

    bool is_reported(const Ghost<D>& ghost) const {
        return surface_contacts_.has(ghost.normal, ghost.depth, filter_.size()) ||
               replacements_.has(ghost.normal, ghost.depth, filter_.size());
    }
    bool report(const Ghost<D>& ghost) {
        if (ghost.reported || is_reported(ghost)) return true;
        replacements_.add(ghost.normal, ghost.depth);
        return go_on_ = visit_(ghost.contact, ghost.surface_normals);
    }
    void report_ghosts() {
        for (const Ghost<D>& ghost : ghosts_.all())
            if (!report(ghost)) return;
    }

    /// Marks the ghosts that are covered by surface contacts beyond the capacity.
    void mark_reported() {
        visit_pairs(
            [&](const PartContact<D>& found, const Contact<D>&) {
                const SignedDistance<D>& distance = found.distance;
                for (Ghost<D>& ghost : ghosts_.all())
                    ghost.reported = ghost.reported || covers_contact(distance.normal, -distance.distance, ghost.normal,
                                                                      ghost.depth, filter_.size());
                return true;
            },
            [](const Ghost<D>&) { return true; });
    }
    void find_next(const Ghost<D>& last) {
        ghosts_.clear();
        visit_pairs([](const PartContact<D>&, const Contact<D>&) { return true; },
                    [&](const Ghost<D>& ghost) {
                        if (comes_before(last, ghost) && !is_reported(ghost)) ghosts_.add(ghost);
                        return true;
                    });
    }
    void report_all_after(const Ghost<D>& last) {
        visit_pairs([](const PartContact<D>&, const Contact<D>&) { return true; },
                    [&](const Ghost<D>& ghost) { return !comes_before(last, ghost) || report(ghost); });
    }

    const View<D>&a_, &b_;
    const QueryOptions<D>& options_;
    EdgeFilter<D> filter_;
    PartPairCache<D> cache_;
    FunctionRef<bool(const Contact<D>&, const detail::SurfaceNormalFlags&)> visit_;
    ReportedNormals<D> surface_contacts_, replacements_;
    DeepestGhosts<D> ghosts_;
    bool go_on_ = true;
    bool is_cached_ = false;
};

}  // namespace

template <int D>
void each_contact_with_neighbours(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                                  const NeighbourSurfaces<D>& neighbours,
                                  FunctionRef<bool(const Contact<D>&, const detail::SurfaceNormalFlags&)> visit) {
    if (are_solids(a, b)) {
        if (const Contact<D> only = contact(a, b, options)) visit(only, {});
        return;
    }
    ContactReporter<D>(a, b, options, neighbours, visit).report();
}

template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit) {
    if (!detail::is_valid_pair(a, b)) return;
    each_contact_with_neighbours<D>(
        a, b, options, {},
        [&](const Contact<D>& contact, const detail::SurfaceNormalFlags&) { return visit(contact); });
}

#define ABUT_INSTANTIATE(D)                                                                  \
    template void each_contact_with_neighbours(                                              \
        const View<D>&, const View<D>&, const QueryOptions<D>&, const NeighbourSurfaces<D>&, \
        FunctionRef<bool(const Contact<D>&, const detail::SurfaceNormalFlags&)>);            \
    template void each_contact_of(const View<D>&, const View<D>&, const QueryOptions<D>&,    \
                                  FunctionRef<bool(const Contact<D>&)>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
