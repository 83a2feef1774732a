#pragma once

// Small scene files, made in tests.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_uint3.hpp>
#include <gtest/gtest.h>

namespace abut::test {

struct Triangles {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// A closed box from -half to half, wound outwards; inwards if any two halves are swapped in sign.
inline Triangles box_triangles(const Vec3& half, const Vec3& center = {}) {
    Triangles box;
    for (int i = 0; i < 8; ++i)
        box.points.push_back(center + Vec3((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                           (i & 4) != 0 ? half.z : -half.z));
    box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return box;
}

inline std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return text;
}

/// Builds a glTF 2.0 file. Everything is written as given, so that tests can give invalid data.
class GltfBuilder {
public:
    int add_bytes(const void* from, std::size_t size) {
        while (bytes_.size() % 4 != 0) bytes_.push_back(std::byte{0});
        add(views_, "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes_.size()) +
                        ",\"byteLength\":" + std::to_string(size) + "}");
        const auto* first = static_cast<const std::byte*>(from);
        bytes_.insert(bytes_.end(), first, first + size);
        return view_count_++;
    }
    /// `component` is the specification's number: 5126 float, 5125 unsigned.
    int add_accessor(int view, int component, const std::string& type, std::size_t count,
                     const std::string& more = "") {
        add(accessors_, "{\"bufferView\":" + std::to_string(view) + ",\"componentType\":" + std::to_string(component) +
                            ",\"type\":\"" + type + "\",\"count\":" + std::to_string(count) + more + "}");
        return accessor_count_++;
    }
    int add_floats(const std::vector<float>& numbers, const std::string& type, std::size_t count) {
        return add_accessor(add_bytes(numbers.data(), numbers.size() * sizeof(float)), 5126, type, count);
    }
    int add_points(const std::vector<Vec3>& points) {
        return add_accessor(add_bytes(points.data(), points.size() * sizeof(Vec3)), 5126, "VEC3", points.size());
    }
    int add_indices(const std::vector<glm::uvec3>& triangles) {
        return add_accessor(add_bytes(triangles.data(), triangles.size() * sizeof(glm::uvec3)), 5125, "SCALAR",
                            3 * triangles.size());
    }
    /// `primitives` is the text between the brackets.
    int add_mesh(const std::string& name, const std::string& primitives) {
        add(meshes_, "{\"name\":\"" + name + "\",\"primitives\":[" + primitives + "]}");
        return mesh_count_++;
    }
    int add_mesh(const std::string& name, const Triangles& triangles) {
        const int points = add_points(triangles.points);
        const int indices = add_indices(triangles.triangles);
        return add_mesh(name, primitive(points, indices));
    }
    static std::string primitive(int points, int indices, const std::string& more = "") {
        return "{\"attributes\":{\"POSITION\":" + std::to_string(points) + "},\"indices\":" + std::to_string(indices) +
               more + "}";
    }
    /// `more` follows the name, comma first: `,"mesh":0,"children":[1]`.
    int add_node(const std::string& name, const std::string& more) {
        add(nodes_, "{\"name\":\"" + name + "\"" + more + "}");
        return node_count_++;
    }
    int add_node(const std::string& name, int mesh, const Vec3& at = {}) {
        return add_node(name, ",\"mesh\":" + std::to_string(mesh) + ",\"translation\":[" + std::to_string(at.x) + "," +
                                  std::to_string(at.y) + "," + std::to_string(at.z) + "]");
    }
    /// A clip that moves one node along straight lines.
    void add_motion(int node, const std::string& name, const std::vector<float>& times, const std::vector<Vec3>& places,
                    const std::string& interpolation = "LINEAR") {
        const int input = add_floats(times, "SCALAR", times.size());
        const int output = add_points(places);
        add_animation(name, input, output, node, "translation", interpolation);
    }
    void add_animation(const std::string& name, int input, int output, int node, const std::string& path,
                       const std::string& interpolation) {
        add(animations_, "{\"name\":\"" + name + "\",\"samplers\":[{\"input\":" + std::to_string(input) +
                             ",\"output\":" + std::to_string(output) + ",\"interpolation\":\"" + interpolation +
                             "\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":" + std::to_string(node) +
                             ",\"path\":\"" + path + "\"}}]}");
    }
    /// Goes to the end of the outermost object, comma first.
    void add_text(const std::string& text) { more_ += text; }

    /// A .gltf that needs no other file.
    std::string text() const {
        return json("\"uri\":\"data:application/octet-stream;base64," + base64(bytes_) + "\",");
    }
    /// A .gltf whose buffer is in `file`.
    std::string text(const std::string& file) const { return json("\"uri\":\"" + file + "\","); }
    const std::vector<std::byte>& bytes() const { return bytes_; }

    std::string glb() const {
        std::string text = json("");
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string binary(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const std::size_t size = 12 + 8 + text.size() + 8 + binary.size();
        return "glTF" + word(2) + word(size) + word(text.size()) + "JSON" + text + word(binary.size()) +
               std::string("BIN\0", 4) + binary;
    }

    static std::string word(std::size_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
        return bytes;
    }

private:
    static void add(std::string& list, const std::string& element) {
        if (!list.empty()) list += ",";
        list += element;
    }
    std::string json(const std::string& uri) const {
        return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{" + uri +
               "\"byteLength\":" + std::to_string(bytes_.size()) + "}],\"bufferViews\":[" + views_ +
               "],\"accessors\":[" + accessors_ + "],\"meshes\":[" + meshes_ + "],\"nodes\":[" + nodes_ +
               "],\"animations\":[" + animations_ + "]" + more_ + "}";
    }

    std::vector<std::byte> bytes_;
    std::string views_, accessors_, meshes_, nodes_, animations_, more_;
    int view_count_ = 0, accessor_count_ = 0, mesh_count_ = 0, node_count_ = 0;
};

/// A folder of its own for each test, gone afterwards.
class SceneFiles : public testing::Test {
protected:
    SceneFiles() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string("abut_") + info->test_suite_name() + "_" + info->name();
        for (char& c : name)
            if (c == '/') c = '_';
        folder_ = std::filesystem::path(testing::TempDir()) / name;
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~SceneFiles() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = folder_ / name;
        std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
        return file;
    }
    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// The bytes of a text, for readers that take bytes.
inline std::vector<std::byte> bytes_of(std::string_view text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

}  // namespace abut::test
