#pragma once

// The entries of a recording: changes of a world, and questions with their answers. For .cpp files.
//
// The file: "abutrec\n", the version, the dimension, the options of the world, the file of the world at the start with
// its size, and a checksum; then entries. Each has its size, the complement of its size, its kind, its fields, its
// answer and a checksum. `describe` lists the fields of everything that is written, read, or shown as text.

#include <abut/math/detail/blob.hpp>
#include <abut/world/world.hpp>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::detail {

inline constexpr std::array<char, 8> recording_signature{'a', 'b', 'u', 't', 'r', 'e', 'c', '\n'};
inline constexpr std::uint32_t recording_version = 1;
inline constexpr std::size_t recording_sums = 4;

enum class EntryKind : std::uint8_t {
    // A shape that later entries name by its hash: the file of a world of one item.
    shape,
    // changes
    add,
    set_shape,
    move,
    set_option,
    remove,
    save,
    restore,
    update,
    // questions
    raycast,
    raycast_any,
    raycast_all,
    sweep,
    sweep_motion,
    sweep_poses,
    closest,
    closest_to_point,
    k_nearest,
    k_nearest_to_point,
    overlapping,
    each_contact,
    containing,
    touching,
    contact,
    impact,
    count,
};

enum class ItemOption : std::uint8_t { filter, user, fixed, sensor, continuous, group, enabled, count };

/// A filter that owns its lists. A function is recorded by the items that it refused.
struct RecordedFilter {
    std::uint64_t layers = 1, mask = 1;
    bool sensors = false;
    Id ignore{};
    std::vector<Id> ignore_ids, refused;
};

/// A list in an answer of which only the size and a hash are recorded.
struct ListHash {
    std::uint64_t size = 0, hash = 0;
};

/// The answer of an update.
struct UpdateHashes {
    ListHash began, stayed, ended, fractions, contacts, impacts;
};

/// An entry; each kind uses some of the fields.
template <int D>
struct Entry {
    EntryKind kind{};
    std::uint64_t shape = 0;  ///< the content hash of a shape
    Id id{};
    ItemOptions<D> options{};
    ItemOption option{};
    std::array<std::uint64_t, 2> values{};
    IdPair pair{};
    Ray<D> ray{};
    Vec<D> vector{};
    Motion<D> motion{};
    Pose<D> from{}, to{};
    bool is_placed = false;  ///< the question is about `at(shape, from)`
    float margin = 0;
    bool back_faces = true;
    RecordedFilter filter{};
    bool has_pair_filter = false;
    std::vector<IdPair> refused{};
    std::vector<std::byte> bytes{};  ///< of a shape or a snapshot
    std::vector<std::byte> answer{};
};

// The names and members of what is recorded: visit(name, member).

template <class V, class T, class... Rest>
void visit_fields(V& visit, const char* name, T& member, Rest&&... rest) {
    visit(name, member);
    if constexpr (sizeof...(rest) > 0) visit_fields(visit, rest...);
}

