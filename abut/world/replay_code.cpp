// The C++ program that repeats one question of a recording.

#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/detail/content_hash.hpp>
#include <abut/shape/segment.hpp>
#include <abut/world/detail/recording.hpp>
#include <abut/world/file.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

namespace abut::detail {

namespace {

constexpr std::size_t max_code = 400'000;

/// Visits every id in a value.
template <class F>
struct EachId {
    const F& visit;

    template <class T>
    void operator()(const char*, T& value) {
        if constexpr (std::is_same_v<T, Id>)
            visit(value);
        else if constexpr (!std::is_arithmetic_v<T> && !std::is_enum_v<T>)
            describe(*this, value);
    }
    template <class T>
    void operator()(const char*, std::vector<T>& values) {
        if constexpr (!std::is_same_v<T, std::byte>)
            for (T& value : values) (*this)("", value);
    }
    template <class T>
    void operator()(const char*, std::optional<T>& value) {
        if (value) (*this)("", *value);
    }
};

/// The answer with other ids.
template <int D, class F>
std::vector<std::byte> with_ids(EntryKind kind, std::span<const std::byte> answer, const F& visit) {
    std::vector<std::byte> result;
    with_answer_type<D>(kind, [&](auto value) {
        BlobReader in(answer);
        FieldReader reader{in, true};
        reader("", value);
        EachId<F> each{visit};
        each("", value);
        result = encoded(value);
    });
    return result;
}

// C++ literals; those of floats are exact.

std::string text(float number) {
    if (std::isinf(number)) return "std::numeric_limits<float>::infinity()";
    char result[40];
    std::snprintf(result, sizeof(result), "%af", static_cast<double>(number));
    return result;
}
std::string text(std::uint64_t number) {
    return std::to_string(number) + "u";
}
template <int N>
std::string text(const glm::vec<N, float>& v) {
    std::string result = "{";
    for (int i = 0; i < N; ++i) result += (i > 0 ? ", " : "") + text(v[i]);
    return result + "}";
}
std::string text(const Turn& turn) {
    return "Turn{" + text(turn.cos) + ", " + text(turn.sin) + "}";
}
std::string text(const glm::quat& q) {
    return "glm::quat(" + text(q.w) + ", " + text(q.x) + ", " + text(q.y) + ", " + text(q.z) + ")";
}
template <int D>
std::string text(const Pose<D>& pose) {
    return "{" + text(pose.position) + ", " + text(pose.rotation) + "}";
}
std::string text(std::span<const std::byte> bytes) {
    std::string result = "{";
    for (std::size_t i = 0; i < bytes.size(); ++i)
        result += (i == 0 ? "" : i % 30 == 0 ? ",\n     " : ",") + std::to_string(std::to_integer<int>(bytes[i]));
    return result + "}";
}

/// Lets the view decide whether a simple shape is exactly this one.
template <int D>
struct Literal {
    std::uint64_t hash;
    std::string result = "";

