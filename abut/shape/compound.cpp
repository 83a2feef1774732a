#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/detail/compound_data.hpp>
#include <abut/shape/detail/removed_child.hpp>
#include <abut/shape/view/part.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace abut {

using namespace detail;

namespace {

template <int D>
Problem problem_of(std::size_t index, ProblemCode code, const char* what) {
    return {code, "child " + std::to_string(index) + what, index};
}

/// The same motion with a direction of length 1, cut off at `reach`, which counts lengths of the original direction.
template <int D>
MovingBox<D> with_unit_direction(const MovingBox<D>& box, double direction_length, double reach) {
    MovingBox<D> result = box;
    result.direction = box.direction / direction_length;
    result.length = std::min(box.length, reach) * direction_length;
    return result;
}

/// What is wrong with a child; else its box.
template <int D>
std::optional<Problem> check(const View<D>& child, std::size_t index, Aabb<D>& box) {
    if (std::holds_alternative<HalfSpaceView<D>>(child))
        return problem_of<D>(index, ProblemCode::bad_argument, " is a half-space, which has no bounds");
    if (std::holds_alternative<DistanceFunction<D>>(child))
        return problem_of<D>(index, ProblemCode::bad_argument, " is a distance function, which has no convex parts");
    box = detail::bounds(child);
    const bool has_parts = box.min[0] <= box.max[0];
    if (!is_finite(child) || (has_parts && !(is_finite(box.min) && is_finite(box.max))))
        return problem_of<D>(index, ProblemCode::not_finite, " has a coordinate that is not finite");
    return std::nullopt;
}

template <int D>
View<D> view_at(const AnyShape<D>& child, const Pose<D>& pose) {
    return pose == Pose<D>() ? child.view() : child.placed(pose);
}

}  // namespace

template <int D>
std::optional<Problem> Compound<D>::Data::set(std::span<const AnyShape<D>> shapes, std::vector<Aabb<D>>& boxes) {
    if (shapes.empty()) return Problem{ProblemCode::empty_input, "a compound needs at least one child", 0};
    children.assign(shapes.begin(), shapes.end());
    boxes.resize(shapes.size());
    views.reserve(shapes.size());
    for (std::size_t i = 0; i < children.size(); ++i) {
        views.push_back(children[i].view());
        if (std::optional<Problem> problem = check(views[i], i, boxes[i])) return problem;
        if (is_removed_child(views[i])) removed.insert(removed.end(), static_cast<std::uint32_t>(i));
    }
    return std::nullopt;
}

template <int D>
void Compound<D>::put(std::uint32_t index, const AnyShape<D>& child, const View<D>& placed, const Aabb<D>& box) {
    Data& data = own_data();
    changed_.add(merged(detail::bounds(data.views[index]), box));
    data.children[index] = child;
    data.views[index] = placed;
    // A box that is replaced may leave larger boxes above it; a removed one doesn't, so that the bounds are exact.
    data.tree.set(index, Aabb<D>::empty());
    data.count_change(data.tree.set(index, box));
}

template <int D>
void Compound<D>::Data::count_change(bool succeeded) {
    constexpr std::size_t min_changes = 64;
    if (succeeded && ++changes < std::max(views.size(), min_changes)) return;
    std::vector<Aabb<D>> boxes;
    boxes.reserve(views.size());
    for (const View<D>& child : views) boxes.push_back(detail::bounds(child));
    tree.update(boxes);
    changes = 0;
}

template <int D>
Result<Compound<D>> Compound<D>::build(std::span<const AnyShape<D>> children) {
    detail::enter_library();
    auto data = std::make_shared<Data>();
    std::vector<Aabb<D>> boxes;
    if (std::optional<Problem> problem = data->set(children, boxes)) return *std::move(problem);
    data->tree.build(boxes);
    return Compound(std::move(data));
}

/// The data, of which a copy is made if they are shared.
template <int D>
typename Compound<D>::Data& Compound<D>::own_data() {
    if (data_.use_count() > 1) data_ = std::make_shared<Data>(*data_);
    return *data_;
}

