// The questions of a recording, and their answers as text.

#include <abut/world/detail/recording.hpp>

#include <algorithm>
#include <charconv>

namespace abut::detail {

namespace {

/// Calls query(filter) with the filter of an entry.
template <int D, class Query>
auto with_filter(const Entry<D>& entry, const Query& query) {
    const std::vector<Id>& refused = entry.filter.refused;
    const auto accepts = [&](Id id) { return !std::binary_search(refused.begin(), refused.end(), id); };
    Filter filter{entry.filter.layers, entry.filter.mask, entry.filter.sensors, entry.filter.ignore,
                  entry.filter.ignore_ids};
    if (!refused.empty()) filter.accepts = accepts;
    return query(filter);
}

/// Lists the numbers of an answer with their paths.
struct FieldLister {
    std::vector<std::pair<std::string, std::string>>& parts;
    std::string path = "";

    template <class T>
    void operator()(const char* name, T& value) {
        const std::size_t size = path.size();
        path += (path.empty() || *name == 0 ? "" : ".") + std::string(name);
        const auto put = [&](const std::string& text) { parts.emplace_back(path.empty() ? "answer" : path, text); };
        if constexpr (std::is_same_v<T, bool>) {
            put(value ? "true" : "false");
        } else if constexpr (std::is_enum_v<T>) {
            put(std::to_string(static_cast<int>(value)));
        } else if constexpr (std::is_arithmetic_v<T>) {
            char text[40];
            put(std::string(text, std::to_chars(text, text + sizeof(text), value).ptr));
        } else {
            describe(*this, value);
        }
        path.resize(size);
    }
    template <class T>
    void operator()(const char* name, std::vector<T>& values) {
        const std::size_t size = path.size();
        path += (path.empty() || *name == 0 ? "" : ".") + std::string(name);
        parts.emplace_back(path + (path.empty() ? "size" : ".size"), std::to_string(values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t before = path.size();
            path += "[" + std::to_string(i) + "]";
            (*this)("", values[i]);
            path.resize(before);
        }
        path.resize(size);
    }
    template <class T>
    void operator()(const char* name, std::optional<T>& value) {
        if (value) return (*this)(name, *value);
        parts.emplace_back("answer", "none");
    }
};

}  // namespace

template <int D>
std::vector<WorldContact<D>> contacts_of(const World<D>& world, const View<D>& shape, const Filter& filter,
                                         const QueryOptions<D>& options) {
    std::vector<WorldContact<D>> result;
    const auto note = [&](Id id, const Contact<D>& contact) { result.push_back({{}, id, contact}); };
    world.each_contact(shape, note, filter, options);
    std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.b < b.b; });
    return result;
}

template <int D>
std::vector<std::byte> answer_of(const World<D>& world, const Entry<D>& entry, const AnyShape<D>* shape) {
    using Kind = EntryKind;
    const View<D> own = shape != nullptr ? entry.is_placed ? shape->placed(entry.from) : shape->view()
                                         : View<D>(round_points<D>({entry.vector}, 0));
    const auto k = static_cast<std::size_t>(entry.values[0]);
    return with_filter(entry, [&](const Filter& filter) {
        switch (entry.kind) {
            case Kind::raycast:
                return encoded(world.raycast(entry.ray, filter));
            case Kind::raycast_any:
                return encoded(world.raycast_any(entry.ray, filter));
            case Kind::raycast_all:
                return encoded(world.raycast_all(entry.ray, filter));
            case Kind::sweep:
                return encoded(world.sweep(own, entry.vector, filter));
            case Kind::sweep_motion:
                return encoded(world.sweep(own, entry.motion, filter));
            case Kind::sweep_poses:
                return encoded(world.sweep(own, entry.from, entry.to, filter));
            case Kind::closest:
                return encoded(world.closest(own, filter));
            case Kind::closest_to_point:
                return encoded(world.closest(entry.vector, filter));
            case Kind::k_nearest:
                return encoded(world.k_nearest(own, k, filter));
            case Kind::k_nearest_to_point:
                return encoded(world.k_nearest(entry.vector, k, filter));
            case Kind::overlapping:
                return encoded(world.overlapping(own, filter));
            case Kind::each_contact:
                return encoded(
                    contacts_of(world, own, filter, {.margin = entry.margin, .back_faces = entry.back_faces}));
            case Kind::containing:
                return encoded(world.containing(entry.vector, filter));
            case Kind::touching:
                return encoded(world.touching(entry.id));
            case Kind::contact:
                return encoded(world.contact(entry.pair));
            case Kind::impact:
                return encoded(world.impact(entry.pair));
            default:
                return std::vector<std::byte>();
        }
    });
}

template <int D>
std::vector<std::pair<std::string, std::string>> text_of(EntryKind kind, std::span<const std::byte> answer) {
    std::vector<std::pair<std::string, std::string>> parts;
    with_answer_type<D>(kind, [&](auto value) {
        BlobReader in(answer);
        FieldReader reader{in, true};
        reader("", value);
        FieldLister lister{parts};
        lister("", value);
        if (!reader.is_good || in.left() > 0) parts.emplace_back("answer", "is damaged");
    });
    return parts;
}

template std::vector<WorldContact<2>> contacts_of(const World<2>&, const View<2>&, const Filter&,
                                                  const QueryOptions<2>&);
template std::vector<WorldContact<3>> contacts_of(const World<3>&, const View<3>&, const Filter&,
                                                  const QueryOptions<3>&);
template std::vector<std::byte> answer_of(const World<2>&, const Entry<2>&, const AnyShape<2>*);
template std::vector<std::byte> answer_of(const World<3>&, const Entry<3>&, const AnyShape<3>*);
template std::vector<std::pair<std::string, std::string>> text_of<2>(EntryKind, std::span<const std::byte>);
template std::vector<std::pair<std::string, std::string>> text_of<3>(EntryKind, std::span<const std::byte>);

}  // namespace abut::detail