    template <class S>
    void try_shape(const S& shape, const std::string& code) {
        if (result.empty() && content_hash(View<D>(abut::view(shape))) == hash) result = code;
    }
};

/// A shape as C++: a literal of a simple one, else the bytes of its file. Empty if no file can hold it.
template <int D>
std::string text_of_shape(const AnyShape<D>& shape) {
    const std::string d = std::to_string(D);
    const View<D> view = shape.view();
    Literal<D> literal{content_hash(view)};
    if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&view)) {
        const HalfSpace<D> guess{to_float(half_space->normal), static_cast<float>(half_space->offset)};
        literal.try_shape(guess, "HalfSpace" + d + "{" + text(guess.normal) + ", " + text(guess.offset) + "}");
    } else if (const auto* convex = std::get_if<Convex<D>>(&view)) {
        const auto radius = static_cast<float>(convex->radius);
        if (convex->core == Core::points && convex->count == 1) {
            const Vec<D> center = convex->vertices()[0];
            literal.try_shape(Ball<D>{center, radius}, "Ball<" + d + ">{" + text(center) + ", " + text(radius) + "}");
        } else if (convex->core == Core::points && convex->count == 2) {
            const Vec<D> a = convex->vertices()[0], b = convex->vertices()[1];
            const std::string ends = d + "{" + text(a) + ", " + text(b);
            literal.try_shape(Segment<D>{a, b}, "Segment" + ends + "}");
            literal.try_shape(Capsule<D>{a, b, radius}, "Capsule" + ends + ", " + text(radius) + "}");
        } else if (convex->core == Core::box) {
            Box<D> box{to_float(convex->place.offset), convex->own[0]};
            std::string code = "Box" + d + "{" + text(box.center) + ", " + text(box.half);
            literal.try_shape(box, code + "}");
            if constexpr (D == 2) {
                const Vec2 axis = to_float(convex->place.column[0]);
                box.rotation = {axis.x, axis.y};
                literal.try_shape(box, code + ", " + text(box.rotation) + "}");
            }
        }
    }
    if (!literal.result.empty()) return literal.result;
    World<D> alone;
    alone.add(shape);
    const Result<std::vector<std::byte>> file = save_with_shapes(alone);
    return file && file->size() < max_code / 4 ? "shape_of(" + text(*file) + ")" : "";
}

template <int D>
std::string text_of_options(const ItemOptions<D>& options) {
    const ItemOptions<D> usual;
    std::string result = "{.pose = " + text(options.pose);
    if (options.layers != usual.layers) result += ", .layers = " + text(options.layers);
    if (options.mask != usual.mask) result += ", .mask = " + text(options.mask);
    if (options.fixed) result += ", .fixed = true";
    if (options.sensor) result += ", .sensor = true";
    return result + "}";
}

template <int D>
std::string text_of_filter(const Entry<D>& entry) {
    const RecordedFilter& filter = entry.filter;
    const Filter usual;
    std::string result;
    if (filter.layers != usual.layers) result += ".layers = " + text(filter.layers) + ", ";
    if (filter.mask != usual.mask) result += ".mask = " + text(filter.mask) + ", ";
    if (filter.sensors) result += ".sensors = true, ";
    if (!filter.ignore_ids.empty()) result += ".ignore_ids = ignored, ";
    if (!result.empty()) result.resize(result.size() - 2);
    return "{" + result + "}";
}

