#pragma once

// What every broad phase shows its users.

#include <abut/broad_phase/sort_pairs.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/simd/upper_halves.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut {

/// The questions to a broad phase (concept.hpp tells what each function does). `Phase` derives from this, lets it be a
/// friend, and has functions `visit_...` that take visitors in the form in which they reach a .cpp file.
template <class Phase, int D>
class BroadPhaseFace {
public:
    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        phase().visit_pairs(each_pair_to(visit), executor);
    }
    /// The same, some pairs at a time: spares a call for each.
    void each_pair(PairsCall visit, Executor* executor = nullptr) const { phase().visit_pairs(visit, executor); }
    void sorted_pairs(std::vector<ItemPair>& out) const {
        out.clear();
        const auto keep = [&out](std::span<const ItemPair> pairs) {
            out.insert(out.end(), pairs.begin(), pairs.end());
            return true;
        };
        phase().visit_pairs(keep, nullptr);
        sort_pairs(out);
    }

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_overlapping_pair(const Phase& other, F&& visit) const {
        phase().visit_pairs(other, each_pair_to(visit));
    }
    /// The same, some pairs at a time.
    void each_overlapping_pair(const Phase& other, PairsCall visit) const { phase().visit_pairs(other, visit); }
    template <Visitor<std::uint32_t> F>
    void each_overlapping(const Aabb<D>& box, F&& visit) const {
        phase().visit_overlapping(box, go_on_after(visit));
    }
    template <ReachVisitor F>
    void raycast(const Ray<D>& ray, F&& visit) const {
        phase().visit_along(ray, reach_after(visit));
    }
    template <ReachVisitor F>
    void sweep(const MovingBox<D>& box, F&& visit) const {
        phase().visit_along(box, reach_after(visit));
    }
    template <ReachVisitor F>
    void closest(const Aabb<D>& box, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        phase().visit_near(box, reach, reach_after(visit));
    }
    template <ReachVisitor F>
    void closest(const Vec<D>& point, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        phase().visit_near(Aabb<D>{point, point}, reach, reach_after(visit));
    }

    /// visit(i, box) for every item that isn't empty, in an order of the structure's own.
    template <Visitor<std::uint32_t, const Aabb<D>&> F>
    void each_box(F&& visit) const {
        phase().visit_boxes(go_on_after(visit));
    }

    bool empty() const { return phase().size() == 0; }

private:
    /// All questions pass from the caller's code to the library here.
    const Phase& phase() const {
        detail::clear_upper_halves();
        return static_cast<const Phase&>(*this);
    }
};

}  // namespace abut
