// Scenes of Godot: what collides in them.

#include "gltf_builder.hpp"
#include <abut/io/read_scene.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace abut {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}
Result<Scene> read_godot(const std::string& text) {
    return read_scene(bytes_of(text), ".tscn");
}

/// The boxes around the geometry of nodes, in world space, by their paths.
std::map<std::string, Aabb3> boxes_of(const Scene& scene) {
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, 0, matrices);
    std::map<std::string, Aabb3> result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        for (const std::uint32_t geometry : scene.nodes[i].geometries) {
            Aabb3& box = result.try_emplace(path(scene, i), Aabb3::empty()).first->second;
            for (const Vec3& p : scene.geometries[geometry].points) {
                const Vec3 point(matrices[i] * glm::dvec4(p, 1));
                box = merged(box, Aabb3{point, point});
            }
        }
    return result;
}

void expect_box(const std::map<std::string, Aabb3>& boxes, const std::string& path, const Vec3& low, const Vec3& high) {
    const auto found = boxes.find(path);
    ASSERT_NE(found, boxes.end()) << path;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found->second.min[i], low[i], 1e-5) << path << ' ' << i;
        EXPECT_NEAR(found->second.max[i], high[i], 1e-5) << path << ' ' << i;
    }
}

std::string message_of(const Result<Scene>& scene) {
    return scene ? std::string("read") : scene.problem().message;
}

class ReadTscn : public test::SceneFiles {
protected:
    std::filesystem::path write_below(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder() / name).parent_path());
        return write(name, text);
    }
};

const std::string colliders = "the file has colliders of its own: these are read, and not the meshes that are drawn";
const std::string head = "[gd_scene load_steps=2 format=3 uid=\"uid://a\"]\n";

