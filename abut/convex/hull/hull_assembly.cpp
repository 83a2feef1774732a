#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace abut::detail {

/// Two consecutive points identify a loop.
HullFaces in_order(const HullFaces& faces, std::size_t point_count) {
    const auto first_of = [](std::span<const std::uint32_t> loop) {
        return std::min_element(loop.begin(), loop.end());
    };
    const Buckets order = in_buckets(point_count, [&](auto visit) {
        for (std::uint32_t face = 0; face < faces.normals.size(); ++face) {
            const std::span<const std::uint32_t> loop = faces.loop(face);
            const auto first = first_of(loop), second = first + 1 == loop.end() ? loop.begin() : first + 1;
            visit(*first, std::uint64_t{*second} << 32 | face);
        }
    });
    HullFaces result;
    result.normals.reserve(faces.normals.size());
    result.loops.reserve(faces.loops.size());
    result.loop_ends.reserve(faces.normals.size());
    for (const std::uint64_t key : order.keys) {
        const auto face = static_cast<std::uint32_t>(key);
        const std::span<const std::uint32_t> loop = faces.loop(face);
        const auto first = first_of(loop);
        result.normals.push_back(faces.normals[face]);
        result.loops.insert(result.loops.end(), first, loop.end());
        result.loops.insert(result.loops.end(), loop.begin(), first);
        result.loop_ends.push_back(static_cast<std::uint32_t>(result.loops.size()));
    }
    return result;
}

void take_faces(Hull3& result, std::span<const Vec3> points, HullFaces faces) {
    std::vector<std::uint32_t> number(points.size(), 0);
    for (const std::uint32_t point : faces.loops) number[point] = 1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (number[i] == 0) continue;
        number[i] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(points[i]);
    }
    result.normals = std::move(faces.normals);
    result.loops = std::move(faces.loops);
    result.loop_ends = std::move(faces.loop_ends);
    for (std::uint32_t& point : result.loops) point = number[point];
    result.edges = facet_edges(result.loops, result.loop_ends);
}

double offset_above(const Vec3& normal, std::span<const Vec3> points) {
    const DVec<3> across(normal);
    double result = -std::numeric_limits<double>::infinity(), size = 0;
    for (const Vec3& point : points) {
        result = std::max(result, dot(across, DVec<3>(point)));
        size = std::max(size, largest(DVec<3>(point)));
    }
    const bool along_an_axis = (across.x != 0) + (across.y != 0) + (across.z != 0) == 1;
    return along_an_axis ? result : result + 0x1p-50 * size;
}

}  // namespace abut::detail
