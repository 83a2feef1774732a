#include <abut/query/detail/valid_query.hpp>
#include <abut/shape/detail/content_hash.hpp>
#include <abut/world/detail/recording.hpp>
#include <abut/world/file.hpp>
#include <abut/world/recorded_world.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

/// A filter that notes what it refuses.
template <int D>
class RecordedWorld<D>::Refused {
public:
    explicit Refused(const Filter& filter)
        : filter_(filter), note_([this](Id id) {
              if ((*filter_.accepts)(id)) return true;
              const detail::Lock lock(mutex_);
              refused_.push_back(id);
              return false;
          }) {}
    Refused(const Refused&) = delete;
    Refused& operator=(const Refused&) = delete;

    Filter filter() const {
        Filter result = filter_;
        if (filter_.accepts) result.accepts = note_;
        return result;
    }
    RecordedFilter recorded() {
        std::sort(refused_.begin(), refused_.end());
        refused_.erase(std::unique(refused_.begin(), refused_.end()), refused_.end());
        return {filter_.layers,
                filter_.mask,
                filter_.sensors,
                filter_.ignore,
                std::vector<Id>(filter_.ignore_ids.begin(), filter_.ignore_ids.end()),
                refused_};
    }

private:
    const Filter& filter_;
    std::function<bool(Id)> note_;
    detail::Mutex mutex_;
    std::vector<Id> refused_;
};

template <int D>
RecordedWorld<D>::RecordedWorld(Write write, World<D> world, const WorldOptions& options)
    : world_(std::move(world)), write_(std::move(write)) {
    const Result<std::vector<std::byte>> file = save_with_shapes(world_);
    if (!file) {
        end(file.problem());
        return;
    }
    world_.each_item([&](Id id) { written_shapes_.insert(content_hash(world_.any_shape(id).view())); });
    BlobWriter writer;
    for (const char c : recording_signature) writer.number(c);
    writer.number(recording_version);
    writer.number(static_cast<std::uint32_t>(D));
    writer.number(static_cast<std::uint64_t>(options.max_released_shapes));
    writer.number(static_cast<std::uint64_t>(options.filter_edges ? 1 : 0));
    writer.number(static_cast<std::uint64_t>(file->size()));
    writer.array(std::span<const std::byte>(*file));
    writer.checksum<recording_sums>();
    write_(writer.bytes);
}

template <int D>
std::optional<Problem> RecordedWorld<D>::problem() const {
    const detail::Lock lock(mutex_);
    return problem_;
}

template <int D>
bool RecordedWorld<D>::is_recording() const {
    const detail::Lock lock(mutex_);
    return !problem_;
}

template <int D>
void RecordedWorld<D>::end(const Problem& problem) const {
    const detail::Lock lock(mutex_);
    if (!problem_) problem_ = problem;
}

template <int D>
void RecordedWorld<D>::record(Entry& entry) const {
    const detail::Lock lock(mutex_);
    if (!problem_) write_entry(entry);
}

template <int D>
void RecordedWorld<D>::write_entry(Entry& entry) const {
    BlobWriter payload;
    payload.number(entry.kind);
    FieldWriter fields{payload};
    describe(fields, entry);
    payload.array(std::span<const std::byte>(entry.answer));
    BlobWriter writer;
    const auto size = static_cast<std::uint32_t>(payload.bytes.size());
    writer.number(size);
    writer.number(~size);
    writer.array(std::span<const std::byte>(payload.bytes));
    writer.number(blob_checksum<recording_sums>(payload.bytes));
    write_(writer.bytes);
}

/// Writes the shape before the first entry that names it. Returns false if no file can hold it.
template <int D>
bool RecordedWorld<D>::write_shape(Entry& entry, const View<D>& shape) const {
    entry.shape = content_hash(shape);
    const detail::Lock lock(mutex_);
    if (problem_ || written_shapes_.contains(entry.shape)) return true;
    World<D> alone;
    alone.add(Unowned<D>{shape});
    Result<std::vector<std::byte>> file = save_with_shapes(alone);
    if (!file) return false;
    Entry own;
    own.kind = EntryKind::shape;
    own.shape = entry.shape;
    own.bytes = *std::move(file);
    write_entry(own);
    written_shapes_.insert(entry.shape);
    return true;
}