TEST_F(ReadTscn, ShapesOfBodies) {
    const Result<Scene> scene = read_godot(head + R"(
[sub_resource type="BoxShape3D" id="box"]
size = Vector3(1, 2, 4)

[sub_resource type="SphereShape3D" id="ball"]

[sub_resource type="CapsuleShape3D" id="capsule"]
radius = 0.25
height = 3.0

[sub_resource type="CylinderShape3D" id="cylinder"]
radius = 2.0

[sub_resource type="ConvexPolygonShape3D" id="hull"]
points = PackedVector3Array(0, 0, 0, 1, 0, 0, 0, 1, 0,
    0, 0, 1, 0.1, 0.1, 0.1)

[sub_resource type="ConcavePolygonShape3D" id="mesh"]
data = PackedVector3Array(0, 0, 0, 1, 0, 0, 0, 0, 2, 5, 0, 0, 6, 0, 0, 5, 0, 1)
backface_collision = true

[sub_resource type="HeightMapShape3D" id="heights"]
map_width = 3
map_data = PackedFloat32Array(0, 1, 0, 0, 2, 0)

[node name="Level" type="Node3D"]

[node name="Floor" type="StaticBody3D" parent="." groups=["a", "b [c"]]
transform = Transform3D(0, 0, 1, 0, 1, 0, -1, 0, 0, 10, 20, 30)
metadata/text = "a \"quoted\" [word]
on two lines = 3"

[node name="Box" type="CollisionShape3D" parent="Floor"]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0)
shape = SubResource("box")

[node name="Ball" type="CollisionShape3D" parent="Floor"]
transform = Transform3D(2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 5, 0)
shape = SubResource("ball")

[node name="Player" type="CharacterBody3D" parent="."]
properties = { "size": Vector3(1, 2, 3), "names": ["}", 2] }

[node name="Capsule" type="CollisionShape3D" parent="Player"]
shape = SubResource("capsule")

[node name="Cylinder" type="CollisionShape3D" parent="Player"]
position = Vector3(0, 10, 0)
rotation = Vector3(0, 0, 1.5707963267948966)
scale = Vector3(1, 3, 1)
shape = SubResource("cylinder")

[node name="Hull" type="CollisionShape3D" parent="Player"]
shape = SubResource("hull")

[node name="Off" type="CollisionShape3D" parent="Player"]
shape = SubResource("hull")
disabled = true

[node name="Ground" type="StaticBody3D" parent="."]

[node name="Mesh" type="CollisionShape3D" parent="Ground"]
shape = SubResource("mesh")

[node name="Heights" type="CollisionShape3D" parent="Ground"]
shape = SubResource("heights")

[node name="Zone" type="Area3D" parent="."]

[node name="Shape" type="CollisionShape3D" parent="Zone"]
shape = SubResource("box")

[connection signal="pressed" from="." to="Zone" method="_on_pressed"]
)");
    ASSERT_TRUE(scene) << message_of(scene);
    const auto boxes = boxes_of(*scene);
    EXPECT_EQ(boxes.size(), 7u);
    // A quarter turn about y takes x to -z and z to x.
    expect_box(boxes, "Level/Floor/Box", {8, 19, 28.5f}, {12, 21, 29.5f});
    expect_box(boxes, "Level/Floor/Ball", {9, 24, 29}, {11, 26, 31});
    expect_box(boxes, "Level/Player/Capsule", {-0.25f, -1.5f, -0.25f}, {0.25f, 1.5f, 0.25f});
    expect_box(boxes, "Level/Player/Cylinder", {-3, 8, -2}, {3, 12, 2});
    expect_box(boxes, "Level/Player/Hull", {0, 0, 0}, {1, 1, 1});
    expect_box(boxes, "Level/Ground/Mesh", {0, 0, 0}, {6, 0, 2});
    expect_box(boxes, "Level/Ground/Heights", {-1, 0, -0.5f}, {1, 2, 0.5f});
    for (const SceneNode& node : scene->nodes)
        EXPECT_EQ(node.is_body, node.name == "Floor" || node.name == "Player" || node.name == "Ground") << node.name;
    // The front of ground is above.
    for (const Geometry& geometry : scene->geometries)
        if (geometry.name == "mesh" || geometry.name == "heights")
            for (const glm::uvec3& t : geometry.triangles) {
                const Vec3 a = geometry.points[t.x];
                EXPECT_GT(glm::cross(geometry.points[t.y] - a, geometry.points[t.z] - a).y, 0) << geometry.name;
            }
    EXPECT_EQ(scene->warnings, std::vector<std::string>{colliders});
}

