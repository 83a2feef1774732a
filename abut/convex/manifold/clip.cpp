// Cuts a body with one plane, and with all planes of another body.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/manifold/clip_planes.hpp>

#include <utility>

namespace abut::detail {
namespace {

using VertexLoop = std::vector<std::uint32_t>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The bound on cuts beyond the face planes; it was never reached in tests.
constexpr int max_trims = 256;

enum class Side : std::uint8_t { behind, on, in_front };

/// Joins edges head to tail into closed loops. The in-degree of each corner equals its out-degree.
std::vector<VertexLoop> closed_loops(std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end());
    std::vector<bool> used(edges.size(), false);
    const auto unused_from = [&](std::uint32_t tail) {
        auto i = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), Edge{tail, 0}) - edges.begin());
        while (i < edges.size() && edges[i].first == tail && used[i]) ++i;
        return i < edges.size() && edges[i].first == tail ? i : edges.size();
    };
    std::vector<VertexLoop> result;
    for (std::size_t first = 0; first < edges.size(); ++first) {
        if (used[first]) continue;
        VertexLoop& loop = result.emplace_back();
        for (std::size_t i = first; i < edges.size(); i = unused_from(edges[i].second)) {
            used[i] = true;
            loop.push_back(edges[i].first);
        }
    }
    return result;
}

/// A single cut of a body.
template <int D>
class Cut {
public:
    Cut(ClipBody<D>& body, const ClipPlane<D>& plane, double tolerance) : body_(body) {
        heights_.reserve(body.points.size());
        for (const DVec<D>& point : body.points) {
            const double height = dot(plane.normal, point) - plane.offset;
            heights_.push_back(height);
            sides_.push_back(height > tolerance ? Side::in_front : (height < -tolerance ? Side::behind : Side::on));
        }
    }

    bool cuts() const { return std::find(sides_.begin(), sides_.end(), Side::in_front) != sides_.end(); }

    std::vector<VertexLoop> run() {
        find_crossings();
        std::vector<VertexLoop> loops;
        for (const VertexLoop& loop : body_.loops) {
            VertexLoop remaining = cut_loop(loop);
            if (!remaining.empty()) loops.push_back(std::move(remaining));
        }
        std::vector<VertexLoop> caps;
        if constexpr (D == 3)
            for (VertexLoop& cap : closed_loops(std::move(openings_)))
                if (cap.size() > 2) caps.push_back(std::move(cap));
        const std::size_t faces = loops.size();
        loops.insert(loops.end(), caps.begin(), caps.end());
        body_.loops = std::move(loops);
        remove_unused_points();
        return {body_.loops.begin() + static_cast<std::ptrdiff_t>(faces), body_.loops.end()};
    }

private:
    bool crosses(std::uint32_t i, std::uint32_t j) const {
        return sides_[i] != Side::on && sides_[j] != Side::on && sides_[i] != sides_[j];
    }

    template <class Visit>
    static void each_edge(const VertexLoop& loop, Visit&& visit) {
        for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
    }

    /// Adds one new point for every edge that crosses the plane, shared by its loops.
    void find_crossings() {
        for (const VertexLoop& loop : body_.loops)
            each_edge(loop, [&](std::uint32_t i, std::uint32_t j) {
                if (crosses(i, j)) crossings_.push_back(std::minmax(i, j));
            });
        std::sort(crossings_.begin(), crossings_.end());
        crossings_.erase(std::unique(crossings_.begin(), crossings_.end()), crossings_.end());
        first_crossing_ = body_.points.size();
        for (const auto& [i, j] : crossings_) {
            const DVec<D> from = body_.points[i], to = body_.points[j];
            body_.points.push_back(from + (to - from) * (heights_[i] / (heights_[i] - heights_[j])));
        }
    }

    std::uint32_t crossing(std::uint32_t i, std::uint32_t j) const {
        const auto found = std::lower_bound(crossings_.begin(), crossings_.end(), Edge(std::minmax(i, j)));
        return static_cast<std::uint32_t>(first_crossing_ + static_cast<std::size_t>(found - crossings_.begin()));
    }

    /// The remaining part of a loop. The edge across a removed part is an opening, and the new face runs along it in
    /// the opposite direction.
    VertexLoop cut_loop(const VertexLoop& loop) {
        VertexLoop remaining;
        bool gap = false, gap_at_start = false;
        const auto append = [&](std::uint32_t point) {
            const bool again = !remaining.empty() && remaining.back() == point;
            if (remaining.empty()) gap_at_start = gap;
            if (gap && !remaining.empty() && !again) openings_.emplace_back(point, remaining.back());
            if (!again) remaining.push_back(point);
            gap = false;
        };
        each_edge(loop, [&](std::uint32_t i, std::uint32_t j) {
            if (sides_[i] == Side::in_front)
                gap = true;
            else
                append(i);
            if (crosses(i, j)) append(crossing(i, j));
        });
        if (remaining.size() < 2) return remaining;
        if (remaining.front() == remaining.back())
            remaining.pop_back();
        else if (gap || gap_at_start)
            openings_.emplace_back(remaining.front(), remaining.back());
        return remaining;
    }

