#include "convex_hulls_plane.hpp"

#include <limits>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace abut::bench {

Side qhull_hull_2(const SharedPoints2& points) {
    return {"qhull", [points](std::span<double> values) {
                std::vector<double> coordinates;
                coordinates.reserve(2 * points->size());
                for (const Vec2& p : *points) coordinates.insert(coordinates.end(), {p.x, p.y});
                qhT state;
                qhT* qh = &state;
                qh_zero(qh, nullptr);
                char command[] = "qhull Pp";
                const int failed = qh_new_qhull(qh, 2, static_cast<int>(points->size()), coordinates.data(), False,
                                                command, nullptr, nullptr);
                values[0] = values[1] = std::numeric_limits<double>::quiet_NaN();
                if (failed == 0) {
                    qh_getarea(qh, qh->facet_list);
                    values[0] = qh->totvol;
                    values[1] = qh->totarea;
                }
                qh_freeqhull(qh, qh_ALL);
            }};
}

}  // namespace abut::bench