template <class V, int N>
void describe(V& visit, glm::vec<N, float>& v) {
    constexpr const char* names[] = {"x", "y", "z"};
    for (int i = 0; i < N; ++i) visit(names[i], v[i]);
}
template <class V>
void describe(V& visit, Pose<2>& pose) {
    visit_fields(visit, "position", pose.position, "cos", pose.rotation.cos, "sin", pose.rotation.sin);
}
template <class V>
void describe(V& visit, Pose<3>& pose) {
    visit_fields(visit, "position", pose.position, "qw", pose.rotation.w, "qx", pose.rotation.x, "qy", pose.rotation.y,
                 "qz", pose.rotation.z);
}
template <class V, int D>
void describe(V& visit, Motion<D>& motion) {
    visit_fields(visit, "from", motion.from, "move", motion.move, "turn", motion.turn);
}
template <class V, int D>
void describe(V& visit, Ray<D>& ray) {
    visit_fields(visit, "origin", ray.origin, "direction", ray.direction, "length", ray.length);
}
template <class V>
void describe(V& visit, Id& id) {
    visit_fields(visit, "index", id.index, "generation", id.generation);
}
template <class V>
void describe(V& visit, IdPair& pair) {
    visit_fields(visit, "a", pair.a, "b", pair.b);
}
template <class V, int D>
void describe(V& visit, ItemOptions<D>& options) {
    visit_fields(visit, "pose", options.pose, "user", options.user, "layers", options.layers, "mask", options.mask,
                 "fixed", options.fixed, "sensor", options.sensor, "continuous", options.continuous, "group",
                 options.group, "enabled", options.enabled);
}
template <class V>
void describe(V& visit, RecordedFilter& filter) {
    visit_fields(visit, "layers", filter.layers, "mask", filter.mask, "sensors", filter.sensors, "ignore",
                 filter.ignore, "ignore_ids", filter.ignore_ids, "refused", filter.refused);
}
template <class V>
void describe(V& visit, Feature& feature) {
    visit_fields(visit, "part", feature.part, "index", feature.index, "kind", feature.kind);
}
template <class V, int D>
void describe(V& visit, Hit<D>& hit) {
    visit_fields(visit, "fraction", hit.fraction, "distance", hit.distance, "point", hit.point, "normal", hit.normal,
                 "started_inside", hit.started_inside, "feature", hit.feature);
}
template <class V, int D>
void describe(V& visit, Closest<D>& closest) {
    visit_fields(visit, "distance", closest.distance, "normal", closest.normal, "on_a", closest.on_a, "on_b",
                 closest.on_b, "feature_a", closest.feature_a, "feature_b", closest.feature_b);
}
template <class V, int D>
void describe(V& visit, ContactPoint<D>& point) {
    visit_fields(visit, "position", point.position, "depth", point.depth, "feature", point.feature);
}
template <class V, int D>
void describe(V& visit, Contact<D>& contact) {
    visit_fields(visit, "normal", contact.normal, "depth", contact.depth);
    std::vector<ContactPoint<D>> points(contact.points.begin(), contact.points.end());
    visit("points", points);
    contact.points.clear();
    for (std::size_t i = 0; i < std::min(points.size(), ContactPoints<D>::capacity); ++i)
        contact.points.push_back(points[i]);
    visit_fields(visit, "feature_a", contact.feature_a, "feature_b", contact.feature_b);
}
template <class V, int D>
void describe(V& visit, WorldHit<D>& hit) {
    visit_fields(visit, "id", hit.id, "hit", hit.hit);
}
template <class V, int D>
void describe(V& visit, WorldClosest<D>& closest) {
    visit_fields(visit, "id", closest.id, "closest", closest.closest);
}
template <class V, int D>
void describe(V& visit, WorldContact<D>& contact) {
    visit_fields(visit, "a", contact.a, "b", contact.b, "contact", contact.contact);
}
template <class V, int D>
void describe(V& visit, WorldImpact<D>& impact) {
    visit_fields(visit, "a", impact.a, "b", impact.b, "hit", impact.hit);
}
template <class V>
void describe(V& visit, ListHash& list) {
    visit_fields(visit, "size", list.size, "hash", list.hash);
}
template <class V>
void describe(V& visit, UpdateHashes& answer) {
    visit_fields(visit, "began", answer.began, "stayed", answer.stayed, "ended", answer.ended, "fractions",
                 answer.fractions, "contacts", answer.contacts, "impacts", answer.impacts);
}

inline bool is_question(EntryKind kind) {
    return kind >= EntryKind::raycast;
}
/// Whether the answer depends on the last update, and not on the items alone.
inline bool is_about_update(EntryKind kind) {
    return kind >= EntryKind::touching;
}

/// The fields that an entry's kind uses.
template <class V, int D>
void describe(V& visit, Entry<D>& e) {
    using Kind = EntryKind;
    const auto shape_and_place = [&] {
        visit_fields(visit, "shape", e.shape, "is_placed", e.is_placed);
        if (e.is_placed) visit("pose", e.from);
    };
    switch (e.kind) {
        case Kind::shape:
            visit_fields(visit, "shape", e.shape, "bytes", e.bytes);
            break;
        case Kind::add:
            visit_fields(visit, "id", e.id, "shape", e.shape, "options", e.options);
            break;
        case Kind::set_shape:
            visit_fields(visit, "id", e.id, "shape", e.shape);
            break;
        case Kind::move:
            visit_fields(visit, "id", e.id, "pose", e.from);
            break;
        case Kind::set_option:
            visit_fields(visit, "id", e.id, "option", e.option, "value", e.values[0], "mask", e.values[1]);
            break;
        case Kind::remove:
        case Kind::touching:
            visit("id", e.id);
            break;
        case Kind::save:
        case Kind::count:
            break;
        case Kind::restore:
            visit("bytes", e.bytes);
            break;
        case Kind::update:
            visit_fields(visit, "has_pair_filter", e.has_pair_filter, "refused", e.refused);
            break;
        case Kind::raycast:
        case Kind::raycast_any:
        case Kind::raycast_all:
            visit("ray", e.ray);
            break;
        case Kind::sweep:
            visit_fields(visit, "shape", e.shape, "motion", e.vector);
            break;
        case Kind::sweep_motion:
            visit_fields(visit, "shape", e.shape, "motion", e.motion);
            break;
        case Kind::sweep_poses:
            visit_fields(visit, "shape", e.shape, "from", e.from, "to", e.to);
            break;
        case Kind::k_nearest:
            visit("k", e.values[0]);
            shape_and_place();
            break;
        case Kind::closest:
        case Kind::overlapping:
            shape_and_place();
            break;
        case Kind::k_nearest_to_point:
            visit_fields(visit, "k", e.values[0], "point", e.vector);
            break;
        case Kind::closest_to_point:
        case Kind::containing:
            visit("point", e.vector);
            break;
        case Kind::each_contact:
            visit_fields(visit, "shape", e.shape, "margin", e.margin, "back_faces", e.back_faces);
            break;
        case Kind::contact:
        case Kind::impact:
            visit("pair", e.pair);
            break;
    }
    if (is_question(e.kind) && !is_about_update(e.kind)) visit("filter", e.filter);
}