TEST_F(ReadTscn, InstancesOfOtherScenes) {
    write_below("project.godot", "");
    write_below("props/ball.tres", "[gd_resource type=\"SphereShape3D\" format=3]\n\n[resource]\nradius = 2.0\n");
    write_below("props/crate.tscn", head + R"(
[ext_resource type="Shape3D" path="res://props/ball.tres" id="1_ball"]
[sub_resource type="BoxShape3D" id="box"]
[node name="Crate" type="RigidBody3D"]
[node name="Shape" type="CollisionShape3D" parent="."]
shape = SubResource("box")
[node name="Ball" type="CollisionShape3D" parent="."]
shape = ExtResource("1_ball")
)");
    const std::string level = head + R"(
[ext_resource type="PackedScene" uid="uid://b" path="res://props/crate.tscn" id="1"]
[ext_resource type="PackedScene" path="res://tree.glb" id="2"]
[sub_resource type="BoxShape3D" id="large"]
size = Vector3(4, 4, 4)
[node name="Level" type="Node3D"]
[node name="First" parent="." instance=ExtResource("1")]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 10, 0, 0)
[node name="Second" parent="." instance=ExtResource("1")]
[node name="Shape" parent="Second" index="0"]
shape = SubResource("large")
[node name="Ball" parent="Second" index="1"]
disabled = true
[node name="Tree" parent="." instance=ExtResource("2")]
[node name="Trunk" parent="Tree/Mesh" index="0"]
[node name="Body" type="StaticBody3D" parent="Tree"]
[node name="Shape" type="CollisionShape3D" parent="Tree/Body"]
shape = SubResource("large")
)";
    const Result<Scene> scene = read_scene(write_below("level.tscn", level));
    ASSERT_TRUE(scene) << message_of(scene);
    const auto boxes = boxes_of(*scene);
    EXPECT_EQ(boxes.size(), 4u);
    expect_box(boxes, "Level/First/Shape", {9.5f, -0.5f, -0.5f}, {10.5f, 0.5f, 0.5f});
    expect_box(boxes, "Level/First/Ball", {8, -2, -2}, {12, 2, 2});
    expect_box(boxes, "Level/Second/Shape", {-2, -2, -2}, {2, 2, 2});
    expect_box(boxes, "Level/Tree/Body/Shape", {-2, -2, -2}, {2, 2, 2});
    EXPECT_EQ(scene->warnings,
              (std::vector<std::string>{"1 instance of other files than .tscn is left out, such as 'res://tree.glb'",
                                        colliders}));

    // Beside the scene's folder only if that is allowed.
    const std::filesystem::path below = write_below("levels/level.tscn", level);
    EXPECT_EQ(message_of(read_scene(below)), "line 8: 'res://props/crate.tscn' lies outside of the file's folder");
    const Result<Scene> allowed = read_scene(below, {.allow_outside = true});
    ASSERT_TRUE(allowed) << message_of(allowed);
    EXPECT_EQ(boxes_of(*allowed), boxes);
}

// They were looked for beside the scene that has the instance of the one that names them.
TEST_F(ReadTscn, NamesAreRelativeToTheFileThatHasThem) {
    const std::string ball = "[gd_resource type=\"SphereShape3D\" format=3]\n\n[resource]\nradius = 2.0\n";
    write_below("props/shapes/ball.tres", ball);
    write_below("props/lamp.tscn", head + R"(
[ext_resource type="Shape3D" path="shapes/ball.tres" id="1"]
[node name="Lamp" type="StaticBody3D"]
[node name="Shape" type="CollisionShape3D" parent="."]
shape = ExtResource("1")
)");
    write_below("props/street.tscn", head + R"(
[ext_resource type="PackedScene" path="lamp.tscn" id="1"]
[node name="Street" type="Node3D"]
[node name="Lamp" parent="." instance=ExtResource("1")]
)");
    for (const std::string name : {"props/street.tscn", "res://props/street.tscn", "props/../props/street.tscn"}) {
        const Result<Scene> scene =
            read_scene(write_below("town.tscn", head + "[ext_resource path=\"" + name + R"(" id="1"]
[node name="Town" type="Node3D"]
[node name="Street" parent="." instance=ExtResource("1")]
)"));
        ASSERT_TRUE(scene) << name << ": " << message_of(scene);
        expect_box(boxes_of(*scene), "Town/Street/Lamp/Shape", {-2, -2, -2}, {2, 2, 2});
    }
}

