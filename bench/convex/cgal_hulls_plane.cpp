#include "hulls_plane.hpp"

#include <iterator>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/ch_akl_toussaint.h>
#include <CGAL/convex_hull_2.h>

namespace abut::bench {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

template <class Hull>
Side side(const char* who, const SharedPoints2& points, Hull hull) {
    auto own = std::make_shared<std::vector<Point>>();
    own->reserve(points->size());
    for (const Vec2& p : *points) own->emplace_back(p.x, p.y);
    return {who, [own, hull](std::span<double> values) {
                std::vector<Point> loop;
                hull(*own, loop);
                write_loop(
                    loop.size(), [&](std::size_t i) { return detail::DVec<2>(loop[i].x(), loop[i].y()); }, values);
            }};
}

}  // namespace

Side cgal_hull_2(const SharedPoints2& points) {
    return side("CGAL", points, [](const std::vector<Point>& given, std::vector<Point>& loop) {
        CGAL::convex_hull_2(given.begin(), given.end(), std::back_inserter(loop));
    });
}

Side cgal_akl_toussaint(const SharedPoints2& points) {
    return side("CGAL Akl-Toussaint", points, [](const std::vector<Point>& given, std::vector<Point>& loop) {
        CGAL::ch_akl_toussaint(given.begin(), given.end(), std::back_inserter(loop));
    });
}

}  // namespace abut::bench
