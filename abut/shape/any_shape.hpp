#pragma once

// A type-erased shape that owns its data.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>

#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace abut::detail {

/// The base of what a CountedPointer owns.
class Counted {
public:
    Counted() = default;
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

    void add_owner() const { owners_.fetch_add(1, std::memory_order_relaxed); }
    /// Whether it has several owners.
    bool is_shared() const { return owners_.load(std::memory_order_acquire) > 1; }
    /// Whether it was the last one.
    bool remove_owner() const { return owners_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

private:
    mutable std::atomic<std::uint32_t> owners_ = 0;
};

/// Half the size of a std::shared_ptr, and the object needs no block beside it. Up to 2^32 - 1 owners.
template <class T>
class CountedPointer {
public:
    /// Of an object made by `new`.
    explicit CountedPointer(T* object) : object_(object) { add_owner(); }
    CountedPointer(const CountedPointer& other) noexcept : object_(other.object_) { add_owner(); }
    CountedPointer(CountedPointer&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    CountedPointer& operator=(CountedPointer other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~CountedPointer() {
        if (object_ != nullptr && object_->remove_owner()) delete object_;
    }

    T& operator*() const { return *object_; }
    T* operator->() const { return object_; }
    /// Whether both own the same object.
    bool operator==(const CountedPointer&) const = default;

private:
    void add_owner() const {
        if (object_ != nullptr) object_->add_owner();
    }

    T* object_;  // null only where it was moved from
};

/// The bounding box without a view, bit for bit that of the view. It is empty if a number of the shape or the pose is
/// NaN or infinite. `grow` adds a margin on each side, 1e-6 of the sum of the box's widths.
template <int D>
Aabb<D> bounds_at(const Ball<D>& ball, const Pose<D>& pose, bool grow);
template <int D>
Aabb<D> bounds_at(const Box<D>& box, const Pose<D>& pose, bool grow);
template <int D>
Aabb<D> bounds_at(const Capsule<D>& capsule, const Pose<D>& pose, bool grow);
template <int D>
Aabb<D> bounds_at(const View<D>& placed, bool grow);

}  // namespace abut::detail

namespace abut {

/// Any shape of a dimension as a value. Queries give the same answers as for the shape it was made from. It owns
/// its data, so it can't be made of a view. Copies share the data.
template <int D>
class AnyShape {
public:
    template <class S>
    requires(!std::is_same_v<S, AnyShape> && Ownable<S> && dimension<S> == D) AnyShape(const S& shape)
        : stored_(store(owned(shape))) {}

    /// A view of the shape. Each call makes one; it refers to this shape and must not outlive it.
    View<D> view() const { return stored_->view(); }
    /// A view of the shape at a pose.
    View<D> placed(const Pose<D>& pose) const { return stored_->placed(pose); }
    /// The bounding box of the shape at a pose; empty if a number is NaN or infinite.
    Aabb<D> bounds(const Pose<D>& pose) const { return stored_->bounds(pose, false); }
    /// The same with a margin, so that it rejects no hit within the tolerance: a ray may hit a shape that it misses by
    /// rounding (1e-7 of the shape's size), and a sweep one that it misses by the tolerance. The margin covers the part
    /// of the tolerance that grows with the larger of two shapes.
    Aabb<D> bounds_for_queries(const Pose<D>& pose) const { return stored_->bounds(pose, true); }
    /// Calls edit(shape) if the shape is an S, and returns whether it is. If other copies share the data, it is a copy
    /// of the shape, and those don't change.
    template <Ownable S, class F>
    bool edit(F&& edit) {
        if (stored_->type() != &type_of<S>) return false;
        const auto own = [this]() -> S& { return static_cast<StoredOf<S>&>(*stored_).shape; };
        if (stored_->is_shared()) stored_ = store(own());
        edit(own());
        return true;
    }
    /// Where its data is, to fetch it from memory early.
    const void* data() const { return &*stored_; }
    /// Whether both are copies of one AnyShape, which share its data.
    bool is_shared_with(const AnyShape& other) const { return stored_ == other.stored_; }

private:
    struct Stored : detail::Counted {
        virtual ~Stored() = default;
        virtual View<D> view() const = 0;
        virtual View<D> placed(const Pose<D>& pose) const = 0;
        virtual Aabb<D> bounds(const Pose<D>& pose, bool grow) const = 0;
        virtual const char* type() const = 0;
    };
    /// Its address stands for the type. Users may compile without type information.
    template <class S>
    static inline char type_of = 0;
    template <class S>
    struct StoredOf final : Stored {
        explicit StoredOf(S s) : shape(std::move(s)) {}
        StoredOf(const StoredOf&) = delete;
        StoredOf& operator=(const StoredOf&) = delete;

        // A user's `bounds` may leave the upper halves in use.
        View<D> view() const override {
            using abut::view;  // and what a header included later declares beside its shape
            const View<D> own(view(shape));
            detail::clear_upper_halves();
            return own;
        }
        View<D> placed(const Pose<D>& pose) const override {
            if constexpr (detail::PlacedByPose<S, D>) {
                const View<D> result(convex(shape, pose));
                detail::clear_upper_halves();
                return result;
            } else {
                using abut::view;
                const auto& own = view(shape);
                detail::clear_upper_halves();
                return detail::moved(own, detail::affine(pose));
            }
        }
        Aabb<D> bounds(const Pose<D>& pose, bool grow) const override {
            constexpr bool is_short =
                std::is_same_v<S, Ball<D>> || std::is_same_v<S, Box<D>> || std::is_same_v<S, Capsule<D>>;
            if constexpr (is_short)
                return detail::bounds_at(shape, pose, grow);
            else
                return detail::bounds_at<D>(placed(pose), grow);
        }

        const char* type() const override { return &type_of<S>; }

        S shape;
    };
    template <class S>
    static detail::CountedPointer<Stored> store(S shape) {
        return detail::CountedPointer<Stored>(new StoredOf<S>(std::move(shape)));
    }

    detail::CountedPointer<Stored> stored_;
};

template <int D>
View<D> view(const AnyShape<D>& shape) {
    return shape.view();
}

template <int D>
Aabb<D> bounds(const AnyShape<D>& shape) {
    return bounds(shape.view());
}

}  // namespace abut
