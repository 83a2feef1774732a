#pragma once

// A level of the plane as it stands in a file: named shapes and named places.
// Plain data, in the file's own units and axes; nothing here knows which format it came from. In Tiled maps and in SVG
// files y points down: what is low in y is high on the screen, and a turn by a positive angle is clockwise there.

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

/// What an author has written to a thing. Numbers as text: the shortest that is read as the same number.
struct LevelProperty {
    std::string name;   ///< of a part of a structure "outer.inner"
    std::string type;   ///< "string", "int", "float", "bool", ..., as the file calls it
    std::string value;  ///< of a bool "true" or "false"

    friend bool operator==(const LevelProperty&, const LevelProperty&) = default;
};

using Ellipse = Stretched<Circle>;
using RoundedBox = Rounded<Box2>;

/// What the shapes of a level are. Convex ones as they are; a polygon that isn't convex is a closed Chain, which is
/// solid in `contains`; lines are open ones.
using LevelShape =
    std::variant<Polygon, Box2, Circle, Capsule2, Ellipse, RoundedBox, TileMap, Chain, Outlines, Compound2>;

struct LevelObject {
    std::string path;  ///< "Group/Layer/Name": unique in a level that `read_level` made
    std::string name;  ///< the last part of it
    std::string type;  ///< the class that its author gave it
    std::vector<LevelProperty> properties;
    LevelShape shape;
    Pose2 pose;           ///< the shape stands there: at(shape, pose)
    bool filled = false;  ///< of a closed line: what it goes around belongs to it
};

/// A named place, such as where a player enters.
struct LevelPoint {
    std::string path, name, type;
    std::vector<LevelProperty> properties;
    Vec2 position{};
};

struct Level {
    std::vector<LevelObject> objects;   ///< in the order of the file
    std::vector<LevelPoint> points;     ///< the same
    std::vector<std::string> warnings;  ///< what was left out or taken differently, one line each
};

/// "polygon", "box", "circle", "capsule", "ellipse", "rounded box", "tiles", "chain", "outlines" or "compound".
std::string_view kind(const LevelShape& shape);

/// How many parts the answers about it tell apart: tiles that aren't empty, segments, children; 1 for a convex one.
std::size_t count_parts(const LevelShape& shape);

/// Refers to the object.
View<2> view(const LevelObject& object);
Aabb2 bounds(const LevelObject& object);

/// The value of a property; null where there is none.
const std::string* property(const std::vector<LevelProperty>& properties, std::string_view name);

/// Those of a class, or of a name.
std::vector<const LevelPoint*> points_called(const Level& level, std::string_view type_or_name);

}  // namespace abut