/// Writes what `describe` lists.
struct FieldWriter {
    BlobWriter& out;

    template <class T>
    void operator()(const char*, T& value) {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
            out.number(value);
        else
            describe(*this, value);
    }
    template <class T>
    void operator()(const char*, std::vector<T>& values) {
        out.number(static_cast<std::uint64_t>(values.size()));
        if constexpr (std::is_same_v<T, std::byte>)
            out.array(std::span<const std::byte>(values));
        else
            for (T& value : values) (*this)("", value);
    }
    template <class T>
    void operator()(const char*, std::optional<T>& value) {
        out.number(static_cast<std::uint8_t>(value ? 1 : 0));
        if (value) (*this)("", *value);
    }
};

/// Reads it. The numbers of a change or a question must be finite, but for the length of a ray.
struct FieldReader {
    BlobReader& in;
    bool is_answer = false;
    bool is_good = true;

    template <class T>
    void operator()(const char* name, T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t flag = 0;
            is_good = is_good && in.number(flag) && flag <= 1;
            value = flag == 1;
        } else if constexpr (std::is_enum_v<T>) {
            is_good = is_good && in.number(value);
        } else if constexpr (std::is_arithmetic_v<T>) {
            is_good = is_good && in.number(value);
            if constexpr (std::is_same_v<T, float>)
                is_good =
                    is_good && (is_answer || std::isfinite(value) || (value > 0 && name == std::string_view("length")));
        } else {
            describe(*this, value);
        }
    }
    template <class T>
    void operator()(const char*, std::vector<T>& values) {
        std::uint64_t count = 0;
        is_good = is_good && in.number(count) && count <= in.left();
        if (!is_good) return;
        if constexpr (std::is_same_v<T, std::byte>) {
            is_good = in.array(values, count);
        } else {
            for (std::uint64_t i = 0; i < count && is_good; ++i) (*this)("", values.emplace_back());
        }
    }
    template <class T>
    void operator()(const char*, std::optional<T>& value) {
        bool has_value = false;
        (*this)("", has_value);
        if (is_good && has_value) (*this)("", value.emplace());
    }
};

template <class T>
std::vector<std::byte> encoded(T value) {
    BlobWriter out;
    FieldWriter writer{out};
    writer("", value);
    return std::move(out.bytes);
}

template <class T>
ListHash hash_of(std::span<const T> list) {
    return {list.size(), blob_checksum(encoded(std::vector<T>(list.begin(), list.end())))};
}

template <int D>
UpdateHashes hashes_of(const World<D>& world, const Events& events) {
    return {hash_of(events.began),     hash_of(events.stayed),    hash_of(events.ended),
            hash_of(events.fractions), hash_of(world.contacts()), hash_of(world.impacts())};
}

/// Calls take(value) with an empty answer of the type that the kind has.
template <int D, class F>
void with_answer_type(EntryKind kind, F&& take) {
    using Kind = EntryKind;
    switch (kind) {
        case Kind::raycast:
        case Kind::sweep:
        case Kind::sweep_motion:
        case Kind::sweep_poses:
            return take(std::optional<WorldHit<D>>());
        case Kind::raycast_any:
        case Kind::restore:
            return take(false);
        case Kind::raycast_all:
            return take(std::vector<WorldHit<D>>());
        case Kind::closest:
        case Kind::closest_to_point:
            return take(std::optional<WorldClosest<D>>());
        case Kind::k_nearest:
        case Kind::k_nearest_to_point:
            return take(std::vector<WorldClosest<D>>());
        case Kind::overlapping:
        case Kind::containing:
        case Kind::touching:
            return take(std::vector<Id>());
        case Kind::each_contact:
            return take(std::vector<WorldContact<D>>());
        case Kind::contact:
            return take(Contact<D>());
        case Kind::impact:
            return take(std::optional<Hit<D>>());
        case Kind::update:
            return take(UpdateHashes());
        case Kind::save:
            return take(ListHash());
        case Kind::add:
            return take(Id());
        default:
            return;
    }
}

/// Answers a question, in the form in which answers are recorded. `shape` is that of a question about one.
template <int D>
std::vector<std::byte> answer_of(const World<D>& world, const Entry<D>& entry, const AnyShape<D>* shape);

/// The contacts of a shape, sorted.
template <int D>
std::vector<WorldContact<D>> contacts_of(const World<D>& world, const View<D>& shape, const Filter& filter,
                                         const QueryOptions<D>& options);

/// A C++ program that repeats one question in a world with the items that matter. `answers` are the recorded one and
/// that of this world, whose items it has in any case. Empty if the lines would be too long.
template <int D>
std::string code_of(const World<D>& world, const Entry<D>& entry, const AnyShape<D>* shape,
                    const std::array<std::vector<std::byte>, 2>& answers);

/// Lines for an update: they load a world, as save_with_shapes has written it.
template <int D>
std::string code_of_update(std::span<const std::byte> file);

/// An answer as text, by parts: the path of a number, and the number.
template <int D>
std::vector<std::pair<std::string, std::string>> text_of(EntryKind kind, std::span<const std::byte> answer);

}  // namespace abut::detail
