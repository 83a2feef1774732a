#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/cached_pairs.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>

#include <algorithm>
#include <span>
#include <tuple>

namespace abut::detail {
namespace {

/// Pairs of parts are taken in an order of their own, the deepest first, so that neither the numbers of the parts nor
/// the order of the shapes has an influence. A contact on the plane of one before it is joined to that. Any other one
/// with a surface normal is the first of its plane. Those that are left are ghosts: a ghost adds the area that its
/// parts have on the planes. If it has none there, the plane of the surface near it replaces it, unless a plane with
/// about that normal is as deep.
///
/// A limited number of pairs is stored, the first in that order. If there are more, those after them follow in a
/// further round.
template <int D>
class SurfaceContacts {
public:
    using Visit = FunctionRef<bool(const SurfaceContact<D>&)>;

    SurfaceContacts(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                    const NeighbourSurfaces<D>& neighbours)
        : margin_(static_cast<double>(options.margin)),
          search_(search_options(a, b, options)),
          filter_(a, b, neighbours),
          names_(filter_.a_is_larger() ? ManifoldNames::level_is_a : ManifoldNames::level_is_b),
          pairs_(a, b, options.margin, filter_.reach()) {
        if (pairs_.cache() != nullptr) filter_.use_cache(*pairs_.cache());
    }

    /// Returns whether the shapes touch. Without neighbours, shapes that touch have a contact, at least the deepest
    /// one.
    bool report(bool has_neighbours, Visit visit) {
        bool go_on = true, any = false;
        const auto visit_any = [&](const SurfaceContact<D>& found) {
            any = true;
            return visit(found);
        };
        Pair first;
        do {
            store_touching();
            if (round_ == 1) {
                if (stored_count_ == 0) return false;
                first = stored().front();
            }
            find_planes();
            find_forgotten(first_new_, false);
            go_on = report_planes(first_new_, visit_any);
            if (!go_on) break;
            replace_ghosts();
            const std::size_t first_ghost = plane_count_;
            find_planes_of_ghosts();
            find_forgotten(first_ghost, true);
            go_on = report_planes(first_ghost, visit_any);
        } while (go_on && !is_complete_ && tests_ < max_tests);
        if (!any && !has_neighbours) {
            first.flags = {};
            report_only_plane_of(first, visit);
        }
        return true;
    }

    bool report_plane_of(const PairDistance<D>& deepest, bool keeps_edges, Contact<D>& result) {
        bool is_surface = false;
        Pair first;
        pairs_.each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& place) {
            SignedDistance<D> distance;
            if (place.index_a != deepest.index_a || place.index_b != deepest.index_b ||
                !touch(part_a, part_b, distance) || distance.distance != deepest.distance.distance)
                return true;
            first = Pair(place, deepest.distance);
            is_surface = keeps_edges || flags_of(part_a, part_b, deepest.distance);
            return false;
        });
        if (!is_surface) return false;
        report_only_plane_of(first, [&](const SurfaceContact<D>& found) {
            result = found.contact;
            return false;
        });
        return true;
    }

private:
    enum class Role : std::uint8_t { joined, ghost, used_ghost, dropped };  ///< a used ghost has area on a plane
    struct Pair : PairDistance<D> {
        PairPlace place;
        SurfaceNormalFlags flags;
        bool has_flags = false;
        bool is_replaced = false;  ///< by the plane of the surface
        bool is_on_ridge = false;  ///< of the surface
        bool has_face = false;     ///< on that plane
        Role role = Role::joined;
        std::uint32_t plane = 0;  ///< index of the plane that it is joined to
        DVec<D> area_normal;      ///< of a replaced one, along a face

        Pair() = default;
        explicit Pair(const PairPlace& of, const SignedDistance<D>& found = {})
            : PairDistance<D>{found, of.index_a, of.index_b}, place(of), area_normal(0.0) {}
    };

    /// Equal contacts differ in their parts alone.
    static bool comes_before(const Pair& a, const Pair& b) {
        if (const int by_contact = compare(a.distance, b.distance)) return by_contact < 0;
        if (const int by_face = compare(a.area_normal, b.area_normal)) return by_face < 0;
        return std::tie(a.index_a, a.index_b) < std::tie(b.index_a, b.index_b);
    }

    struct Features {
        Feature feature_a, feature_b;
    };