/// The call, and the statement that prints its answer.
template <int D>
std::string text_of_question(const Entry<D>& entry, const std::string& shape) {
    using Kind = EntryKind;
    const std::string d = std::to_string(D), filter = ", " + text_of_filter(entry);
    const std::string ray = "Ray" + d + "{" + text(entry.ray.origin) + ", " + text(entry.ray.direction) + ", " +
                            text(entry.ray.length) + "}";
    const std::string point = "Vec" + d + text(entry.vector);
    const std::string own = entry.is_placed ? "at(shape, Pose" + d + text(entry.from) + ")" : "shape";
    const std::string k = ", " + std::to_string(entry.values[0]);
    const std::string axes = D == 2 ? " %a %a" : " %a %a %a";
    const auto numbers = [&](const std::string& vector) {
        return ", " + vector + ".x, " + vector + ".y" + (D == 2 ? "" : ", " + vector + ".z");
    };
    const std::string one_hit = "    if (answer)\n        std::printf(\"item %u, fraction %a, distance %a, normal" +
                                axes + "\\n\", answer->id.index, answer->hit.fraction, answer->hit.distance" +
                                numbers("answer->hit.normal") + ");\n    else\n        std::puts(\"none\");\n";
    const std::string one_closest = "    if (answer)\n        std::printf(\"item %u, distance %a, normal" + axes +
                                    "\\n\", answer->id.index, answer->closest.distance" +
                                    numbers("answer->closest.normal") + ");\n    else\n        std::puts(\"none\");\n";
    const std::string all_hits =
        "    for (const auto& each : answer)\n        std::printf(\"item %u, distance %a\\n\", "
        "each.id.index, each.hit.distance);\n";
    const std::string all_closest =
        "    for (const auto& each : answer)\n        std::printf(\"item %u, distance "
        "%a\\n\", each.id.index, each.closest.distance);\n";
    const std::string all_ids = "    for (const Id id : answer) std::printf(\"item %u\\n\", id.index);\n";
    const std::string call = "    const auto answer = world.";
    const std::string with_shape = shape.empty() ? "" : "    const auto shape = " + shape + ";\n";
    switch (entry.kind) {
        case Kind::raycast:
            return call + "raycast(" + ray + filter + ");\n" + one_hit;
        case Kind::raycast_any:
            return call + "raycast_any(" + ray + filter + ");\n    std::puts(answer ? \"true\" : \"false\");\n";
        case Kind::raycast_all:
            return call + "raycast_all(" + ray + filter + ");\n" + all_hits;
        case Kind::sweep:
            return with_shape + call + "sweep(shape, " + point + filter + ");\n" + one_hit;
        case Kind::sweep_motion:
            return with_shape + call + "sweep(shape, Motion" + d + "{" + text(entry.motion.from) + ", " +
                   text(entry.motion.move) + ", " + text(entry.motion.turn) + "}" + filter + ");\n" + one_hit;
        case Kind::sweep_poses:
            return with_shape + call + "sweep(shape, Pose" + d + text(entry.from) + ", Pose" + d + text(entry.to) +
                   filter + ");\n" + one_hit;
        case Kind::closest:
            return with_shape + call + "closest(" + own + filter + ");\n" + one_closest;
        case Kind::closest_to_point:
            return call + "closest(" + point + filter + ");\n" + one_closest;
        case Kind::k_nearest:
            return with_shape + call + "k_nearest(" + own + k + filter + ");\n" + all_closest;
        case Kind::k_nearest_to_point:
            return call + "k_nearest(" + point + k + filter + ");\n" + all_closest;
        case Kind::overlapping:
            return with_shape + call + "overlapping(" + own + filter + ");\n" + all_ids;
        case Kind::containing:
            return call + "containing(" + point + filter + ");\n" + all_ids;
        default:
            return with_shape + "    world.each_contact(\n        shape,\n        [](Id id, const Contact<" + d +
                   ">& contact) {\n            std::printf(\"item %u, depth %a, normal" + axes +
                   "\\n\", id.index, contact.depth" + numbers("contact.normal") + ");\n        }" + filter +
                   ", {.margin = " + text(entry.margin) + ", .back_faces = " + (entry.back_faces ? "true" : "false") +
                   "});\n";
    }
}

std::string program(int dimension, const std::string& body) {
    const std::string d = std::to_string(dimension);
    std::string result =
        "#include <abut/abut.hpp>\n\n#include <cstdio>\n#include <limits>\n\nusing namespace abut;\n\n";
    if (body.find("shape_of(") != std::string::npos)
        result += "template <std::size_t n>\nAnyShape<" + d + "> shape_of(const unsigned char (&bytes)[n]) {\n" +
                  "    return load_world<" + d + ">(std::as_bytes(std::span(bytes)))->any_shape({1, 1});\n}\n\n";
    return result + "int main() {\n" + body + "}\n";
}

/// The items without which the answer would be another one, and those of the answers.
template <int D>
std::vector<Id> items_that_matter(const World<D>& world, const Entry<D>& entry, const AnyShape<D>* shape,
                                  const std::array<std::vector<std::byte>, 2>& answers) {
    std::set<Id> named;
    for (const auto& answer : answers) (void)with_ids<D>(entry.kind, answer, [&](Id& id) { named.insert(id); });
    World<D> fewer = world;
    std::vector<Id> needed, others;
    world.each_item([&](Id id) {
        if (world.is_enabled(id)) (named.contains(id) ? needed : others).push_back(id);
    });
    int questions = 0;
    constexpr int max_questions = 2000;
    const auto enable = [&](std::size_t from, std::size_t to, bool enabled) {
        for (std::size_t i = from; i < to; ++i) fewer.set_enabled(others[i], enabled);
    };
    for (std::size_t chunk = std::max<std::size_t>(others.size(), 1); chunk > 0; chunk /= 2)
        for (std::size_t from = 0; from < others.size() && questions < max_questions;) {
            const std::size_t to = std::min(from + chunk, others.size());
            enable(from, to, false);
            ++questions;
            if (answer_of(fewer, entry, shape) == answers[1]) {
                others.erase(others.begin() + static_cast<std::ptrdiff_t>(from),
                             others.begin() + static_cast<std::ptrdiff_t>(to));
            } else {
                enable(from, to, true);
                from = to;
            }
        }
    needed.insert(needed.end(), others.begin(), others.end());
    std::sort(needed.begin(), needed.end());
    return needed;
}

}  // namespace

