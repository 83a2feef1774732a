#pragma once

// A shape whose type is forgotten, owned.

#include <abut/shape/placed.hpp>

#include <memory>
#include <type_traits>
#include <utility>

namespace abut {

/// Any shape of a dimension as a value: a shape again, that answers as the one it was made from does. Owns all that it
/// is made of, so that none is made of a view. Copies share it.
template <int D>
class AnyShape {
public:
    template <class S>
    requires(!std::is_same_v<S, AnyShape> && Ownable<S> && dimension<S> == D) AnyShape(const S& shape)
        : stored_(store(owned(shape))) {}

    const View<D>& view() const { return stored_->view; }

private:
    struct Stored {
        virtual ~Stored() = default;
        View<D> view;  ///< of what derives from this
    };
    template <class S>
    struct StoredOf final : Stored {
        explicit StoredOf(S s) : shape(std::move(s)) { this->view = abut::view(shape); }
        StoredOf(const StoredOf&) = delete;
        StoredOf& operator=(const StoredOf&) = delete;

        const S shape;
    };
    template <class S>
    static std::shared_ptr<const Stored> store(S shape) {
        return std::make_shared<const StoredOf<S>>(std::move(shape));
    }

    std::shared_ptr<const Stored> stored_;
};

template <int D>
const View<D>& view(const AnyShape<D>& shape) {
    return shape.view();
}

template <int D>
Aabb<D> bounds(const AnyShape<D>& shape) {
    return bounds(shape.view());
}

}  // namespace abut