    static constexpr std::size_t max_pairs = 64, max_old_planes = 32, max_manifolds = 8;
    /// Each round tests all pairs again: of more than about 8,000 that touch, the last ones have no round.
    static constexpr std::size_t max_tests = 1 << 20;

    double step() const { return filter_.scale(); }
    double size_of(const Pair& pair) const {
        return pair.is_on_ridge ? std::numeric_limits<double>::infinity() : filter_.size();
    }

    SurfaceNormalFlags flags_of(const Part<D>& part_a, const Part<D>& part_b, const SignedDistance<D>& distance) const {
        PartContact<D> found{distance, {}};
        return filter_.surface_normal_flags(part_a, part_b, distance, [&]() -> const Manifold<D>& {
            add_points<D>(part_a, part_b, margin_, search_, found);
            return found.manifold;
        });
    }

    /// Whether two parts touch, with their fronts, and then their distance.
    bool touch(const Part<D>& part_a, const Part<D>& part_b, SignedDistance<D>& distance) const {
        PartContact<D> found;
        if (!part_distance_within<D>(part_a, part_b, margin_, margin_, search_, found)) return false;
        distance = found.distance;
        return touch_at_fronts<D>(part_a, part_b, distance.normal);
    }

    std::span<Pair> stored() { return {stored_.data(), stored_count_}; }
    std::span<const ContactPlane<D>> planes() const { return {planes_.data(), plane_count_}; }
    const Pair& deepest_on(std::size_t plane) const { return stored_[deepest_[plane - first_new_]]; }