template <int D>
std::string code_of(const World<D>& world, const Entry<D>& entry, const AnyShape<D>* shape,
                    const std::array<std::vector<std::byte>, 2>& answers) {
    World<D> alone;
    std::map<Id, Id> ids;
    std::string body = "    World<" + std::to_string(D) + "> world;\n";
    for (const Id id : items_that_matter(world, entry, shape, answers)) {
        const AnyShape<D> own = world.any_shape(id);
        const std::string shape_text = text_of_shape(own);
        if (shape_text.empty() || body.size() > max_code) return "";
        const ItemOptions<D> options = world.options(id);
        ids[id] = alone.add(own, options);
        body += "    world.add(" + shape_text + ", " + text_of_options(options) + ");  // item " +
                std::to_string(ids[id].index) + ", in the recording " + std::to_string(id.index) + "\n";
    }
    // An item that the filter's function refused is as good as ignored.
    Entry<D> asked = entry;
    std::vector<Id> ignored = entry.filter.ignore_ids;
    ignored.insert(ignored.end(), entry.filter.refused.begin(), entry.filter.refused.end());
    ignored.push_back(entry.filter.ignore);
    asked.filter.ignore = {};
    asked.filter.ignore_ids.clear();
    asked.filter.refused.clear();
    std::string list;
    for (const Id id : ignored) {
        if (!ids.contains(id)) continue;
        asked.filter.ignore_ids.push_back(ids[id]);
        list += std::string(list.empty() ? "" : ", ") + "{" + std::to_string(ids[id].index) + ", 1}";
    }
    if (!list.empty()) body += "    const std::vector<Id> ignored{" + list + "};\n";
    std::string shape_text;
    if (shape != nullptr && (shape_text = text_of_shape(*shape)).empty()) return "";
    body += text_of_question(asked, shape_text);
    const std::vector<std::byte> now = answer_of(alone, asked, shape),
                                 expected = with_ids<D>(entry.kind, answers[1],
                                                        [&](Id&id) { id = ids.contains(id) ? ids[id] : id; });
    if (now != expected)
        body = "    // These items alone give another answer than the replay: it depends on what happened before.\n" +
               body;
    return program(D, body);
}

template <int D>
std::string code_of_update(std::span<const std::byte> file) {
    if (file.size() > max_code / 4) return "";
    const std::string d = std::to_string(D);
    return program(D, "    const unsigned char bytes[] = " + text(file) + ";\n    World<" + d +
                          "> world = *load_world<" + d +
                          ">(std::as_bytes(std::span(bytes)));\n"
                          "    const Events events = world.update();\n"
                          "    std::printf(\"began %zu, stayed %zu, ended %zu, contacts %zu\\n\", events.began.size(), "
                          "events.stayed.size(), events.ended.size(), world.contacts().size());\n");
}

template std::string code_of(const World<2>&, const Entry<2>&, const AnyShape<2>*,
                             const std::array<std::vector<std::byte>, 2>&);
template std::string code_of(const World<3>&, const Entry<3>&, const AnyShape<3>*,
                             const std::array<std::vector<std::byte>, 2>&);
template std::string code_of_update<2>(std::span<const std::byte>);
template std::string code_of_update<3>(std::span<const std::byte>);

}  // namespace abut::detail