template <int D>
void RecordedWorld<D>::write_item_shape(Entry& entry, Id id) {
    const AnyShape<D> shape = world_.any_shape(id);
    if (!detail::is_finite(world_.shape(id)))
        end({ProblemCode::not_finite, "the shape or pose of item " + std::to_string(id.index) + " is not finite",
             id.index});
    else if (!write_shape(entry, shape.view()))
        end({ProblemCode::bad_argument,
             "item " + std::to_string(id.index) + " has a shape of a kind that can't be saved", id.index});
}

template <int D>
void RecordedWorld<D>::record_add(Id id) {
    Entry entry{.kind = EntryKind::add, .id = id, .options = world_.options(id)};
    write_item_shape(entry, id);
    record(entry);
}

template <int D>
void RecordedWorld<D>::record_shape(Id id) {
    if (!world_.contains(id)) return;
    Entry entry{.kind = EntryKind::set_shape, .id = id};
    write_item_shape(entry, id);
    record(entry);
}

template <int D>
void RecordedWorld<D>::move(Id id, const Pose<D>& pose) {
    world_.move(id, pose);
    if (!world_.contains(id)) return;
    Entry entry{.kind = EntryKind::move, .id = id, .from = pose};
    if (!detail::is_finite(pose))
        end({ProblemCode::not_finite, "the pose of item " + std::to_string(id.index) + " is not finite", id.index});
    record(entry);
}

template <int D>
void RecordedWorld<D>::move(std::span<const Id> ids, std::span<const Pose<D>> poses) {
    for (std::size_t i = 0; i < ids.size(); ++i) move(ids[i], poses[i]);
}

template <int D>
void RecordedWorld<D>::remove(Id id) {
    Entry entry{.kind = EntryKind::remove, .id = id};
    if (world_.contains(id)) record(entry);
    world_.remove(id);
}

template <int D>
void RecordedWorld<D>::remove(std::span<const Id> ids) {
    for (const Id id : ids) remove(id);
}

template <int D>
template <class T>
void RecordedWorld<D>::record_option(Id id, std::uint8_t option, T value, std::uint64_t mask) {
    if (!world_.contains(id)) return;
    Entry entry{.kind = EntryKind::set_option,
                .id = id,
                .option = ItemOption{option},
                .values = {static_cast<std::uint64_t>(value), mask}};
    record(entry);
}

template <int D>
void RecordedWorld<D>::set_filter(Id id, std::uint64_t layers, std::uint64_t mask) {
    world_.set_filter(id, layers, mask);
    record_option(id, static_cast<std::uint8_t>(ItemOption::filter), layers, mask);
}
template <int D>
void RecordedWorld<D>::set_user(Id id, std::uint64_t user) {
    world_.set_user(id, user);
    record_option(id, static_cast<std::uint8_t>(ItemOption::user), user);
}
template <int D>
void RecordedWorld<D>::set_fixed(Id id, bool fixed) {
    world_.set_fixed(id, fixed);
    record_option(id, static_cast<std::uint8_t>(ItemOption::fixed), fixed);
}
template <int D>
void RecordedWorld<D>::set_sensor(Id id, bool sensor) {
    world_.set_sensor(id, sensor);
    record_option(id, static_cast<std::uint8_t>(ItemOption::sensor), sensor);
}
template <int D>
void RecordedWorld<D>::set_continuous(Id id, bool continuous) {
    world_.set_continuous(id, continuous);
    record_option(id, static_cast<std::uint8_t>(ItemOption::continuous), continuous);
}
template <int D>
void RecordedWorld<D>::set_group(Id id, std::int32_t group) {
    world_.set_group(id, group);
    record_option(id, static_cast<std::uint8_t>(ItemOption::group), group);
}
template <int D>
void RecordedWorld<D>::set_enabled(Id id, bool enabled) {
    world_.set_enabled(id, enabled);
    record_option(id, static_cast<std::uint8_t>(ItemOption::enabled), enabled);
}

template <int D>
void RecordedWorld<D>::set_pair_filter(std::function<bool(Id, Id)> accepts) {
    pair_filter_ = std::move(accepts);
    if (!pair_filter_) return world_.set_pair_filter(nullptr);
    world_.set_pair_filter([this](Id a, Id b) {
        if (pair_filter_(a, b)) return true;
        const detail::Lock lock(mutex_);
        refused_pairs_.push_back({a, b});
        return false;
    });
}