    Pair* find(const PairPlace& place) {
        const auto found =
            std::find_if(stored().begin(), stored().end(), [&](const Pair& pair) { return pair.place == place; });
        return found != stored().end() ? &*found : nullptr;
    }
    /// visit(part_a, part_b, pair) for the stored pairs. Parts that aren't cached are there during their visit alone.
    template <class Visit>
    void each_stored(const Visit& visit) {
        if (pairs_.cache() != nullptr) {
            for (Pair& pair : stored())
                pairs_.at(pair.place, [&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace&) {
                    visit(part_a, part_b, pair);
                });
            return;
        }
        pairs_.each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& place) {
            if (Pair* const pair = find(place)) visit(part_a, part_b, *pair);
            return true;
        });
    }
    /// The same for all touching pairs. One that isn't stored counts as a ghost, unless it is on a plane.
    template <class Visit>
    void each_touching(const Visit& visit) {
        if (is_single_round_) return each_stored(visit);
        pairs_.each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& place) {
            if (Pair* const pair = find(place)) {
                visit(part_a, part_b, *pair);
            } else if (Pair other(place); touch(part_a, part_b, other.distance)) {
                other.plane = static_cast<std::uint32_t>(plane_of(other.distance));
                other.role = other.plane < plane_count_ ? Role::joined : Role::ghost;
                visit(part_a, part_b, other);
            }
            return true;
        });
    }
    /// The index of the first plane that a contact is on; plane_count_ if there is none.
    std::size_t plane_of(const SignedDistance<D>& distance) const {
        const auto place = std::find_if(planes().begin(), planes().end(),
                                        [&](const ContactPlane<D>& plane) { return plane.has(distance); });
        return static_cast<std::size_t>(place - planes().begin());
    }

    /// Stores the first touching pairs after those of the last round.
    void store_touching() {
        const bool is_first = round_++ == 0;
        before_ = last_;
        stored_count_ = 0;
        is_complete_ = true;
        pairs_.each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& place) {
            Pair pair(place);
            ++tests_;
            if (!touch(part_a, part_b, pair.distance)) return true;
            if (!is_first && !comes_before(before_, pair)) return true;
            is_complete_ = is_complete_ && stored_count_ < max_pairs;
            const auto after = std::upper_bound(stored().begin(), stored().end(), pair, comes_before);
            if (after == stored().end() && stored_count_ == max_pairs) return true;
            // Parts that aren't cached are there during the visit alone.
            if (pairs_.cache() == nullptr) {
                pair.flags = flags_of(part_a, part_b, pair.distance);
                pair.has_flags = true;
            }
            const auto index = after - stored().begin();
            stored_count_ = std::min(stored_count_ + 1, max_pairs);
            std::move_backward(stored().begin() + index, stored().end() - 1, stored().end());
            stored()[static_cast<std::size_t>(index)] = pair;
            return true;
        });
        is_single_round_ = is_first && is_complete_;
        if (stored_count_ > 0) last_ = stored().back();
        if (plane_count_ > max_old_planes) {  // the planes of the first rounds are forgotten
            std::copy_n(planes_.data() + plane_count_ - max_old_planes, max_old_planes, planes_.data());
            plane_count_ = max_old_planes;
            has_forgotten_ = true;
        }
        first_new_ = plane_count_;
    }

    /// Adds the plane of a stored pair, the deepest on it.
    void add_plane(const Pair& deepest) {
        is_reported_[plane_count_ - first_new_] = false;
        deepest_[plane_count_ - first_new_] = static_cast<std::uint32_t>(&deepest - stored_.data());
        planes_[plane_count_++] = ContactPlane<D>(deepest.distance, step());
    }

    const SurfaceNormalFlags& flags(Pair& pair) {
        if (pair.has_flags) return pair.flags;
        pair.has_flags = true;
        pairs_.at(pair.place, [&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace&) {
            pair.flags = flags_of(part_a, part_b, pair.distance);
        });
        return pair.flags;
    }

    void find_planes() {
        for (Pair& pair : stored()) {
            const std::size_t plane = plane_of(pair.distance);
            pair.role = plane < first_new_ ? Role::dropped : Role::joined;
            pair.plane = static_cast<std::uint32_t>(plane);
            if (plane < plane_count_) continue;
            if (flags(pair))
                add_plane(pair);
            else
                pair.role = Role::ghost;
        }
        join_equally_deep();
    }

    /// Joins ghosts to planes as deep, whichever of them came first.
    void join_equally_deep() {
        for (Pair& pair : stored()) {
            if (pair.role != Role::ghost || pair.is_replaced) continue;
            const auto plane = std::find_if(planes().begin(), planes().end(), [&](const ContactPlane<D>& each) {
                return each.depth == -pair.distance.distance && each.has(pair.distance);
            });
            if (plane == planes().end()) continue;
            pair.role = Role::joined;
            pair.plane = static_cast<std::uint32_t>(plane - planes().begin());
        }
    }

    void report_only_plane_of(const Pair& deepest, Visit visit) {
        stored_[0] = deepest;
        stored_count_ = 1;
        is_single_round_ = false;
        first_new_ = plane_count_ = 0;
        add_plane(stored_[0]);
        report_planes(0, visit);
    }

    /// Finds the planes from `first` on that an earlier round reported and forgot: those that have a surface contact,
    /// or for planes of ghosts any contact, of a pair of that round.
    void find_forgotten(std::size_t first, bool are_ghosts) {
        if (!has_forgotten_ || first == plane_count_) return;
        pairs_.each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& place) {
            Pair other(place);
            if (!touch(part_a, part_b, other.distance) || comes_before(before_, other)) return true;
            other.flags = flags_of(part_a, part_b, other.distance);
            if (!other.flags && !(are_ghosts && filter_.replace(part_a, part_b, other.flags, other.distance) ==
                                                    PairEdgeFilter<D>::Substitute::plane))
                return true;
            const ContactPlane<D> plane(other.distance, step());
            for (std::size_t i = first; i < plane_count_; ++i)
                is_reported_[i - first_new_] |= plane.has(deepest_on(i).distance);
            return true;
        });
    }

    /// Joins the pairs of parts to the planes from `first` on, and reports these.
    bool report_planes(std::size_t first, Visit visit) {
        for (; first < plane_count_; first += max_manifolds) {
            const std::size_t count = std::min(plane_count_ - first, max_manifolds);
            for (std::size_t i = 0; i < count; ++i)
                manifolds_[i].begin(area_pair(deepest_on(first + i)), step(), names_, margin_);
            each_touching([&](const Part<D>& part_a, const Part<D>& part_b, Pair& pair) {
                add_to_manifolds(part_a, part_b, pair, first, count);
            });
            for (std::size_t i = 0; i < count; ++i)
                if (!is_reported_[first + i - first_new_] &&
                    !report_plane(deepest_on(first + i), features_[i], manifolds_[i], visit))
                    return false;
        }
        return true;
    }

    void add_to_manifolds(const Part<D>& part_a, const Part<D>& part_b, Pair& pair, std::size_t first,
                          std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const Pair& deepest = deepest_on(first + i);
            if (deepest.place == pair.place)
                name_features(part_a, part_b, deepest.distance, pair.index_a, pair.index_b, features_[i]);
        }
        if (pair.role == Role::joined && pair.plane >= first && pair.plane - first < count)
            return manifolds_[pair.plane - first].add(part_a, part_b, pair);
        if (pair.role != Role::ghost && pair.role != Role::used_ghost) return;
        const FaceNormals<D> level_faces(names_ == ManifoldNames::level_is_a ? part_a : part_b);
        for (std::size_t i = 0; i < count; ++i) {
            if (!level_faces.may_face(manifolds_[i].plane().normal)) continue;
            const ManifoldCandidates<D> area = manifolds_[i].area(part_a, part_b, pair.index_a, pair.index_b);
            if (area.count == 0) continue;
            if (!pair.has_flags && flags_of(part_a, part_b, pair.distance)) return;
            manifolds_[i].add(area);
            pair.role = Role::used_ghost;
        }
    }

    static PairDistance<D> area_pair(const Pair& deepest) {
        PairDistance<D> result = deepest;
        if (deepest.is_replaced) result.distance.normal = deepest.area_normal;
        return result;
    }

    bool report_plane(const Pair& deepest, const Features& features, SurfaceManifold<D>& manifold, Visit visit) {
        SurfaceContact<D> found;
        found.surface_normals = deepest.flags;
        found.size = size_of(deepest);
        found.contact.feature_a = features.feature_a;
        found.contact.feature_b = features.feature_b;
        if (!deepest.flags) {
            if (deepest.has_face && manifold.has_extent()) {
                found.own_area = found.contact;
                manifold.write(found.own_area);
            }
            manifold.add_deepest(deepest);
        }
        manifold.write(found.contact);
        found.contact.normal = to_float(deepest.distance.normal);
        return visit(found);
    }

    void replace_ghosts() {
        each_stored([&](const Part<D>& part_a, const Part<D>& part_b, Pair& pair) {
            if (pair.role != Role::ghost) return;
            const auto substitute = filter_.replace(part_a, part_b, pair.flags, pair.distance);
            pair.is_replaced = substitute == PairEdgeFilter<D>::Substitute::plane;
            pair.is_on_ridge = substitute == PairEdgeFilter<D>::Substitute::ridge;
            const std::optional<DVec<D>> face = face_normal<D>(part_a, part_b, pair.flags, {pair.distance, step()});
            pair.has_face = face.has_value();
            pair.area_normal = face.value_or(pair.distance.normal);
            if (pair.distance.distance > margin_) pair.role = Role::dropped;
        });
        std::sort(stored().begin(), stored().end(), comes_before);
    }

    void find_planes_of_ghosts() {
        for (Pair& ghost : stored()) {
            if (ghost.role != Role::ghost) continue;
            const bool is_covered = std::any_of(planes().begin(), planes().end(), [&](const ContactPlane<D>& plane) {
                return covers_contact<D>(plane.normal, plane.depth, ghost.distance.normal, -ghost.distance.distance,
                                         size_of(ghost));
            });
            if (is_covered) continue;
            if (!ghost.is_replaced) {
                ghost.role = Role::joined;
                ghost.plane = static_cast<std::uint32_t>(plane_count_);
            }
            add_plane(ghost);
        }
        join_equally_deep();
    }

    double margin_;
    SearchOptions<D> search_;
    PairEdgeFilter<D> filter_;
    ManifoldNames names_;
    PartPairs<D> pairs_;
    int round_ = 0;
    std::size_t tests_ = 0;
    bool is_complete_ = false;      ///< no touching pair comes after the stored ones
    bool is_single_round_ = false;  ///< all touching pairs are stored
    bool has_forgotten_ = false;    ///< planes of earlier rounds
    Pair last_;                     ///< the last one stored
    Pair before_;                   ///< the last one of the round before
    std::size_t stored_count_ = 0, plane_count_ = 0;
    std::size_t first_new_ = 0;  ///< the first plane of this round
    UninitializedArray<Pair, max_pairs> stored_;
    UninitializedArray<ContactPlane<D>, max_old_planes + max_pairs> planes_;
    std::array<bool, max_pairs> is_reported_;
    std::array<std::uint32_t, max_pairs> deepest_;  ///< indices of the deepest pairs on the planes of this round
    UninitializedArray<SurfaceManifold<D>, max_manifolds> manifolds_;
    std::array<Features, max_manifolds> features_;
};

