#pragma once

// The pairs of parts of two shapes, for queries that visit them several times. For .cpp files.

#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/surface/part_cache.hpp>

namespace abut::detail {

/// A pair of parts among all that are visited. Parts of one child of a compound shape share an index.
struct PairPlace {
    std::uint32_t index_a = 0, index_b = 0;
    std::uint32_t number = 0;  ///< of the cached part, or of the visit, which is the same in each pass

    friend bool operator==(const PairPlace&, const PairPlace&) = default;
};

/// The pairs of parts of two shapes, found once for several passes if one shape is composite, with few parts near, and
/// the other convex.
template <int D>
class PartPairs {
public:
    /// Parts within `reach` of the contact are cached too.
    PartPairs(const View<D>& a, const View<D>& b, float margin, double reach)
        : a_(a), b_(b), margin_(margin), a_is_composite_(std::holds_alternative<Composite<D>>(a)) {
        const auto* composite = std::get_if<Composite<D>>(a_is_composite_ ? &a : &b);
        convex_ = std::get_if<Convex<D>>(a_is_composite_ ? &b : &a);
        if (composite == nullptr || convex_ == nullptr) return;
        const Aabb<D> box = bounds(*convex_);
        box_ = grown(box, margin);
        is_cached_ = parts_.fill(*composite, grown(box, static_cast<float>(static_cast<double>(margin) + reach)));
    }

    /// The parts of the composite shape; null if they aren't cached.
    const PartCache<D>* cache() const { return is_cached_ ? &parts_ : nullptr; }

    /// visit(part_a, part_b, place) for at least all pairs that are at most the margin apart; false stops.
    template <class Visit>
    void each(const Visit& visit) const {
        PairPlace place;
        if (!is_cached_) {
            for_each_part_pair(
                a_, b_, margin_,
                [&](const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
                    place.index_a = index_a;
                    place.index_b = index_b;
                    ++place.number;
                    return visit(part_a, part_b, place);
                });
            return;
        }
        parts_.each_overlapping(box_, [&](std::uint32_t i) {
            (a_is_composite_ ? place.index_a : place.index_b) = parts_.index(i);
            place.number = i;
            return visit_cached(place, visit);
        });
    }
    /// visit(part_a, part_b, place) for one of these pairs.
    template <class Visit>
    void at(const PairPlace& place, const Visit& visit) const {
        if (is_cached_)
            visit_cached(place, visit);
        else
            each([&](const Part<D>& part_a, const Part<D>& part_b, const PairPlace& other) {
                if (other == place) visit(part_a, part_b, place);
                return other != place;
            });
    }

private:
    template <class Visit>
    decltype(auto) visit_cached(const PairPlace& place, const Visit& visit) const {
        const Part<D> part(parts_.part(place.number)), other(*convex_);
        return a_is_composite_ ? visit(part, other, place) : visit(other, part, place);
    }

    const View<D>&a_, &b_;
    float margin_;
    bool a_is_composite_, is_cached_ = false;
    PartCache<D> parts_;
    const Convex<D>* convex_ = nullptr;
    Aabb<D> box_;
};

}  // namespace abut::detail