template <int D>
std::vector<std::byte> RecordedWorld<D>::save() {
    std::vector<std::byte> bytes = world_.save();
    Entry entry{.kind = EntryKind::save, .answer = encoded(ListHash{bytes.size(), blob_checksum(bytes)})};
    record(entry);
    return bytes;
}

template <int D>
std::optional<Problem> RecordedWorld<D>::restore(std::span<const std::byte> bytes) {
    std::optional<Problem> problem = world_.restore(bytes);
    Entry entry{.kind = EntryKind::restore};
    entry.bytes.assign(bytes.begin(), bytes.end());
    entry.answer = encoded(!problem);
    // A snapshot from before the recording may have brought back shapes that are not in the file.
    if (!problem && is_recording()) {
        Entry shape;
        world_.each_item([&](Id id) { write_item_shape(shape, id); });
    }
    record(entry);
    return problem;
}

template <int D>
Events RecordedWorld<D>::update() {
    return updated(nullptr);
}
template <int D>
Events RecordedWorld<D>::update(Executor& executor) {
    return updated(&executor);
}

template <int D>
Events RecordedWorld<D>::updated(Executor* executor) {
    refused_pairs_.clear();
    const Events events = executor != nullptr ? world_.update(*executor) : world_.update();
    has_events_ = true;
    if (!is_recording()) return events;
    Entry entry{.kind = EntryKind::update, .has_pair_filter = static_cast<bool>(pair_filter_)};
    std::sort(refused_pairs_.begin(), refused_pairs_.end());
    refused_pairs_.erase(std::unique(refused_pairs_.begin(), refused_pairs_.end()), refused_pairs_.end());
    entry.refused = refused_pairs_;
    entry.answer = encoded(hashes_of(world_, events));
    record(entry);
    return events;
}

/// Answers and records a question; those with numbers that are not finite have no answer, and are left out.
template <int D>
template <class Query>
auto RecordedWorld<D>::query(Entry entry, const View<D>* shape, const Filter& filter, const Query& call) const {
    Refused refused(filter);
    auto answer = call(refused.filter());
    if (!is_recording() || (is_about_update(entry.kind) && !has_events_)) return answer;
    const bool is_valid = (shape == nullptr || detail::is_finite(*shape)) && detail::is_finite(entry.ray) &&
                          detail::is_finite(entry.vector) && detail::is_finite(entry.motion) &&
                          detail::is_finite(entry.from) && detail::is_finite(entry.to) && std::isfinite(entry.margin);
    if (!is_valid || (shape != nullptr && !write_shape(entry, *shape))) return answer;
    entry.filter = refused.recorded();
    entry.answer = encoded(answer);
    record(entry);
    return answer;
}

template <int D>
std::vector<Id> RecordedWorld<D>::touching(Id id) const {
    Entry entry{.kind = EntryKind::touching, .id = id};
    if (!world_.contains(id)) return world_.touching(id);
    return query(entry, nullptr, {}, [&](const Filter&) { return world_.touching(id); });
}
template <int D>
Contact<D> RecordedWorld<D>::contact(const IdPair& pair) const {
    Entry entry{.kind = EntryKind::contact, .pair = pair};
    return query(entry, nullptr, {}, [&](const Filter&) { return world_.contact(pair); });
}
template <int D>
std::optional<Hit<D>> RecordedWorld<D>::impact(const IdPair& pair) const {
    Entry entry{.kind = EntryKind::impact, .pair = pair};
    return query(entry, nullptr, {}, [&](const Filter&) { return world_.impact(pair); });
}

template <int D>
std::optional<WorldHit<D>> RecordedWorld<D>::raycast(const Ray<D>& ray, const Filter& filter) const {
    Entry entry{.kind = EntryKind::raycast, .ray = ray};
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.raycast(ray, noted); });
}
template <int D>
bool RecordedWorld<D>::raycast_any(const Ray<D>& ray, const Filter& filter) const {
    Entry entry{.kind = EntryKind::raycast_any, .ray = ray};
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.raycast_any(ray, noted); });
}
template <int D>
std::vector<WorldHit<D>> RecordedWorld<D>::raycast_all(const Ray<D>& ray, const Filter& filter) const {
    Entry entry{.kind = EntryKind::raycast_all, .ray = ray};
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.raycast_all(ray, noted); });
}
template <int D>
void RecordedWorld<D>::raycast(std::span<const Ray<D>> rays, Hits hits, const Filter& filter) const {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = raycast(rays[i], filter);
}

