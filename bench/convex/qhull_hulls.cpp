#include "hulls.hpp"
#include "hulls_plane.hpp"

#include <limits>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace abut::bench {
namespace {

template <int D>
Side side(const std::shared_ptr<const std::vector<Vec<D>>>& points) {
    return {"qhull", [points](std::span<double> values) {
                std::vector<double> coordinates;
                coordinates.reserve(D * points->size());
                for (const Vec<D>& p : *points)
                    for (int i = 0; i < D; ++i) coordinates.push_back(p[i]);
                qhT state;
                qhT* qh = &state;
                qh_zero(qh, nullptr);
                char command[] = "qhull Pp";
                const int failed = qh_new_qhull(qh, D, static_cast<int>(points->size()), coordinates.data(), False,
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

}  // namespace

Side qhull_hull(const SharedPoints& points) {
    return side<3>(points);
}

Side qhull_hull_2(const SharedPoints2& points) {
    return side<2>(points);
}

}  // namespace abut::bench
