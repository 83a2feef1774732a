#include <abut/math/assert.hpp>
#include <abut/math/detail/blob.hpp>
#include <abut/math/dvec.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/world/large_world.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

namespace {

// A snapshot in double: "abutlrg\n", the version, the dimension, the numbers of items and of motions, the positions of
// both in the order of their slots, a checksum, and the snapshot of the rest.
constexpr std::uint64_t magic = 0x0a67726c74756261;  // "abutlrg\n"
constexpr std::uint32_t version = 1;
constexpr std::size_t checksum_size = 8, header_size = 24;

template <int D>
bool is_valid_position(const DVec<D>& position) {
    const bool finite = std::isfinite(length_squared(position));
    ABUT_ASSERT(finite);
    return finite;
}

template <int D>
View<D> turned(const View<D>& shape, const Rotation<D>& rotation) {
    return rotation == Pose<D>().rotation ? shape : moved(shape, affine(Pose<D>{Vec<D>(0.0f), rotation}));
}

/// The same answer, with its points relative to a position.
template <class Answer, int D>
std::optional<Relative<Answer, D>> relative(const std::optional<Answer>& answer, const DVec<D>& origin) {
    if (!answer) return std::nullopt;
    return Relative<Answer, D>{*answer, origin};
}

Problem damaged() {
    return {ProblemCode::bad_format, "a snapshot of a large world is damaged or not one"};
}

}  // namespace

template <int D>
Id LargeWorld<D>::add_at(const AnyShape<D>& shape, const PoseD<D>& pose, const ItemOptions<D>& options) {
    const std::size_t slot = this->free_.empty() ? this->items_.size() : this->free_.back();
    this->positions_.set(static_cast<std::uint32_t>(slot), pose.position);
    ItemOptions<D> own = options;
    own.pose = {Vec<D>(0.0f), pose.rotation};
    return this->add_shape(shape, own);
}

template <int D>
void LargeWorld<D>::set_pose(Id id, const PoseD<D>& pose) {
    auto* const item = this->expected(id);
    const std::uint32_t slot = id.index - 1;
    if (item == nullptr || LargeWorld::pose(id) == pose) return;
    this->keep_previous_pose(slot);
    item->pose.rotation = pose.rotation;
    this->positions_.set(slot, pose.position);
    this->update_box(slot);
}

template <int D>
void LargeWorld<D>::move(Id id, const PoseD<D>& pose) {
    clear_upper_halves();
    set_pose(id, pose);
}

template <int D>
void LargeWorld<D>::move(std::span<const Id> ids, std::span<const PoseD<D>> poses) {
    clear_upper_halves();
    ABUT_ASSERT(ids.size() == poses.size());
    for (std::size_t i = 0; i < std::min(ids.size(), poses.size()); ++i) set_pose(ids[i], poses[i]);
}

template <int D>
PoseD<D> LargeWorld<D>::pose(Id id) const {
    const auto* const item = this->expected(id);
    return item != nullptr ? PoseD<D>{this->positions_.of(id.index - 1), item->pose.rotation} : PoseD<D>{};
}

template <int D>
DVec<D> LargeWorld<D>::in_world(Id a, const Vec<D>& point) const {
    const auto* const item = this->expected(a);
    if (item == nullptr) return DVec(point);
    const bool has_moved = item->previous != Floats::none;
    return (has_moved ? this->positions_.previous(item->previous) : this->positions_.of(a.index - 1)) + DVec(point);
}

template <int D>
std::vector<std::byte> LargeWorld<D>::save() {
    BlobWriter writer;
    const auto each_motion = [this](const auto& visit) {
        for (const auto& item : this->items_)
            if (item.in_use && item.previous != Floats::none) visit(this->positions_.previous(item.previous));
    };
    std::uint32_t motions = 0;
    each_motion([&](const DVec&) { ++motions; });
    writer.number(magic);
    for (const std::uint32_t number : {version, std::uint32_t{D}, static_cast<std::uint32_t>(this->size()), motions})
        writer.number(number);
    const auto put = [&](const DVec& position) {
        for (int i = 0; i < D; ++i) writer.number(position[i]);
    };
    for (std::uint32_t slot = 0; slot < this->items_.size(); ++slot)
        if (this->items_[slot].in_use) put(this->positions_.of(slot));
    each_motion(put);
    writer.checksum();
    const std::vector<std::byte> rest = Floats::save();
    writer.bytes.insert(writer.bytes.end(), rest.begin(), rest.end());
    return std::move(writer.bytes);
}

