#pragma once

// Copies of objects that outlive a change of their shape.

#include "tool/objects/objects.hpp"

#include <memory>
#include <vector>

namespace abut::tool {

template <int D>
using ObjectCopy = std::shared_ptr<const Object<D>>;

/// Keeps one copy of each object as long as its shape stays the same. Its pose is any that the object had meanwhile.
template <int D>
class ObjectCopies {
public:
    /// Refers to the objects.
    explicit ObjectCopies(const Objects<D>& objects) : objects_(objects), copies_(objects.size()) {}

    /// Equal for equal shapes of one object.
    const ObjectCopy<D>& of(std::size_t object) {
        ObjectCopy<D>& copy = copies_[object];
        if (copy == nullptr || copy->data != objects_[object].data)
            copy = std::make_shared<const Object<D>>(objects_[object]);
        return copy;
    }

private:
    const Objects<D>& objects_;
    std::vector<ObjectCopy<D>> copies_;
};

}  // namespace abut::tool
