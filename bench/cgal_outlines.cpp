// CGAL's convex partitions of simple polygons without holes, with its exact predicates.

#include "convex_plane.hpp"

#include <cstddef>
#include <iterator>
#include <list>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/partition_2.h>

namespace abut::bench {
namespace {

using Traits = CGAL::Partition_traits_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
using Parts = std::list<Traits::Polygon_2>;

template <class Cut>
Side cgal(const char* who, const std::vector<Vec2>& outline, Cut cut) {
    return {who, [outline, cut](std::span<double> values) {
                Traits::Polygon_2 polygon;
                for (const Vec2& point : outline) polygon.push_back({point.x, point.y});
                Parts parts;
                cut(polygon, parts);
                std::vector<std::vector<Vec2>> corners;
                for (const Traits::Polygon_2& part : parts) {
                    corners.emplace_back();
                    for (auto i = part.vertices_begin(); i != part.vertices_end(); ++i)
                        corners.back().emplace_back(static_cast<float>(i->x()), static_cast<float>(i->y()));
                }
                values[0] = count_if_covered(corners, outline, {});
            }};
}

}  // namespace

Side cgal_greene(const std::vector<Vec2>& outline) {
    return cgal("cgal greene", outline, [](const Traits::Polygon_2& polygon, Parts& parts) {
        CGAL::greene_approx_convex_partition_2(polygon.vertices_begin(), polygon.vertices_end(),
                                               std::back_inserter(parts), Traits());
    });
}

Side cgal_approximate(const std::vector<Vec2>& outline) {
    return cgal("cgal approx", outline, [](const Traits::Polygon_2& polygon, Parts& parts) {
        CGAL::approx_convex_partition_2(polygon.vertices_begin(), polygon.vertices_end(), std::back_inserter(parts),
                                        Traits());
    });
}

Side cgal_optimal(const std::vector<Vec2>& outline) {
    return cgal("cgal optimal", outline, [](const Traits::Polygon_2& polygon, Parts& parts) {
        CGAL::optimal_convex_partition_2(polygon.vertices_begin(), polygon.vertices_end(), std::back_inserter(parts),
                                         Traits());
    });
}

}  // namespace abut::bench
