#pragma once

// The public member functions that all broad phases share.

#include <abut/broad_phase/detail/sort_pairs.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/simd/upper_halves.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut::detail {

/// The queries of a broad phase; concept.hpp documents each. `Phase` derives from this class (CRTP), declares it a
/// friend, and implements `visit_...` functions that take type-erased visitors, so that they compile in a .cpp file.
template <class Phase, int D>
class BroadPhaseInterface {
public:
    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        phase().visit_pairs(batch_visitor(visit), executor);
    }
    /// Passes the pairs in batches, which saves a call for each pair.
    void each_pair(PairsCall visit, Executor* executor = nullptr) const { phase().visit_pairs(visit, executor); }
    void sorted_pairs(std::vector<ItemPair>& out) const {
        out.clear();
        const auto append = [&out](std::span<const ItemPair> pairs) {
            out.insert(out.end(), pairs.begin(), pairs.end());
            return true;
        };
        phase().visit_pairs(append, nullptr);
        sort_pairs(out);
    }

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_overlapping_pair(const Phase& other, F&& visit) const {
        phase().visit_pairs(other, batch_visitor(visit));
    }
    /// Passes the pairs in batches.
    void each_overlapping_pair(const Phase& other, PairsCall visit) const { phase().visit_pairs(other, visit); }
    template <Visitor<std::uint32_t> F>
    void each_overlapping(const Aabb<D>& box, F&& visit) const {
        phase().visit_overlapping(box, bool_visitor(visit));
    }
    template <ReachVisitor F>
    void raycast(const Ray<D>& ray, F&& visit) const {
        // A phase without a fast path for rays takes them as boxes.
        if constexpr (requires(const Phase& phase, ReachCall call) { phase.visit_along(ray, call); })
            phase().visit_along(ray, reach_visitor(visit));
        else
            sweep({DVec<D>(ray.origin), DVec<D>(0.0), DVec<D>(ray.direction), static_cast<double>(ray.length)}, visit);
    }
    template <ReachVisitor F>
    void sweep(const MovingBox<D>& box, F&& visit) const {
        phase().visit_along(box, reach_visitor(visit));
    }
    template <ReachVisitor F>
    void closest(const Aabb<D>& box, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        phase().visit_near(box, reach, reach_visitor(visit));
    }
    template <ReachVisitor F>
    void closest(const Vec<D>& point, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        phase().visit_near(Aabb<D>{point, point}, reach, reach_visitor(visit));
    }

    /// Calls visit(i, box) for every item that isn't empty, in the structure's own order.
    template <Visitor<std::uint32_t, const Aabb<D>&> F>
    void each_box(F&& visit) const {
        phase().visit_boxes(bool_visitor(visit));
    }

    bool empty() const { return phase().size() == 0; }

private:
    /// Every query passes from the caller's code to the library here, so this clears the upper halves of AVX registers.
    const Phase& phase() const {
        detail::clear_upper_halves();
        return static_cast<const Phase&>(*this);
    }
};

}  // namespace abut::detail
