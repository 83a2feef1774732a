#pragma once

// A 2D level as stored in a file: named shapes and named points.
// Plain data in the file's own units and axes, independent of the format. In Tiled maps and SVG files y points down: a
// low y is high on the screen, and a positive angle rotates clockwise there.

#include <abut/io/outlines.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/tile_map.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace abut {

/// A custom property of an object. Numbers are stored as the shortest text that parses to the same number.
struct LevelProperty {
    std::string name;   ///< members of a class value are named "outer.inner"
    std::string type;   ///< as the file names it: "string", "int", "float", "bool", ...
    std::string value;  ///< a bool is "true" or "false"

    friend bool operator==(const LevelProperty&, const LevelProperty&) = default;
};

using Ellipse = Stretched<Circle>;
using RoundedBox = Rounded<Box2>;

/// The shape types of a level. Convex shapes keep their type. A polygon that isn't convex is a closed Chain, which is
/// solid in `contains`. Polylines are open Chains.
using LevelShape =
    std::variant<Polygon, Box2, Circle, Capsule2, Ellipse, RoundedBox, TileMap, Chain, Outlines, Compound2>;

struct LevelObject {
    std::string path;  ///< "Group/Layer/Name": unique in a level that `read_level` returned
    std::string name;  ///< the last component of the path
    std::string type;  ///< the class that the author assigned
    std::vector<LevelProperty> properties;
    LevelShape shape;
    Pose2 pose;                 ///< places the shape: at(shape, pose)
    bool filled = false;        ///< for a closed Chain or Outlines: the enclosed area belongs to the object
    bool is_layer = false;      ///< a tile layer of a map
    bool assumed_full = false;  ///< a tile layer of a map without collision shapes, in which every tile counts as full
};

/// A named point, such as a spawn point.
struct LevelPoint {
    std::string path, name, type;
    std::vector<LevelProperty> properties;
    Vec2 position{};
};

struct Level {
    std::vector<LevelObject> objects;   ///< in file order
    std::vector<LevelPoint> points;     ///< in file order
    std::vector<std::string> warnings;  ///< one line each for whatever was left out or changed
};

/// "polygon", "box", "circle", "capsule", "ellipse", "rounded box", "tiles", "chain", "outlines" or "compound".
std::string_view kind(const LevelShape& shape);

/// Count of parts that query results distinguish: non-empty tiles, segments or children; 1 for a convex shape.
std::size_t count_parts(const LevelShape& shape);

/// A view that refers to the object.
View<2> view(const LevelObject& object);
Aabb2 bounds(const LevelObject& object);

/// The value of a property; null if there is none of that name.
const std::string* property(const std::vector<LevelProperty>& properties, std::string_view name);

/// All points with this class or this name.
std::vector<const LevelPoint*> points_called(const Level& level, std::string_view type_or_name);

}  // namespace abut
