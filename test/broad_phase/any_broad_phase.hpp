#pragma once

// One type for all broad phases, so that a test compiles once for a dimension and runs for each of them.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/interface.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace abut::test {

/// A broad phase of the type that `of` names; brute force by default. Copies have the same type.
template <int D>
class AnyBroadPhase : public detail::BroadPhaseInterface<AnyBroadPhase<D>, D> {
public:
    template <BroadPhase<D> T>
    static AnyBroadPhase of() {
        return AnyBroadPhase(std::make_unique<Holder<T>>());
    }
    AnyBroadPhase() : AnyBroadPhase(std::make_unique<Holder<BruteForce<D>>>()) {}
    AnyBroadPhase(const AnyBroadPhase& other) : held_(other.held_->copy()) {}
    AnyBroadPhase& operator=(const AnyBroadPhase& other) {
        held_ = other.held_->copy();
        return *this;
    }

    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr) { held_->build(boxes, executor); }
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr) { held_->update(boxes, executor); }
    std::size_t size() const { return held_->size(); }
    Aabb<D> bounds() const { return held_->bounds(); }

private:
    friend detail::BroadPhaseInterface<AnyBroadPhase, D>;

    struct Held {
        virtual ~Held() = default;
        virtual std::unique_ptr<Held> copy() const = 0;
        virtual void build(std::span<const Aabb<D>> boxes, Executor* executor) = 0;
        virtual void update(std::span<const Aabb<D>> boxes, Executor* executor) = 0;
        virtual std::size_t size() const = 0;
        virtual Aabb<D> bounds() const = 0;
        virtual void each_pair(detail::PairsCall visit, Executor* executor) const = 0;
        virtual void each_overlapping_pair(const Held& other, detail::PairsCall visit) const = 0;
        virtual void each_box(detail::BoxCall<D> visit) const = 0;
        virtual void each_overlapping(const Aabb<D>& box, detail::ItemCall visit) const = 0;
        virtual void raycast(const Ray<D>& ray, detail::ReachCall visit) const = 0;
        virtual void sweep(const MovingBox<D>& box, detail::ReachCall visit) const = 0;
        virtual void closest(const Aabb<D>& box, float reach, detail::ReachCall visit) const = 0;
    };

    template <class T>
    struct Holder final : Held {
        std::unique_ptr<Held> copy() const override { return std::make_unique<Holder>(*this); }
        void build(std::span<const Aabb<D>> boxes, Executor* executor) override { phase.build(boxes, executor); }
        void update(std::span<const Aabb<D>> boxes, Executor* executor) override { phase.update(boxes, executor); }
        std::size_t size() const override { return phase.size(); }
        Aabb<D> bounds() const override { return phase.bounds(); }
        void each_pair(detail::PairsCall visit, Executor* executor) const override { phase.each_pair(visit, executor); }
        void each_overlapping_pair(const Held& other, detail::PairsCall visit) const override {
            phase.each_overlapping_pair(static_cast<const Holder&>(other).phase, visit);
        }
        void each_box(detail::BoxCall<D> visit) const override { phase.each_box(visit); }
        void each_overlapping(const Aabb<D>& box, detail::ItemCall visit) const override {
            phase.each_overlapping(box, visit);
        }
        void raycast(const Ray<D>& ray, detail::ReachCall visit) const override { phase.raycast(ray, visit); }
        void sweep(const MovingBox<D>& box, detail::ReachCall visit) const override { phase.sweep(box, visit); }
        void closest(const Aabb<D>& box, float reach, detail::ReachCall visit) const override {
            phase.closest(box, visit, reach);
        }

        T phase;
    };

    explicit AnyBroadPhase(std::unique_ptr<Held> held) : held_(std::move(held)) {}

    void visit_pairs(detail::PairsCall visit, Executor* executor) const { held_->each_pair(visit, executor); }
    void visit_pairs(const AnyBroadPhase& other, detail::PairsCall visit) const {
        held_->each_overlapping_pair(*other.held_, visit);
    }
    void visit_boxes(detail::BoxCall<D> visit) const { held_->each_box(visit); }
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const { held_->each_overlapping(box, visit); }
    void visit_along(const Ray<D>& ray, detail::ReachCall visit) const { held_->raycast(ray, visit); }
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const { held_->sweep(box, visit); }
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const {
        held_->closest(box, reach, visit);
    }

    std::unique_ptr<Held> held_;
};

}  // namespace abut::test
