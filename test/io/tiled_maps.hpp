#pragma once

// Tiled maps as text, made in tests. Tiles are 10 x 10, and so are cells.

#include "level_text.hpp"

#include <string>

namespace abut::test {

inline std::string tmx(const std::string& content, const std::string& attributes = "width='4' height='3'") {
    return "<?xml version='1.0'?>\n<map version='1.10' orientation='orthogonal' tilewidth='10' tileheight='10' " +
           attributes + ">\n" + content + "</map>\n";
}
inline std::string tmj(const std::string& tilesets, const std::string& layers,
                       const std::string& more = R"("width":4,"height":3)") {
    return R"({"type":"map","orientation":"orthogonal","tilewidth":10,"tileheight":10,)" + more + R"(,"tilesets":[)" +
           tilesets + R"(],"layers":[)" + layers + "]}";
}

/// Tiles 1 to 4: full, the slope that is low on the left, the half that is low in y, a ledge to jump through.
inline const char* const tiles_tsx = R"(<tileset firstgid="1" name="tiles" tilewidth="10" tileheight="10">
 <tile id="0"><objectgroup><object id="1" x="0" y="0" width="10" height="10"/></objectgroup></tile>
 <tile id="1" type="slope"><properties><property name="grip" type="float" value="0.50"/></properties>
  <objectgroup><object id="1" x="0" y="10"><polygon points="0,0 10,-10 10,0"/></object></objectgroup></tile>
 <tile id="2"><objectgroup><object id="1" x="0" y="0" width="10" height="5"/></objectgroup></tile>
 <tile id="3"><objectgroup><object id="1" x="0" y="0"><polyline points="0,0 10,0"/></object></objectgroup></tile>
 <tile id="4"/>
</tileset>
)";
inline const char* const tiles_tsj =
    R"({"firstgid":1,"name":"tiles","tilewidth":10,"tileheight":10,"tiles":[
 {"id":0,"objectgroup":{"objects":[{"id":1,"x":0,"y":0,"width":10,"height":10}]}},
 {"id":1,"type":"slope","properties":[{"name":"grip","type":"float","value":0.5}],
  "objectgroup":{"objects":[{"id":1,"x":0,"y":10,"polygon":[{"x":0,"y":0},{"x":10,"y":-10},{"x":10,"y":0}]}]}},
 {"id":2,"objectgroup":{"objects":[{"id":1,"x":0,"y":0,"width":10,"height":5}]}},
 {"id":3,"objectgroup":{"objects":[{"id":1,"x":0,"y":0,"polyline":[{"x":0,"y":0},{"x":10,"y":0}]}]}},
 {"id":4}]})";

/// One object of an objects layer called L, as XML.
inline std::string read_object(const std::string& object, const std::string& tilesets = "") {
    return read_as_text(".tmx", tmx(tilesets + "<objectgroup id='9' name='L'>" + object + "</objectgroup>"));
}

}  // namespace abut::test
