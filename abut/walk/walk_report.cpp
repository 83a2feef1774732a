#include <abut/walk/walk_mesh.hpp>

#include <string>

namespace abut {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

bool changed(const WalkMeshReport& report) {
    return report.doubled + report.flat + report.left_out + report.turned + report.crowded != 0;
}

std::string described(const WalkMeshReport& report) {
    std::string result = counted(report.islands, "island", "islands");
    const auto tell = [&](std::size_t count, const char* one, const char* many) {
        if (count != 0) result += ", " + counted(count, one, many);
    };
    tell(report.doubled, "triangle there twice", "triangles there twice");
    tell(report.flat, "triangle without area cut away", "triangles without area cut away");
    tell(report.left_out, "triangle without area left out", "triangles without area left out");
    tell(report.turned, "triangle turned", "triangles turned");
    tell(report.crowded, "edge of more than two triangles", "edges of more than two triangles");
    tell(report.mirrored, "edge where the surface turns over", "edges where the surface turns over");
    tell(report.pinched, "pinched point", "pinched points");
    tell(report.border, "border edge", "border edges");
    return result;
}

}  // namespace abut