template <int D>
Result<std::uint32_t> Compound<D>::add(const AnyShape<D>& child, const Pose<D>& pose) {
    detail::enter_library();
    const View<D> placed = view_at(child, pose);
    Aabb<D> box;
    if (std::optional<Problem> problem = check(placed, size(), box)) return *std::move(problem);
    Data& data = own_data();
    if (!data.removed.empty()) {
        const std::uint32_t index = *data.removed.begin();
        data.removed.erase(data.removed.begin());
        put(index, child, placed, box);
        return index;
    }
    const std::uint32_t index = data.tree.insert(box);
    data.children.push_back(child);
    data.views.push_back(placed);
    data.count_change(true);
    changed_.add(box);
    return index;
}

template <int D>
std::optional<Problem> Compound<D>::set(std::uint32_t index, const AnyShape<D>& child, const Pose<D>& pose) {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    if (index >= size()) return std::nullopt;
    const View<D> placed = view_at(child, pose);
    Aabb<D> box;
    if (std::optional<Problem> problem = check(placed, index, box)) return problem;
    Data& data = own_data();
    data.removed.erase(index);
    put(index, child, placed, box);
    return std::nullopt;
}

template <int D>
std::optional<Problem> Compound<D>::move(std::uint32_t index, const Pose<D>& pose) {
    detail::enter_library();
    ABUT_ASSERT(has_child(index));
    if (!has_child(index)) return std::nullopt;
    return set(index, AnyShape<D>(data_->children[index]), pose);
}

template <int D>
void Compound<D>::remove(std::uint32_t index) {
    detail::enter_library();
    ABUT_ASSERT(has_child(index));
    if (!has_child(index)) return;
    Data& data = own_data();
    const AnyShape<D> nothing = RemovedChild<D>();
    data.removed.insert(index);
    put(index, nothing, nothing.view(), Aabb<D>::empty());
}

template <int D>
bool Compound<D>::has_child(std::uint32_t index) const {
    return index < size() && !is_removed_child(data_->views[index]);
}

template <int D>
std::uint32_t Compound<D>::size() const {
    return static_cast<std::uint32_t>(data_->children.size());
}

template <int D>
const View<D>& Compound<D>::child(std::uint32_t index) const {
    ABUT_ASSERT(index < size());
    return data_->views[index];
}

template <int D>
Aabb<D> Compound<D>::bounds() const {
    detail::enter_library();
    return data_->tree.bounds();
}

template <int D>
void Compound<D>::each_part(const Aabb<D>& box, PartVisitor<D> visit) const {
    detail::enter_library();
    data_->tree.each_overlapping(box, [&](std::uint32_t index) -> bool {
        bool go_on = true;
        detail::for_each_part(child(index), box, [&](const detail::Part<D>& part, std::uint32_t) {
            return go_on = visit(part.convex(), index);
        });
        return go_on;
    });
}

template <int D>
void Compound<D>::each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const {
    detail::enter_library();
    const double direction_length = length(box.direction);
    if (!(direction_length > 0)) return;
    double reach = box.length;
    data_->tree.sweep(box, [&](std::uint32_t index) -> float {
        const auto visit_part = [&](const Convex<D>& part, std::uint32_t) -> float {
            reach = std::min(reach, static_cast<double>(visit(part, index)));
            return static_cast<float>(reach * direction_length);
        };
        detail::with_part(
            child(index), [&](const detail::Part<D>& part) { visit_part(part.convex(), index); },
            [&](const Composite<D>& composite) {
                detail::each_part_along<D>(composite, with_unit_direction(box, direction_length, reach), visit_part);
            });
        return static_cast<float>(reach);
    });
}

template <int D>
void Compound<D>::each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const {
    detail::enter_library();
    float reach = std::numeric_limits<float>::infinity();
    data_->tree.closest(box, [&](std::uint32_t index) -> float {
        const auto visit_part = [&](const Convex<D>& part, std::uint32_t) -> float {
            return reach = std::min(reach, visit(part, index));
        };
        detail::with_part(
            child(index), [&](const detail::Part<D>& part) { visit_part(part.convex(), index); },
            [&](const Composite<D>& composite) { detail::each_part_near<D>(composite, box, visit_part); });
        return reach;
    });
}

template <int D>
bool Compound<D>::solid_contains(const Vec<D>& point) const {
    detail::enter_library();
    bool found = false;
    data_->tree.each_overlapping(Aabb<D>{point, point}, [&](std::uint32_t index) -> bool {
        const auto* composite = std::get_if<Composite<D>>(&child(index));
        found = composite != nullptr && contains_inside(*composite, point);
        return !found;
    });
    return found;
}

template class Compound<2>;
template class Compound<3>;

}  // namespace abut