template <int D>
std::optional<WorldHit<D>> RecordedWorld<D>::sweep_view(const View<D>& shape, const Vec<D>& motion,
                                                        const Filter& filter) const {
    Entry entry{.kind = EntryKind::sweep, .vector = motion};
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.sweep(shape, motion, noted); });
}
template <int D>
std::optional<WorldHit<D>> RecordedWorld<D>::sweep_view(const View<D>& shape, const Motion<D>& motion,
                                                        const Filter& filter) const {
    Entry entry{.kind = EntryKind::sweep_motion, .motion = motion};
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.sweep(shape, motion, noted); });
}
template <int D>
std::optional<WorldHit<D>> RecordedWorld<D>::sweep_view(const View<D>& shape, const Pose<D>& from, const Pose<D>& to,
                                                        const Filter& filter) const {
    Entry entry{.kind = EntryKind::sweep_poses, .from = from, .to = to};
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.sweep(shape, from, to, noted); });
}

template <int D>
std::optional<WorldClosest<D>> RecordedWorld<D>::closest(const Vec<D>& point, const Filter& filter) const {
    Entry entry{.kind = EntryKind::closest_to_point, .vector = point};
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.closest(point, noted); });
}
template <int D>
void RecordedWorld<D>::closest(std::span<const Vec<D>> points, ClosestItems items, const Filter& filter) const {
    for (std::size_t i = 0; i < points.size(); ++i) items[i] = closest(points[i], filter);
}
template <int D>
std::optional<WorldClosest<D>> RecordedWorld<D>::closest_to(const View<D>& shape, const Filter& filter) const {
    Entry entry{.kind = EntryKind::closest};
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.closest(shape, noted); });
}
template <int D>
std::optional<WorldClosest<D>> RecordedWorld<D>::closest_at(const View<D>& shape, const Pose<D>& pose,
                                                            const Filter& filter) const {
    Entry entry{.kind = EntryKind::closest, .from = pose, .is_placed = true};
    return query(entry, &shape, filter,
                 [&](const Filter& noted) { return world_.closest(detail::moved(shape, affine(pose)), noted); });
}

template <int D>
std::vector<WorldClosest<D>> RecordedWorld<D>::k_nearest(const Vec<D>& point, std::size_t k,
                                                         const Filter& filter) const {
    Entry entry{.kind = EntryKind::k_nearest_to_point, .vector = point};
    entry.values[0] = k;
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.k_nearest(point, k, noted); });
}
template <int D>
std::vector<WorldClosest<D>> RecordedWorld<D>::nearest_to(const View<D>& shape, std::size_t k,
                                                          const Filter& filter) const {
    Entry entry{.kind = EntryKind::k_nearest};
    entry.values[0] = k;
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.k_nearest(shape, k, noted); });
}

template <int D>
std::vector<Id> RecordedWorld<D>::all_overlapping(const View<D>& shape, const Filter& filter) const {
    Entry entry{.kind = EntryKind::overlapping};
    return query(entry, &shape, filter, [&](const Filter& noted) { return world_.overlapping(shape, noted); });
}
template <int D>
void RecordedWorld<D>::overlapping_at(const View<D>& shape, std::span<const Pose<D>> poses, IdLists& lists,
                                      const Filter& filter) const {
    world_.overlapping(shape, poses, lists, filter);
    for (const Pose<D>& pose : poses) {
        Entry entry{.kind = EntryKind::overlapping, .from = pose, .is_placed = true};
        (void)query(entry, &shape, filter,
                    [&](const Filter& noted) { return world_.overlapping(detail::moved(shape, affine(pose)), noted); });
    }
}

template <int D>
std::vector<Id> RecordedWorld<D>::containing(const Vec<D>& point, const Filter& filter) const {
    Entry entry{.kind = EntryKind::containing, .vector = point};
    return query(entry, nullptr, filter, [&](const Filter& noted) { return world_.containing(point, noted); });
}

template <int D>
std::vector<WorldContact<D>> RecordedWorld<D>::all_contacts(const View<D>& shape, const Filter& filter,
                                                            const QueryOptions<D>& options) const {
    Entry entry{.kind = EntryKind::each_contact, .margin = options.margin, .back_faces = options.back_faces};
    return query(entry, &shape, filter,
                 [&](const Filter& noted) { return detail::contacts_of(world_, shape, noted, options); });
}

template class RecordedWorld<2>;
template class RecordedWorld<3>;

}  // namespace abut
