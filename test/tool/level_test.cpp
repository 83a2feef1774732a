// The tool on levels, as a command line.

#include "tool_runs.hpp"

namespace abut {
namespace {

using test::Json;
using test::Ran;

class ToolOnLevels : public test::ToolRuns {
protected:
    static std::string bundled(const std::string& name) { return ABUT_SOURCE_FOLDER "/scenes/" + name; }
};

std::string map_of(const std::string& objects) {
    return "<map orientation='orthogonal' width='1' height='1' tilewidth='8' tileheight='8'><objectgroup name='L'>" +
           objects + "</objectgroup></map>";
}
std::string box(const std::string& name, const std::string& x) {
    return "<object name='" + name + "' x='" + x + "' y='0' width='10' height='10'/>";
}

TEST_F(ToolOnLevels, CheckFindsTheFaultsOfTheBundledLevel) {
    for (const char* name : {"plateau.tmj", "plateau.tmx"}) {
        const Json json = json_of({"check", bundled(name)}, 1);
        EXPECT_EQ(json["objects"], 8);
        EXPECT_EQ(json["solids"], 6);
        EXPECT_EQ(json["composites"], 2);
        EXPECT_EQ(json["frames"], 1);
        EXPECT_EQ(json["spawn_points"], 1);
        for (const char* none : {"spawns", "gaps", "duplicates", "leaks"}) EXPECT_TRUE(json[none].empty()) << none;
        ASSERT_EQ(json["contacts"].size(), 2u) << json["contacts"];
        const Json &crate = json["contacts"][0], &barrel = json["contacts"][1];
        EXPECT_EQ(barrel["a"], "Things/Barrel");
        EXPECT_EQ(barrel["b"], "World/Ground");
        EXPECT_NEAR(barrel["distance"].get<double>(), -2, 1e-5);
        EXPECT_EQ(barrel["normal"], Json({1.0, 0.0}));
        EXPECT_EQ(crate["a"], "Things/Sunk crate");
        EXPECT_NEAR(crate["distance"].get<double>(), -3, 1e-5);
        EXPECT_EQ(crate["normal"], Json({0.0, 1.0})) << "y points down";
        EXPECT_EQ(crate["points"].size(), 2u);
    }
    const Ran ran = run({"check", bundled("plateau.tmj")});
    for (const char* line :
         {"   1. Things/Sunk crate  and  World/Ground\n        3 deep, near (348, 161.5)\n",
          "note: 1 text is left out: 'Things/sign 9'\n", "objects   8: 6 taken as convex solids, 2 as composites\n",
          "frames    1\n", "FAULTS FOUND: 2 pairs collide\n"})
        EXPECT_NE(ran.out.find(line), std::string::npos) << line << ran.out;
}

TEST_F(ToolOnLevels, CheckFindsTheFaultOfTheBundledDrawing) {
    const Json json = json_of({"check", bundled("cave.svg")}, 1);
    ASSERT_EQ(json["contacts"].size(), 1u) << json["contacts"];
    EXPECT_EQ(json["contacts"][0]["a"], "Rock/Mountain");
    EXPECT_EQ(json["contacts"][0]["b"], "Things/Crate_2/crate");
    EXPECT_NEAR(json["contacts"][0]["distance"].get<double>(), -4, 1e-4);
}

TEST_F(ToolOnLevels, OptionsOfCheck) {
    const std::string file = write("row.tmx", map_of(box("a", "0") + box("b", "7") + box("c", "20"))).string();
    EXPECT_EQ(json_of({"check", file}, 1)["contacts"].size(), 1u);
    EXPECT_EQ(json_of({"check", file, "--allow", "4"}, 0)["contacts"].size(), 0u);
    EXPECT_EQ(json_of({"check", file, "--allow", "4", "--clearance", "5"}, 1)["contacts"][0]["distance"], 3.0);
    EXPECT_EQ(json_of({"check", file, "--pairs", "a:c"}, 0)["pairs"], 0);
    EXPECT_EQ(json_of({"check", file, "--frames", "9"}, 1)["frames"], 1) << "nothing moves";
    const std::string old = write("old.json", run({"check", "--json", file}).out).string();
    EXPECT_EQ(json_of({"check", file, "--baseline", old}, 0)["known"], 1);
    const Ran ran = run({"check", file});
    EXPECT_NE(ran.out.find("3 deep, near (8.5, 5); moving b by (3, 0) separates them"), std::string::npos) << ran.out;
}

TEST_F(ToolOnLevels, CheckKnowsTheInsideOfWhatIsNotConvex) {
    const auto with = [&](const std::string& thing) {
        return write("l.svg", "<svg><path id='L' d='M0 0H300V100H100V300H0z'/>" + thing + "</svg>").string();
    };
    const Json json = json_of({"check", with("<circle id='c' cx='50' cy='50' r='10'/>")}, 1);
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_EQ(json["contacts"][0]["inside"], true);
    EXPECT_NEAR(json["contacts"][0]["distance"].get<double>(), -60, 1e-3) << "50 to the surface, and its radius";
    json_of({"check", with("<circle id='c' cx='200' cy='200' r='50'/>")}, 0);
    json_of({"check", with("<path id='M' d='M0 0H300V100H100V300H0z'/>")}, 1);
    const std::string lines = write("lines.svg",
                                    "<svg><g fill='none'><path id='L' d='M0 0H300V100H100V300H0z'/></g>"
                                    "<circle id='c' cx='50' cy='50' r='10'/></svg>")
                                  .string();
    json_of({"check", lines}, 0);
    const std::string hole = write("hole.svg",
                                   "<svg><path id='wall' fill-rule='evenodd' d='M0 0H99V99H0zM20 20H80V80H20z'/>"
                                   "<circle id='in the hole' cx='50' cy='50' r='10'/>"
                                   "<circle id='in the wall' cx='10' cy='50' r='4'/></svg>")
                                 .string();
    const Json walled = json_of({"check", hole}, 1);
    ASSERT_EQ(walled["contacts"].size(), 1u) << walled;
    EXPECT_EQ(walled["contacts"][0]["a"], "in the wall");
}

// A room of tiles with a wall across it, a door of 8 in the wall, and the given objects.
std::string room_with(const std::string& objects) {
    return "<map orientation='orthogonal' width='6' height='4' tilewidth='16' tileheight='16'><tileset firstgid='1' "
           "tilewidth='16' tileheight='16' tilecount='2'><tile id='0'><objectgroup><object width='16' height='16'/>"
           "</objectgroup></tile><tile id='1'><objectgroup><object width='16' "
           "height='8'/></objectgroup></tile></tileset>"
           "<layer name='Walls' width='6' height='4'><data encoding='csv'>1,1,1,1,1,1,1,0,1,0,0,1,1,0,2,0,0,1,1,1,1,1,"
           "1,1</data></layer><objectgroup name='Things'>" +
           objects + "</objectgroup></map>";
}
std::string point(const std::string& name, const std::string& type, int x, int y) {
    return "<object name='" + name + "' type='" + type + "' x='" + std::to_string(x) + "' y='" + std::to_string(y) +
           "'><point/></object>";
}

TEST_F(ToolOnLevels, CheckReportsSpawnsInWalls) {
    // Spawns: a free one, one in a wall, one too near to a wall for a wide character; and another object.
    const std::string points = point("a", "spawn", 24, 32) + point("Player_Start 2", "", 40, 20) +
                               point("c", "enemy spawn", 24, 20) + point("exit", "", 40, 20);
    const std::string file = write("room.tmx", room_with(points)).string();
    const Json json = json_of({"check", file}, 1);
    EXPECT_EQ(json["spawn_points"], 3);
    ASSERT_EQ(json["spawns"].size(), 1u) << json["spawns"];
    EXPECT_EQ(json["spawns"][0]["name"], "Things/Player_Start 2");
    EXPECT_EQ(json["spawns"][0]["fault"], "inside");
    EXPECT_EQ(json["spawns"][0]["object"], "Walls");
    EXPECT_EQ(json["spawns"][0]["position"], Json({40.0, 20.0}));
    const Json wide = json_of({"check", file, "--character", "6,12", "--gap", "1"}, 1);
    ASSERT_EQ(wide["spawns"].size(), 2u) << wide["spawns"];
    EXPECT_EQ(wide["spawns"][1]["name"], "Things/c");
    EXPECT_NEAR(wide["spawns"][1]["depth"].get<double>(), 2, 1e-4);
    EXPECT_NEAR(wide["spawns"][1]["free"][1].get<double>(), 22, 0.1);
    // By class and by name; and an up direction that isn't y.
    EXPECT_EQ(json_of({"check", file, "--spawn", "exit"}, 1)["spawns"].size(), 1u);
    EXPECT_EQ(json_of({"check", file, "--spawn", "enemy*"}, 0)["spawn_points"], 1);
    EXPECT_EQ(refusal({"check", file, "--spawn", "nobody"}), "abut: " + file + ": --spawn: nothing is named 'nobody'");
    EXPECT_EQ(refusal({"check", file, "--up", "z"}), "abut: " + file + ": --up: a 2D level has no such axis");
    EXPECT_EQ(refusal({"check", file, "--closed", "Walls"}),
              "abut: " + file + ": --closed: leaks are checked in 3D only");
}

TEST_F(ToolOnLevels, CheckReportsSpawnsUnderTheGround) {
    // Where up is -y the lowest point of the character is at the spawn, and below it nothing but the ground.
    const std::string objects = "<object name='ground' x='0' y='40' width='90' height='10'/>";
    const std::string file = write("ground.tmx", map_of(objects + point("spawn", "", 20, 40))).string();
    json_of({"check", file, "--character", "3,10", "--up", "-y"}, 0);
    EXPECT_EQ(json_of({"check", file, "--character", "3,10"}, 1)["spawns"].size(), 1u) << "seen from above";
    const std::string below = write("below.tmx", map_of(objects + point("spawn", "", 20, 80))).string();
    const Json json = json_of({"check", below, "--character", "3,10", "--up", "-y"}, 1);
    ASSERT_EQ(json["spawns"].size(), 1u);
    EXPECT_EQ(json["spawns"][0]["fault"], "no ground");
    // A line overhead is no ground from below, in either direction.
    for (const char* ends : {"0,0 40,0", "40,0 0,0"}) {
        const std::string rope =
            "<object name='rope' x='0' y='10'><polyline points='" + std::string(ends) + "'/></object>";
        const std::string under = write("under.tmx", map_of(objects + rope + point("spawn", "", 20, 40))).string();
        json_of({"check", under, "--character", "3,10", "--up", "-y"}, 0);
    }
}

TEST_F(ToolOnLevels, CheckReportsPassagesThatAreTooNarrow) {
    const std::string file = write("room.tmx", room_with("")).string();
    const Json json = json_of({"check", file, "--gap", "12"}, 1);
    ASSERT_EQ(json["gaps"].size(), 1u) << json["gaps"];
    EXPECT_EQ(json["gaps"][0]["a"], "Walls");
    EXPECT_EQ(json["gaps"][0]["b"], "Walls");
    EXPECT_NEAR(json["gaps"][0]["width"].get<double>(), 8, 1e-5);
    EXPECT_NEAR(json["gaps"][0]["position"][0].get<double>(), 40, 1e-4);
    EXPECT_NEAR(json["gaps"][0]["position"][1].get<double>(), 44, 1e-4);
    json_of({"check", file, "--character", "3.9,8"}, 0);
    const Ran ran = run({"check", file, "--character", "5,10"});
    for (const char* line : {"gaps (ABUT401)\n   1. within Walls\n        8 wide at (40, 44)\n",
                             "FAULTS FOUND: 1 passage is too narrow\n"})
        EXPECT_NE(ran.out.find(line), std::string::npos) << line << ran.out;
    // Lines block both sides, in either direction.
    for (const char* path : {"M0 0H40", "M40 0H0"}) {
        const std::string lines =
            "<svg><g fill='none'><path d='" + std::string(path) + "'/><path d='M40 5H0'/></g></svg>";
        EXPECT_EQ(json_of({"check", write("lines.svg", lines).string(), "--gap", "8"}, 1)["gaps"].size(), 1u) << path;
    }
    // Between curved objects, by their distance.
    const std::string drawing =
        write("two.svg", "<svg><circle id='a' cx='0' cy='0' r='9'/><circle id='b' cx='20' cy='0' r='9'/></svg>")
            .string();
    const Json round = json_of({"check", drawing, "--gap", "3"}, 1);
    ASSERT_EQ(round["gaps"].size(), 1u);
    EXPECT_NEAR(round["gaps"][0]["width"].get<double>(), 2, 2 * 18e-4) << "polygons in them";
}

TEST_F(ToolOnLevels, CheckReportsDuplicates) {
    const std::string rope = "<object name='rope' x='60' y='20'><polyline points='0,0 4,9 2,20'/></object>";
    const std::string file =
        write("twice.tmx", map_of(box("a", "0") + box("b", "20") + box("a again", "0") + rope + rope)).string();
    const Json json = json_of({"check", file}, 1);
    ASSERT_EQ(json["duplicates"].size(), 2u) << json["duplicates"];
    EXPECT_EQ(json["duplicates"][0]["objects"], Json({"L/a", "L/a again"}));
    EXPECT_EQ(json["duplicates"][0]["apart"], 0.0);
    EXPECT_EQ(json["duplicates"][1]["objects"].size(), 2u);
    EXPECT_TRUE(json["leaks"].empty());
    const std::string old = write("old.json", run({"check", "--json", file}).out).string();
    EXPECT_EQ(json_of({"check", file, "--baseline", old}, 0)["duplicates"].size(), 0u);
    const std::string there_and_back =
        write("back.svg", "<svg><path id='p' fill='none' d='M0 0L9 0L0 0L5 5'/></svg>").string();
    const Ran ran = run({"check", there_and_back});
    EXPECT_NE(ran.out.find("1 segment is there again, the first is number 1, at (4.5, 0)"), std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find("NO ERRORS, BUT WARNINGS: 1 object has parts twice"), std::string::npos) << ran.out;
}

TEST_F(ToolOnLevels, CastInTheFilesOwnCoordinates) {
    const std::string file = bundled("plateau.tmj");
    const Json json = json_of({"cast", file, "--from", "320,150", "--to", "400,150"}, 1);
    ASSERT_EQ(json["hits"].size(), 1u);
    EXPECT_EQ(json["hits"][0]["object"], "Things/Sunk crate");
    EXPECT_EQ(json["hits"][0]["point"], Json({340.0, 150.0}));
    EXPECT_EQ(json["hits"][0]["normal"], Json({-1.0, 0.0}));
    EXPECT_EQ(json["from"], Json({320.0, 150.0}));
    // Down through the one-way platform, which is open from below.
    EXPECT_EQ(json_of({"cast", file, "--from", "190,70", "--to", "190,100"}, 1)["hits"][0]["point"],
              Json({190.0, 80.0}));
    EXPECT_EQ(json_of({"cast", file, "--from", "190,100", "--to", "190,70"}, 0)["clear"], true);
    const Json all = json_of({"cast", file, "--from", "40,150", "--to", "440,150", "--all"}, 1);
    EXPECT_EQ(all["hits"].size(), 5u);
    const Json laser =
        json_of({"cast", bundled("cave.svg"), "--from", "80,150", "--to", "410,120", "--bounces", "6"}, 1);
    EXPECT_EQ(laser["hits"].size(), 7u);
    EXPECT_EQ(laser["hits"][0]["object"], "Rock/Mountain");
    const Ran ran = run({"cast", bundled("cave.svg"), "--from", "80,150", "--to", "410,120"});
    EXPECT_NE(ran.out.find(", segment "), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("HIT: Rock/Mountain is in the way"), std::string::npos) << ran.out;
}

TEST_F(ToolOnLevels, CastDrawsWithYDown) {
    const std::string file =
        write("two.tmx", map_of(box("a", "40") + "<object name='low' x='40' y='90' width='10' height='10'/>")).string();
    const std::string picture = (folder() / "picture.svg").string();
    EXPECT_EQ(run({"cast", file, "--from", "0,5", "--to", "90,95", "-o", picture}).code, 0);
    // From the upper left to the lower right, as in the editor.
    const std::string drawn = content(picture);
    const std::size_t line = drawn.find("<line ");
    ASSERT_NE(line, std::string::npos);
    const auto number = [&](const std::string& key) {
        const std::size_t at = drawn.find(key + "=\"", line);
        return std::stod(drawn.substr(at + key.size() + 2));
    };
    EXPECT_LT(number("x1"), number("x2"));
    EXPECT_LT(number("y1"), number("y2"));
}

TEST_F(ToolOnLevels, InfoListsObjects) {
    const Json json = json_of({"info", bundled("plateau.tmx")}, 0);
    ASSERT_EQ(json["objects"].size(), 8u);
    EXPECT_EQ(json["objects"][0]["name"], "Things/Barrel");
    EXPECT_EQ(json["objects"][0]["kind"], "capsule");
    EXPECT_EQ(json["objects"][0]["properties"], Json({{"explodes", "true"}, {"mass", "12.5"}}));
    EXPECT_EQ(json["objects"][7]["kind"], "compound");
    ASSERT_EQ(json["points"].size(), 2u);
    EXPECT_EQ(json["points"][0]["name"], "Things/Start");
    EXPECT_EQ(json["points"][0]["type"], "spawn");
    EXPECT_EQ(json["points"][0]["position"], Json({40.0, 150.0}));
    const Ran ran = run({"info", bundled("plateau.tmx")});
    EXPECT_EQ(ran.code, 0);
    for (const char* line :
         {"  point             (40, 150)  Things/Start (spawn)\n", "  chain            2 segments  Things/Rope\n",
          "objects     8: 6 convex solids, 2 composites\npoints      2\n", "size        480 x 192, from (0, 0) on\n"})
        EXPECT_NE(ran.out.find(line), std::string::npos) << line << ran.out;
}

// Where four full tiles meet each of them is 0 deep, and the spawn was fine.
TEST_F(ToolOnLevels, ASpawnWhereTilesMeetIsInThem) {
    const std::string map =
        "<map orientation='orthogonal' width='4' height='4' tilewidth='10' tileheight='10'>"
        "<layer name='G' width='4' height='4'><data encoding='csv'>0,0,0,0,1,1,1,1,1,1,1,1,1,1,1,1</data></layer>"
        "<objectgroup name='O'><object id='1' name='In' type='spawn' x='20' y='20'><point/></object>"
        "<object id='2' name='On' type='spawn' x='20' y='10'><point/></object></objectgroup></map>";
    const Ran ran = run({"check", write("seam.tmx", map).string(), "--json"});
    EXPECT_EQ(ran.code, 1);
    const Json spawns = Json::parse(ran.out)["spawns"];
    ASSERT_EQ(spawns.size(), 1u) << ran.out;
    EXPECT_EQ(spawns[0]["name"], "O/In");
    EXPECT_NEAR(spawns[0]["depth"].get<double>(), 10, 0.1);
    EXPECT_NEAR(spawns[0]["free"][1].get<double>(), 10, 0.1);
}

TEST_F(ToolOnLevels, BadInputIsNamed) {
    EXPECT_EQ(refusal_of("hex.tmx", "<map orientation='round' tilewidth='1' tileheight='1'/>"),
              "line 1: the map is 'round', which is no orientation that abut knows");
    EXPECT_EQ(refusal_of("cut.svg", "<svg>\n<rect"), "line 2: XML: error parsing start element tag");
    EXPECT_EQ(refusal_of("none.tmj", "{}"), "not a Tiled map: it has no layers and tilewidth");
    EXPECT_EQ(refusal_of("set.tmx", "<map tilewidth='1' tileheight='1'>\n<tileset source='a.tsx'/></map>"),
              "line 2: 'a.tsx': no such file");
    EXPECT_EQ(refusal_of("empty.svg", "<svg/>"), "no shapes in it: 0 objects");
    const std::string file = bundled("plateau.tmj");
    EXPECT_EQ(refusal({"cast", file, "--from", "1,2,3", "--to", "4,5"}),
              "abut: --from: '1,2,3' is not a point of a level, two numbers with a comma between them: X,Y");
    EXPECT_EQ(refusal({"cast", file, "--from", "1,2", "--to", "4,"}),
              "abut: --to: '4,' is not a point of a level, two numbers with a comma between them: X,Y");
    EXPECT_EQ(refusal({"cast", file, "--from", "1,2", "--to", "1,2"}), "abut: --from and --to are the same place");
    EXPECT_EQ(refusal({"cast", file, "--from", "1,2", "--to", "4,2", "--time", "3"}),
              "abut: " + file + ": --time: nothing moves, so the first moment is the only one");
    EXPECT_EQ(refusal({"check", file, "--pairs", "Start:*"}),
              "abut: " + file + ": --pairs: no object is named 'Start'");
}

// Levels alone: files beside them are read, and a missing file is reported with the object that refers to it.
TEST_F(ToolOnLevels, TilesetsAreFoundBesideTheMap) {
    std::filesystem::create_directories(folder() / "maps" / "sets");
    write("maps/sets/t.tsx",
          "<tileset tilewidth='8' tileheight='8'><tile id='0'><objectgroup><object width='8' height='4'/>"
          "</objectgroup></tile></tileset>");
    const std::string file = write("maps/m.tmx",
                                   "<map tilewidth='8' tileheight='8' width='1' height='1'>"
                                   "<tileset firstgid='1' source='sets/t.tsx'/><layer name='L'>"
                                   "<data encoding='csv'>1</data></layer></map>")
                                 .string();
    const Json json = json_of({"info", file}, 0);
    ASSERT_EQ(json["objects"].size(), 1u);
    EXPECT_EQ(json["objects"][0]["kind"], "tiles");
}

}  // namespace
}  // namespace abut