/// Two shapes of one part each.
template <int D>
bool report_single(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                   const NeighbourSurfaces<D>& neighbours, FunctionRef<bool(const SurfaceContact<D>&)> visit) {
    DeepestParts<D> own;
    Contact<D> contact;
    if (!find_deepest_parts(a, b, options, own, contact)) return false;
    const SurfaceContact<D> found =
        filtered_contact(a, b, own.contact, contact, neighbours, static_cast<double>(options.margin));
    if (found.contact) visit(found);
    return true;
}

}  // namespace

template <int D>
SurfaceContact<D> filtered_contact(const View<D>& a, const View<D>& b, const PartContact<D>& own,
                                   const Contact<D>& contact, const NeighbourSurfaces<D>& neighbours, double margin) {
    SurfaceContact<D> result{contact, {}, {}, 0};
    const Part<D> part_a = single_part(a), part_b = single_part(b);
    PairEdgeFilter<D> filter(a, b, neighbours);
    const SurfaceNormalFlags flags =
        filter.surface_normal_flags(part_a, part_b, own.distance, [&]() -> const Manifold<D>& { return own.manifold; });
    if (flags) return result;
    PairDistance<D> pair{own.distance};
    using Substitute = typename PairEdgeFilter<D>::Substitute;
    const Substitute substitute = filter.replace(part_a, part_b, flags, pair.distance);
    if (pair.distance.distance > margin) {
        result.contact = {};
        return result;
    }
    result.surface_normals = flags;
    result.size = substitute == Substitute::ridge ? std::numeric_limits<double>::infinity() : filter.size();
    if (substitute != Substitute::plane) return result;
    const double step = filter.scale();
    const std::optional<DVec<D>> face = face_normal<D>(part_a, part_b, flags, {pair.distance, step});
    name_features(part_a, part_b, pair.distance, 0, 0, result.contact);
    PairDistance<D> area = pair;
    area.distance.normal = face.value_or(pair.distance.normal);
    SurfaceManifold<D> manifold;
    manifold.begin(area, step, ManifoldNames::single_parts, margin);
    if (face) manifold.add(manifold.area(part_a, part_b, 0, 0));
    if (manifold.has_extent()) {
        result.own_area = result.contact;
        manifold.write(result.own_area);
    }
    if (!face) pair.distance.corners = {};  // the surface there is another shape's, whose corners are unknown
    manifold.add_deepest(pair);
    manifold.write(result.contact);
    result.contact.normal = to_float(pair.distance.normal);
    return result;
}

