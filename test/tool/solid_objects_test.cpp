#include "tool/objects/solid_objects.hpp"

#include "tool_runs.hpp"
#include <abut/io/read_level.hpp>

#include <map>

namespace abut::tool {
namespace {

using test::Json;

std::string tiles(const std::string& name, const std::string& csv, const std::string& more = "") {
    return "<layer name='" + name + "' width='4' height='2'>" + more + "<data encoding='csv'>" + csv +
           "</data></layer>";
}
std::string things(const std::string& name, const std::string& objects) {
    return "<objectgroup name='" + name + "'>" + objects + "</objectgroup>";
}
std::string box(const std::string& name, const std::string& type, const std::string& more = "") {
    return "<object name='" + name + "' type='" + type + "' x='2' y='2' width='10' height='10'>" + more + "</object>";
}

class SolidObjectsInMaps : public test::ToolRuns {
protected:
    std::string map(const std::string& layers, const std::string& tileset = "") const {
        return write("map.tmx",
                     "<map orientation='orthogonal' width='4' height='2' tilewidth='16' tileheight='16'>" +
                         (tileset.empty() ? "<tileset firstgid='1' tilewidth='16' tileheight='16'/>" : tileset) +
                         layers + "</map>")
            .string();
    }
    std::map<std::string, bool> solid(const std::string& file, const std::vector<std::string>& patterns = {}) const {
        const Result<Level> level = read_level(file);
        EXPECT_TRUE(level);
        const Result<SolidObjects> solid = solid_objects(*level, patterns);
        EXPECT_TRUE(solid);
        std::map<std::string, bool> result;
        for (std::size_t i = 0; i < level->objects.size(); ++i) result[level->objects[i].path] = solid->solid[i];
        return result;
    }
};

using Solid = std::map<std::string, bool>;

TEST_F(SolidObjectsInMaps, ALayerOfCollisionsIsAllThatCollides) {
    const std::string file = map(tiles("Ground", "1,1,1,1,1,1,1,1") + tiles("Collision", "0,1,0,0,0,0,0,0") +
                                 things("Objects", box("door", "warp") + box("crate", "")));
    EXPECT_EQ(solid(file),
              (Solid{{"Ground", false}, {"Collision", true}, {"Objects/door", false}, {"Objects/crate", false}}));
    EXPECT_EQ(solid(file, {"Objects", "Ground"}),
              (Solid{{"Ground", true}, {"Collision", false}, {"Objects/door", true}, {"Objects/crate", true}}));
    const Json json = checked({file}, 0);
    EXPECT_EQ(json["objects"], 1);
    EXPECT_EQ(json["warnings"].back(),
              "1 of 4 objects and layers collide, by their names, classes and properties; not 'Ground', for example; "
              "--solid PATTERN selects others");
    EXPECT_EQ(refusal({"check", file, "--solid", "Walls"}),
              "abut: " + file + ": --solid: no object and no layer is named 'Walls'");
    EXPECT_EQ(solid(map(things("Collisions", box("a", "collision")) + things("Events", box("b", "event")))),
              (Solid{{"Collisions/a", true}, {"Events/b", false}}));
}

TEST_F(SolidObjectsInMaps, PropertiesAndClassesSaySo) {
    const std::string yes = "<properties><property name='solid' type='bool' value='true'/></properties>";
    const std::string no = "<properties><property name='collides' type='bool' value='false'/></properties>";
    EXPECT_EQ(solid(map(tiles("Floor", "1,1,1,1,1,1,1,1") + tiles("House", "1,1,0,0,0,0,0,0", yes) +
                        things("Things", box("a", "Solid") + box("b", "", no) + box("c", "")))),
              (Solid{{"Floor", false}, {"House", true}, {"Things/a", true}, {"Things/b", false}, {"Things/c", false}}));
    EXPECT_EQ(solid(map(things("Things", box("b", "", no) + box("c", "")))),
              (Solid{{"Things/b", false}, {"Things/c", true}}));
}

TEST_F(SolidObjectsInMaps, TilesWithShapesCollideAndPicturesDont) {
    const std::string shapes =
        "<tileset firstgid='1' tilewidth='16' tileheight='16' tilecount='2'><tile id='0'><objectgroup><object "
        "width='16' height='16'/></objectgroup></tile></tileset>";
    EXPECT_EQ(solid(map(tiles("Ground", "1,1,1,1,0,0,0,0") + tiles("Rocks", "0,0,0,0,1,0,0,0") +
                            things("Zones", box("z", "")) + things("Things", box("t", "")),
                        shapes)),
              (Solid{{"Ground", true}, {"Rocks", true}, {"Zones/z", false}, {"Things/t", true}}));
    EXPECT_EQ(solid(map(tiles("World", "1,1,1,1,0,0,0,0"))), (Solid{{"World", true}})) << "the only layer";
    EXPECT_EQ(solid(map(tiles("Ground", "1,1,1,1,0,0,0,0") + tiles("Trees", "0,0,0,0,1,0,0,0"))),
              (Solid{{"Ground", false}, {"Trees", false}}))
        << "nothing says what collides";
    EXPECT_EQ(solid(map(tiles("Ground", "1,1,1,1,0,0,0,0") + tiles("Walls", "0,0,0,0,1,0,0,0"))),
              (Solid{{"Ground", false}, {"Walls", true}}));
}

// Rectangles of collision that overlap at the corners of a house are one wall.
TEST_F(SolidObjectsInMaps, TheGroundIsOneBody) {
    const std::string file = map(things("Collisions", box("a", "collision") + box("b", "collision") +
                                                          "<object name='c' x='8' y='2' width='10' height='10'/>"));
    const Json json = checked({file}, 1);
    EXPECT_EQ(json["contacts"].size(), 0u);
    EXPECT_EQ(json["duplicates"].size(), 1u) << "what is there twice is an error still";
}

// Monsters appear anywhere in an area: it is at fault if no place in it is free.
TEST_F(SolidObjectsInMaps, AreasOfSpawnsNeedOneFreePlace) {
    const std::string area = "<object name='wolves' type='spawn' x='5' y='4' width='24' height='8'/>";
    EXPECT_EQ(checked({map(tiles("Collision", "1,0,0,0,0,0,0,0") + things("Objects", area))}, 0)["spawn_points"], 1);
    const Json json = checked({map(tiles("Collision", "1,1,1,0,1,1,1,0") + things("Objects", area))}, 1);
    ASSERT_EQ(json["spawns"].size(), 1u);
    EXPECT_EQ(json["spawns"][0]["position"], Json({17.0, 8.0}));
    const std::string anywhere = "<object name='wolves' type='spawn' x='0' y='0'/>";
    EXPECT_EQ(checked({map(tiles("Collision", "1,1,1,0,1,1,1,0") + things("Objects", anywhere))}, 0)["spawn_points"],
              0);
}

}  // namespace
}  // namespace abut::tool
