#include "convex_hulls.hpp"

#include <limits>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace abut::bench {

Side qhull_hull(const SharedPoints& points) {
    return {"qhull", [points](std::span<double> values) {
                std::vector<double> coordinates;
                coordinates.reserve(3 * points->size());
                for (const Vec3& p : *points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
                qhT state;
                qhT* qh = &state;
                qh_zero(qh, nullptr);
                char command[] = "qhull Pp";
                const int failed = qh_new_qhull(qh, 3, static_cast<int>(points->size()), coordinates.data(), False,
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
