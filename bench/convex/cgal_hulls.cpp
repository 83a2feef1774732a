#include "hulls.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace abut::bench {

Side cgal_hull(const SharedPoints& points) {
    return {"cgal", [points](std::span<double> values) {
                using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
                std::vector<Point> theirs;
                theirs.reserve(points->size());
                for (const Vec3& p : *points) theirs.emplace_back(p.x, p.y, p.z);
                CGAL::Surface_mesh<Point> hull;
                CGAL::convex_hull_3(theirs.begin(), theirs.end(), hull);
                SurfaceSum sum;
                const auto corner = [&](auto half_edge) {
                    const Point& p = hull.point(hull.target(half_edge));
                    return DVec<3>(p.x(), p.y(), p.z());
                };
                for (const auto face : hull.faces()) {
                    const auto h = hull.halfedge(face);
                    sum.add(corner(h), corner(hull.next(h)), corner(hull.next(hull.next(h))));
                }
                sum.write(values);
            }};
}

}  // namespace abut::bench
