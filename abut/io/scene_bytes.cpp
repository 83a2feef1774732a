#include <abut/io/scene_bytes.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace abut {
namespace {

constexpr std::uint32_t magic = 0x53545541;  // "AUTS": other bytes, or a machine of the other endianness, are refused

// Writer and Reader have the same calls, so that one `carry` below says for both what a scene consists of.
class Writer {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void carry(const T& value) { append(&value, sizeof(T)); }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void carry_all(const std::vector<T>& values) {
        carry(values.size());
        append(values.data(), values.size() * sizeof(T));
    }

    void carry(const std::string& text) {
        carry(text.size());
        append(text.data(), text.size());
    }

    template <class T, class Each>
    void carry_each(const std::vector<T>& values, Each each) {
        carry(values.size());
        for (const T& value : values) each(*this, value);
    }

    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(const void* from, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(from);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::byte> bytes_;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void carry(T& value) {
        if (has(1, sizeof(T))) take(&value, sizeof(T));
    }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void carry_all(std::vector<T>& values) {
        std::size_t size = 0;
        carry(size);
        if (!has(size, sizeof(T))) return;
        values.resize(size);
        take(values.data(), size * sizeof(T));
    }

    void carry(std::string& text) {
        std::size_t size = 0;
        carry(size);
        if (!has(size, 1)) return;
        text.resize(size);
        take(text.data(), size);
    }

    template <class T, class Each>
    void carry_each(std::vector<T>& values, Each each) {
        std::size_t size = 0;
        carry(size);
        for (std::size_t i = 0; i < size && has(1, 1); ++i) each(*this, values.emplace_back());
    }

    bool good() const { return good_; }
    bool at_end() const { return rest_.empty(); }

private:
    bool has(std::size_t count, std::size_t size) {
        good_ = good_ && count <= rest_.size() / size;
        return good_;
    }
    void take(void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, rest_.data(), size);
        rest_ = rest_.subspan(size);
    }

    std::span<const std::byte> rest_;
    bool good_ = true;
};

template <class Bytes, class Track>
void carry_track(Bytes& bytes, Track& track) {
    bytes.carry(track.interpolation);
    bytes.carry_all(track.times);
    bytes.carry_all(track.values);
    bytes.carry_all(track.in_tangents);
    bytes.carry_all(track.out_tangents);
}

template <class Bytes, class AnyScene>
void carry_scene(Bytes& bytes, AnyScene& scene) {
    bytes.carry_each(scene.geometries, [](Bytes& to, auto& geometry) {
        to.carry(geometry.name);
        to.carry_all(geometry.points);
        to.carry_all(geometry.triangles);
        to.carry_all(geometry.normals);
        to.carry(geometry.left_out);
    });
    bytes.carry_each(scene.nodes, [](Bytes& to, auto& node) {
        to.carry(node.name);
        to.carry(node.parent);
        to.carry(node.local);
        to.carry_all(node.geometries);
    });
    bytes.carry_each(scene.animations, [](Bytes& to, auto& animation) {
        to.carry(animation.name);
        to.carry(animation.start);
        to.carry(animation.length);
        to.carry_each(animation.motions, [](Bytes& inner, auto& motion) {
            inner.carry(motion.node);
            carry_track(inner, motion.translation);
            carry_track(inner, motion.rotation);
            carry_track(inner, motion.scale);
        });
    });
    bytes.carry_each(scene.warnings, [](Bytes& to, auto& warning) { to.carry(warning); });
    bytes.carry_each(scene.left_out, [](Bytes& to, auto& left_out) {
        to.carry(left_out.node);
        to.carry(left_out.triangles);
    });
}

template <class Bytes, class AnyProblem>
void carry_problem(Bytes& bytes, AnyProblem& problem) {
    bytes.carry(problem.code);
    bytes.carry(problem.message);
    bytes.carry(problem.index);
}

template <class Track>
bool is_sound(const Track& track) {
    const std::size_t tangents = track.interpolation == Interpolation::cubic ? track.times.size() : 0;
    return track.interpolation <= Interpolation::cubic && track.values.size() == track.times.size() &&
           track.in_tangents.size() == tangents && track.out_tangents.size() == tangents;
}

bool is_sound(const Scene& scene) {
    for (const Geometry& geometry : scene.geometries) {
        if (!geometry.normals.empty() && geometry.normals.size() != geometry.points.size()) return false;
        for (const glm::uvec3& t : geometry.triangles)
            if (t.x >= geometry.points.size() || t.y >= geometry.points.size() || t.z >= geometry.points.size())
                return false;
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        if (node.parent != SceneNode::no_parent && node.parent >= i) return false;
        for (const std::uint32_t geometry : node.geometries)
            if (geometry >= scene.geometries.size()) return false;
    }
    for (const Animation& animation : scene.animations)
        for (const NodeMotion& motion : animation.motions)
            if (motion.node >= scene.nodes.size() || !is_sound(motion.translation) || !is_sound(motion.rotation) ||
                !is_sound(motion.scale))
                return false;
    return std::all_of(scene.left_out.begin(), scene.left_out.end(),
                       [&](const NodeLeftOut& left_out) { return left_out.node < scene.nodes.size(); });
}

}  // namespace

std::vector<std::byte> to_bytes(const Result<Scene>& scene) {
    Writer writer;
    writer.carry(magic);
    writer.carry(static_cast<std::uint8_t>(static_cast<bool>(scene)));
    if (scene)
        carry_scene(writer, *scene);
    else
        carry_problem(writer, scene.problem());
    return writer.take();
}

Result<Scene> scene_from_bytes(std::span<const std::byte> bytes) {
    const Problem not_ours{ProblemCode::bad_format, "these bytes are no scene"};
    Reader reader(bytes);
    std::uint32_t begins = 0;
    std::uint8_t has_scene = 0;
    reader.carry(begins);
    reader.carry(has_scene);
    if (!reader.good() || begins != magic || has_scene > 1) return not_ours;
    if (has_scene == 0) {
        Problem problem;
        carry_problem(reader, problem);
        if (!reader.good() || !reader.at_end() || problem.code > ProblemCode::cancelled) return not_ours;
        return problem;
    }
    Scene scene;
    carry_scene(reader, scene);
    if (!reader.good() || !reader.at_end() || !is_sound(scene)) return not_ours;
    return scene;
}

}  // namespace abut
