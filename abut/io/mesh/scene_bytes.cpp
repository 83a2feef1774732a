#include <abut/io/mesh/scene_bytes.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace abut::detail {
namespace {

constexpr std::uint32_t magic = 0x53545541;  // "AUTS": rejects other data and the other endianness

// Both archives have the same functions, so that one `serialize_scene` both writes and reads.
class OutputArchive {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void serialize(const T& value) { append(&value, sizeof(T)); }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void serialize_all(const std::vector<T>& values) {
        serialize(values.size());
        append(values.data(), values.size() * sizeof(T));
    }

    void serialize(const std::string& text) {
        serialize(text.size());
        append(text.data(), text.size());
    }

    template <class T, class Each>
    void serialize_each(const std::vector<T>& values, Each each) {
        serialize(values.size());
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

class InputArchive {
public:
    explicit InputArchive(std::span<const std::byte> bytes) : remaining_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void serialize(T& value) {
        if (has(1, sizeof(T))) take(&value, sizeof(T));
    }

    void serialize(bool& value) {
        std::uint8_t byte = 0;
        serialize(byte);
        good_ = good_ && byte <= 1;
        value = byte == 1;
    }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void serialize_all(std::vector<T>& values) {
        std::size_t size = 0;
        serialize(size);
        if (!has(size, sizeof(T))) return;
        values.resize(size);
        take(values.data(), size * sizeof(T));
    }

    void serialize(std::string& text) {
        std::size_t size = 0;
        serialize(size);
        if (!has(size, 1)) return;
        text.resize(size);
        take(text.data(), size);
    }

    template <class T, class Each>
    void serialize_each(std::vector<T>& values, Each each) {
        std::size_t size = 0;
        serialize(size);
        for (std::size_t i = 0; i < size && has(1, 1); ++i) each(*this, values.emplace_back());
    }

    bool good() const { return good_; }
    bool at_end() const { return remaining_.empty(); }

private:
    bool has(std::size_t count, std::size_t size) {
        good_ = good_ && count <= remaining_.size() / size;
        return good_;
    }
    void take(void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, remaining_.data(), size);
        remaining_ = remaining_.subspan(size);
    }

    std::span<const std::byte> remaining_;
    bool good_ = true;
};

template <class Bytes, class Track>
void serialize_track(Bytes& bytes, Track& track) {
    bytes.serialize(track.interpolation);
    bytes.serialize_all(track.times);
    bytes.serialize_all(track.values);
    bytes.serialize_all(track.in_tangents);
    bytes.serialize_all(track.out_tangents);
}

template <class Bytes, class AnyScene>
void serialize_scene(Bytes& bytes, AnyScene& scene) {
    bytes.serialize_each(scene.geometries, [](Bytes& to, auto& geometry) {
        to.serialize(geometry.name);
        to.serialize_all(geometry.points);
        to.serialize_all(geometry.triangles);
        to.serialize_all(geometry.normals);
        to.serialize(geometry.left_out);
    });
    bytes.serialize_each(scene.nodes, [](Bytes& to, auto& node) {
        to.serialize(node.name);
        to.serialize(node.parent);
        to.serialize(node.local);
        to.serialize_all(node.geometries);
        to.serialize(node.is_body);
    });
    bytes.serialize_each(scene.animations, [](Bytes& to, auto& animation) {
        to.serialize(animation.name);
        to.serialize(animation.start);
        to.serialize(animation.length);
        to.serialize_each(animation.motions, [](Bytes& inner, auto& motion) {
            inner.serialize(motion.node);
            serialize_track(inner, motion.translation);
            serialize_track(inner, motion.rotation);
            serialize_track(inner, motion.scale);
        });
    });
    bytes.serialize_each(scene.warnings, [](Bytes& to, auto& warning) { to.serialize(warning); });
    bytes.serialize_each(scene.left_out, [](Bytes& to, auto& left_out) {
        to.serialize(left_out.node);
        to.serialize(left_out.triangles);
    });
}

template <class Bytes, class AnyProblem>
void serialize_problem(Bytes& bytes, AnyProblem& problem) {
    bytes.serialize(problem.code);
    bytes.serialize(problem.message);
    bytes.serialize(problem.index);
}

template <class Track>
bool is_valid(const Track& track) {
    const std::size_t tangents = track.interpolation == Interpolation::cubic ? track.times.size() : 0;
    return track.interpolation <= Interpolation::cubic && track.values.size() == track.times.size() &&
           track.in_tangents.size() == tangents && track.out_tangents.size() == tangents;
}

bool is_valid(const Scene& scene) {
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
            if (motion.node >= scene.nodes.size() || !is_valid(motion.translation) || !is_valid(motion.rotation) ||
                !is_valid(motion.scale))
                return false;
    return std::all_of(scene.left_out.begin(), scene.left_out.end(),
                       [&](const NodeLeftOut& left_out) { return left_out.node < scene.nodes.size(); });
}

}  // namespace

std::vector<std::byte> to_bytes(const Result<Scene>& scene) {
    OutputArchive archive;
    archive.serialize(magic);
    archive.serialize(static_cast<std::uint8_t>(static_cast<bool>(scene)));
    if (scene)
        serialize_scene(archive, *scene);
    else
        serialize_problem(archive, scene.problem());
    return archive.take();
}

Result<Scene> scene_from_bytes(std::span<const std::byte> bytes) {
    const Problem foreign{ProblemCode::bad_format, "these bytes are no scene"};
    InputArchive archive(bytes);
    std::uint32_t first_word = 0;
    std::uint8_t has_scene = 0;
    archive.serialize(first_word);
    archive.serialize(has_scene);
    if (!archive.good() || first_word != magic || has_scene > 1) return foreign;
    if (has_scene == 0) {
        Problem problem;
        serialize_problem(archive, problem);
        if (!archive.good() || !archive.at_end() || problem.code > ProblemCode::cancelled) return foreign;
        return problem;
    }
    Scene scene;
    serialize_scene(archive, scene);
    if (!archive.good() || !archive.at_end() || !is_valid(scene)) return foreign;
    return scene;
}

}  // namespace abut::detail
