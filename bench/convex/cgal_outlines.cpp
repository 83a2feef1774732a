// CGAL's convex partitions of simple polygons without holes, with exact predicates.

#include "../narrow/convex_plane.hpp"

#include <cstddef>
#include <iterator>
#include <list>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/partition_2.h>

namespace abut::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Partition_traits_2<Kernel>;
using Parts = std::list<Traits::Polygon_2>;

template <class Cut>
Side cgal(const char* who, const std::vector<Vec2>& outline, Cut cut) {
    return {who, [outline, cut, expected = area_of(outline)](std::span<double> values) {
                Traits::Polygon_2 polygon;
                for (const Vec2& point : outline) polygon.push_back({point.x, point.y});
                Parts parts;
                cut(polygon, parts);
                double area = 0;
                for (const Traits::Polygon_2& part : parts)
                    area += CGAL::polygon_area_2(part.vertices_begin(), part.vertices_end(), Kernel());
                values[0] = count_if_covered(parts.size(), area, expected);
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