template <int D>
bool each_surface_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                          const NeighbourSurfaces<D>& neighbours, FunctionRef<bool(const SurfaceContact<D>&)> visit) {
    if constexpr (D == 3) {
        bool touch = false;
        const auto report = [&](const Contact<D>& contact) { return visit({contact, {}, {}, 0}); };
        if (has_solid(a, b) && each_solid_contact(a, b, options.margin, report, touch)) return touch;
    }
    if (std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b))
        return SurfaceContacts<D>(a, b, options, neighbours)
            .report(neighbours.of_a != nullptr || neighbours.of_b != nullptr, visit);
    return report_single(a, b, options, neighbours, visit);
}

template <int D>
bool whole_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const DeepestParts<D>& deepest,
                   bool keeps_edges, Contact<D>& result) {
    return SurfaceContacts<D>(a, b, options, {})
        .report_plane_of({deepest.contact.distance, deepest.index_a, deepest.index_b}, keeps_edges, result);
}

#define ABUT_INSTANTIATE(D)                                                                                           \
    template bool each_surface_contact(const View<D>&, const View<D>&, const QueryOptions<D>&,                        \
                                       const NeighbourSurfaces<D>&, FunctionRef<bool(const SurfaceContact<D>&)>);     \
    template SurfaceContact<D> filtered_contact(const View<D>&, const View<D>&, const PartContact<D>&,                \
                                                const Contact<D>&, const NeighbourSurfaces<D>&, double);              \
    template bool whole_contact(const View<D>&, const View<D>&, const QueryOptions<D>&, const DeepestParts<D>&, bool, \
                                Contact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