    void remove_unused_points() {
        constexpr std::uint32_t unused = 0xffffffffu;
        std::vector<std::uint32_t> number(body_.points.size(), unused);
        for (const VertexLoop& loop : body_.loops)
            for (const std::uint32_t i : loop) number[i] = 0;
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < number.size(); ++i) {
            if (number[i] == unused) continue;
            body_.points[count] = body_.points[i];
            number[i] = count++;
        }
        body_.points.resize(count);
        for (VertexLoop& loop : body_.loops)
            for (std::uint32_t& i : loop) i = number[i];
    }

    ClipBody<D>& body_;
    std::vector<double> heights_;
    std::vector<Side> sides_;
    std::vector<Edge> crossings_;  ///< sorted
    std::size_t first_crossing_ = 0;
    std::vector<Edge> openings_;
};

template <int D>
double largest_coordinate(const ClipBody<D>& body) {
    double result = 0;
    for (const DVec<D>& point : body.points) result = std::max(result, largest(point));
    return result;
}

/// The largest term of the sums that make the corners of a placed set.
template <int D>
double largest_term(const Convex<D>& convex) {
    double result = largest(convex.place.offset);
    const std::uint32_t count = convex.core == Core::box ? 1 : convex.count;
    for (std::uint32_t i = 0; i < count; ++i)
        for (int j = 0; j < D; ++j)
            result = std::max(result, largest(convex.place.column[static_cast<std::size_t>(j)]) *
                                          std::abs(static_cast<double>(convex.vertices()[i][j])));
    return result;
}

/// Records a cut, with points relative to `origin`: the new faces or, for a flat body, the remainder.
template <int D>
void write(Trace<D>& trace, const ClipPlane<D>& plane, const ClipBody<D>& body, std::vector<VertexLoop> caps,
           const DVec<D>& origin) {
    ClipStep<D> step;
    step.normal = to_float(plane.normal);
    step.offset = static_cast<float>(plane.offset + dot(plane.normal, origin));
    const bool flat = D == 2 || body.loops.size() <= 2;
    if (caps.empty() && flat && !body.empty()) caps = {body.loops[0]};
    for (const VertexLoop& loop : caps)
        for (const std::uint32_t i : loop) step.points.push_back(to_float(origin + body.points[i]));
    trace.steps.push_back(std::move(step));
}

template <int D>
class Clipping {
public:
    /// Relative to a point of the body, so that no precision is lost far from the origin.
    Clipping(const Convex<D>& body, const Convex<D>& tool, Trace<D>* trace)
        : origin_(reference_point(body)), tool_(tool), body_(clip_body(body, origin_)), trace_(trace) {
        tool_.place.offset -= origin_;
        const ClipBody<D> other = clip_body(tool, origin_);
        planes_ = clip_planes(other);
        tool_points_ = other.points;
        const double terms = std::max(largest_term(body), largest_term(tool));
        rounding_ = 0x1p-47 * std::max(largest_coordinate(body_), largest_coordinate(other)) + 0x1p-50 * terms;
        tolerance_ = hull_tolerance * size(tool);
    }

    std::vector<DVec<D>> run() {
        for (const ClipPlane<D>& plane : planes_.planes) {
            apply(plane);
            if (body_.empty()) return {};
        }
        if (planes_.excess > tolerance_) trim();
        std::vector<DVec<D>> result;
        for (const DVec<D>& point : body_.points) result.push_back(origin_ + point);
        return result;
    }

private:
    void apply(const ClipPlane<D>& plane) {
        std::vector<VertexLoop> caps = cut(body_, plane, rounding_);
        if (trace_ != nullptr) write(*trace_, plane, body_, std::move(caps), origin_);
    }

    /// If the faces of the other body don't bound it well, supporting planes cut off the excess.
    void trim() {
        for (int i = 0; i < max_trims && !body_.empty(); ++i) {
            SignedDistance<D> farthest;
            farthest.distance = tolerance_;
            for (const DVec<D>& point : body_.points) {
                Convex<D> corner;
                corner.place.offset = point;
                const SignedDistance<D> now = signed_distance(tool_, corner);
                if (now.distance > farthest.distance) farthest = now;
            }
            if (!(farthest.distance > tolerance_)) return;
            apply(support_plane(tool_points_, farthest.normal));
        }
    }

    DVec<D> origin_;
    Convex<D> tool_;  ///< relative to the origin
    ClipBody<D> body_;
    ClipPlanes<D> planes_;
    std::vector<DVec<D>> tool_points_;
    Trace<D>* trace_;
    double rounding_ = 0;   ///< of a coordinate
    double tolerance_ = 0;  ///< a smaller excess stays
};

}  // namespace

template <int D>
std::vector<VertexLoop> cut(ClipBody<D>& body, const ClipPlane<D>& plane, double tolerance) {
    Cut<D> cut(body, plane, tolerance);
    return cut.cuts() ? cut.run() : std::vector<VertexLoop>();
}

template <int D>
std::vector<DVec<D>> clip(const Convex<D>& a, const Convex<D>& b, Trace<D>* trace) {
    return size(b) < size(a) ? Clipping<D>(b, a, trace).run() : Clipping<D>(a, b, trace).run();
}

#define ABUT_INSTANTIATE(D)                                                          \
    template std::vector<VertexLoop> cut(ClipBody<D>&, const ClipPlane<D>&, double); \
    template std::vector<DVec<D>> clip(const Convex<D>&, const Convex<D>&, Trace<D>*);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