TEST_F(ReadTscn, SaysWhatIsWrongWhere) {
    const std::string shape = "[sub_resource type=\"BoxShape3D\" id=\"b\"]\n";
    const std::string body = "[node name=\"A\" type=\"StaticBody3D\"]\n";
    const std::string collider =
        "[node name=\"S\" type=\"CollisionShape3D\" parent=\".\"]\nshape = SubResource(\"b\")\n";
    const std::array<std::pair<std::string, std::string>, 12> cases{{
        {"hello", "line 1: is no scene of Godot"},
        {"[gd_resource format=3]\n", "is no scene of Godot"},
        {"[gd_scene format=2]\n", "is a scene of Godot 3 or earlier: save it with Godot 4"},
        {"[gd_scene]\n", "is a scene of Godot 3 or earlier: save it with Godot 4"},
        {head + shape + "size = Vector3(1, 2\n" + body, "line 5: parentheses don't end"},
        {head + shape + "size\n", "line 3: has no '='"},
        {head + shape + "size = \n\n", "line 5: has no value after '='"},
        {head + shape + "name = \"never\n", "line 4: a string doesn't end"},
        {head + shape + "list = [1, 2\n", "line 4: brackets don't end"},
        {head + "[node name=\"A\"", "line 2: a section doesn't end"},
        {head + body + "[node name=\"B\" parent=\".\" instance=ExtResource(\"7\")]\n",
         "line 3: has an instance of no resource"},
        {head + "[ext_resource path=\"res://a.tscn\" id=\"1\"]\n" + body +
             "[node name=\"B\" parent=\".\" instance=ExtResource(\"1\")]\n",
         "line 4: 'res://a.tscn' isn't a file beside this one"},
    }};
    for (const auto& [text, message] : cases) EXPECT_EQ(message_of(read_godot(text)), message) << text;
    EXPECT_EQ(message_of(read_godot(head + shape + body)), "has no collision shape of a body in space");
    EXPECT_EQ(message_of(read_godot(head + shape + "[node name=\"A\" type=\"Area3D\"]\n" + collider)),
              "has no collision shape of a body in space");
    EXPECT_EQ(message_of(read_godot(head + "[node name=\"A\" type=\"StaticBody2D\"]\n")),
              "is a 2D scene of Godot; 3D ones are read");
    EXPECT_EQ(message_of(read_godot(head + shape + body + collider)), "read");
    EXPECT_EQ(message_of(read_scene(bytes_of(head + shape + body + collider), ".tscn", {.ignore_colliders = true})),
              "of a scene of Godot only its colliders are read");
}

TEST_F(ReadTscn, NamesWhatIsLeftOut) {
    const Result<Scene> scene = read_godot(head + R"(
[sub_resource type="BoxShape3D" id="b"]
[sub_resource type="WorldBoundaryShape3D" id="w"]
[node name="A" type="StaticBody3D"]
[node name="S" type="CollisionShape3D" parent="."]
shape = SubResource("b")
[node name="W" type="CollisionShape3D" parent="."]
shape = SubResource("w")
[node name="N" type="Node3D" parent="."]
[node name="Stray" type="CollisionShape3D" parent="N"]
shape = SubResource("b")
[node name="Grid" type="GridMap" parent="."]
)");
    ASSERT_TRUE(scene) << message_of(scene);
    EXPECT_EQ(scene->warnings,
              (std::vector<std::string>{"2 shapes that abut can't read are left out, such as 'w'",
                                        "1 collision shape below no body and no area is left out, such as 'Stray'",
                                        colliders}));
}

TEST_F(ReadTscn, InstancesWithoutEndAreRefused) {
    const std::string self =
        head + "[ext_resource type=\"PackedScene\" path=\"a.tscn\" id=\"1\"]\n" +
        "[node name=\"A\" type=\"Node3D\"]\n[node name=\"B\" parent=\".\" instance=ExtResource(\"1\")]\n";
    const std::string message = message_of(read_scene(write_below("a.tscn", self)));
    EXPECT_EQ(message, "'a.tscn': line 4: instances in one another, more than 64 deep");
    // Two in each: twice as many in each deeper one.
    const std::string twice = self + "[node name=\"C\" parent=\".\" instance=ExtResource(\"1\")]\n";
    for (int i = 0; i < 40; ++i) {
        std::string text = twice;
        text.replace(text.find("a.tscn"), 6, std::to_string(i + 1) + ".tscn");
        write_below(std::to_string(i) + ".tscn", text);
    }
    write_below("40.tscn", head + "[node name=\"A\" type=\"Node3D\"]\n");
    const std::string many = message_of(read_scene(folder() / "0.tscn"));
    EXPECT_NE(many.find("more than 1048576 nodes"), std::string::npos) << many;
}

}  // namespace
}  // namespace abut