template <int D>
std::optional<Problem> LargeWorld<D>::restore(std::span<const std::byte> bytes) {
    clear_upper_halves();
    BlobReader reader(bytes);
    std::uint64_t its_magic = 0;
    std::uint32_t its_version = 0, dimension = 0, items = 0, motions = 0;
    reader.number(its_magic);
    for (std::uint32_t* number : {&its_version, &dimension, &items, &motions}) reader.number(*number);
    if (its_magic != magic || its_version != version || dimension != D) return damaged();
    std::vector<double> positions;
    if (!reader.array(positions, (std::uint64_t{items} + motions) * D)) return damaged();
    const std::size_t checked = header_size + positions.size() * sizeof(double);
    std::uint64_t checksum = 0;
    if (!reader.number(checksum) || checksum != blob_checksum(bytes.first(checked))) return damaged();
    const std::span<const std::byte> rest = bytes.subspan(checked + checksum_size);
    if (Floats::saved_counts(rest) != std::pair(items, motions)) return damaged();
    if (std::optional<Problem> problem = Floats::restore(rest)) return problem;

    const double* next = positions.data();
    const auto get = [&] {
        DVec position;
        for (int i = 0; i < D; ++i) position[i] = *next++;
        return position;
    };
    for (std::uint32_t slot = 0; slot < this->items_.size(); ++slot)
        if (this->items_[slot].in_use) this->positions_.set(slot, get());
    for (std::uint32_t i = 0; i < motions; ++i) this->positions_.keep_previous(get());
    this->set_boxes();
    return std::nullopt;
}

template <int D>
std::optional<LargeHit<D>> LargeWorld<D>::raycast(const RayD<D>& ray, const Filter& filter) const {
    clear_upper_halves();
    if (!is_valid_position(ray.origin)) return std::nullopt;
    return relative(this->first_hit({Vec<D>(0.0f), ray.direction, ray.length}, {filter, ray.origin}), ray.origin);
}

template <int D>
bool LargeWorld<D>::raycast_any(const RayD<D>& ray, const Filter& filter) const {
    clear_upper_halves();
    return is_valid_position(ray.origin) &&
           this->any_hit({Vec<D>(0.0f), ray.direction, ray.length}, {filter, ray.origin});
}

template <int D>
std::vector<LargeHit<D>> LargeWorld<D>::raycast_all(const RayD<D>& ray, const Filter& filter) const {
    clear_upper_halves();
    std::vector<LargeHit<D>> result;
    if (!is_valid_position(ray.origin)) return result;
    for (const WorldHit<D>& hit : this->all_hits({Vec<D>(0.0f), ray.direction, ray.length}, {filter, ray.origin}))
        result.push_back({hit, ray.origin});
    return result;
}

template <int D>
std::optional<LargeHit<D>> LargeWorld<D>::sweep_by(const View<D>& shape, const PoseD<D>& from, const Vec<D>& motion,
                                                   const Filter& filter) const {
    if (!is_valid_position(from.position)) return std::nullopt;
    const View<D> there = turned<D>(shape, from.rotation);
    return relative(this->sweep_linear(there, motion, {filter, from.position}), from.position);
}

template <int D>
std::optional<LargeHit<D>> LargeWorld<D>::sweep_to(const View<D>& shape, const PoseD<D>& from, const PoseD<D>& to,
                                                   const Filter& filter) const {
    if (!is_valid_position(from.position) || !is_valid_position(to.position)) return std::nullopt;
    const Pose<D> first{Vec<D>(0.0f), from.rotation}, last{to_float(to.position - from.position), to.rotation};
    return relative(this->sweep_between(shape, first, last, {filter, from.position}), from.position);
}

template <int D>
std::optional<LargeClosest<D>> LargeWorld<D>::closest(const DVec& point, const Filter& filter) const {
    if (!is_valid_position(point)) return std::nullopt;
    return relative(this->closest_to(Floats::point_view(Vec<D>(0.0f)), {filter, point}), point);
}

template <int D>
std::optional<LargeClosest<D>> LargeWorld<D>::closest_at(const View<D>& shape, const PoseD<D>& pose,
                                                         const Filter& filter) const {
    if (!is_valid_position(pose.position)) return std::nullopt;
    return relative(this->closest_to(turned<D>(shape, pose.rotation), {filter, pose.position}), pose.position);
}

template <int D>
std::vector<Id> LargeWorld<D>::overlapping_at(const View<D>& shape, const PoseD<D>& pose, const Filter& filter) const {
    if (!is_valid_position(pose.position)) return {};
    return this->all_overlapping(turned<D>(shape, pose.rotation), {filter, pose.position});
}

template <int D>
std::vector<Id> LargeWorld<D>::containing(const DVec& point, const Filter& filter) const {
    clear_upper_halves();
    if (!is_valid_position(point)) return {};
    return this->all_containing(Vec<D>(0.0f), {filter, point});
}

template <int D>
void LargeWorld<D>::each_contact_at(const View<D>& shape, const PoseD<D>& pose, const Filter& filter,
                                    const QueryOptions<D>& options,
                                    FunctionRef<bool(Id, const Contact<D>&)> visit) const {
    if (!is_valid_position(pose.position)) return;
    this->visit_contacts(turned<D>(shape, pose.rotation), {filter, pose.position}, options, visit);
}

template <int D>
void LargeWorld<D>::each_in_box_at(const DVec& position, const Aabb<D>& box, const Filter& filter,
                                   FunctionRef<bool(Id, const View<D>&)> visit) const {
    if (!is_valid_position(position)) return;
    // The broad phases have larger boxes, by their rounding.
    this->visit_in_box(box, {filter, position}, [&](Id id, const View<D>& shape) {
        return !overlaps(this->box_about(id.index - 1, position), box) || visit(id, shape);
    });
}

template class LargeWorld<2>;
template class LargeWorld<3>;

}  // namespace abut
