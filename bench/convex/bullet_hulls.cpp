#include "hulls.hpp"

#include <LinearMath/btConvexHullComputer.h>

namespace abut::bench {

Side bullet_hull(const SharedPoints& points) {
    return {.who = "bullet",
            .run =
                [points](std::span<double> values) {
                    btConvexHullComputer hull;
                    hull.compute(&(*points)[0].x, sizeof(Vec3), static_cast<int>(points->size()), 0, 0);
                    SurfaceSum sum;
                    const auto corner = [&](int i) {
                        const btVector3& p = hull.vertices[i];
                        return DVec<3>(p.x(), p.y(), p.z());
                    };
                    for (int face = 0; face < hull.faces.size(); ++face) {
                        const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[face]];
                        const DVec<3> origin = corner(first->getSourceVertex());
                        for (const auto* edge = first->getNextEdgeOfFace();
                             edge->getTargetVertex() != first->getSourceVertex(); edge = edge->getNextEdgeOfFace())
                            sum.add(origin, corner(edge->getSourceVertex()), corner(edge->getTargetVertex()));
                    }
                    sum.write(values);
                },
            .strays = 1};
}

}  // namespace abut::bench
