#pragma once

// Compares walks with the oracle's.

#include "../oracle/random.hpp"
#include "../oracle/walk/geodesic.hpp"
#include "walk_surfaces.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

namespace abut::test {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::to_float;

/// Weights that a WalkMesh may return.
inline bool are_valid_weights(const Vec3& weights) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double grains = static_cast<double>(weights[k]) * 0x1p24;
        if (!(grains >= 0) || grains != std::floor(grains)) return false;
        sum += grains;
    }
    return sum == 0x1p24;
}

inline std::string text(const Vec3& v) {
    std::ostringstream out;
    out.precision(9);
    out << "(" << v.x << " " << v.y << " " << v.z << ")";
    return out.str();
}
inline std::string text(const WalkPoint& place) {
    return std::to_string(place.triangle) + text(place.weights);
}
inline std::string text(const Walked& walked) {
    std::ostringstream out;
    out.precision(9);
    out << "place " << text(walked.place) << " length " << walked.length << " lost " << walked.lost << " met "
        << static_cast<int>(walked.met) << " side " << walked.side.triangle << "/" << walked.side.side << " crossings "
        << walked.crossings << " mirrored " << walked.turn.mirrored();
    return out.str();
}

/// Counts and largest errors over many walks.
struct WalkTally {
    std::uint64_t walks = 0, crossings = 0, slid = 0, stopped = 0, near_corners = 0, mirrored = 0;
    std::uint64_t open = 0;   ///< with more close corners than were followed, and an end that no branch has
    std::uint64_t home = 0;   ///< walked back
    double worst = 0;         ///< the largest error of an end, as a share of the tolerance
    double worst_turn = 0;    ///< the largest change of a unit vector
    double worst_length = 0;  ///< as a share of the requested length
    std::uint64_t faults = 0;
    std::map<std::string, std::string> first_faults;  ///< one of each kind

    void fault(const std::string& kind, const std::string& what) {
        ++faults;
        first_faults.try_emplace(kind, what);
    }
    std::string faults_text() const {
        std::string result;
        for (const auto& [kind, what] : first_faults) result += "\n" + kind + ": " + what;
        return result;
    }
    std::string text() const {
        std::ostringstream out;
        out << walks << " walks, " << crossings << " edges, " << slid << " slid, " << stopped << " stopped, "
            << near_corners << " near corners (" << open << " open), " << mirrored << " mirrored, " << home
            << " walked back; end " << worst << " of what is allowed, turn " << worst_turn << ", length "
            << worst_length;
        return out.str();
    }
};

class WalkCheck {
public:
    using End = oracle::GeodesicEnd<long double>;

    WalkCheck(const WalkMesh& mesh, const Surface& surface, const oracle::TriangleAdjacency::Allow& allow = nullptr)
        : mesh_(mesh),
          size_(size_of(surface)),
          edge_(edge_of(surface)),
          triangles_(mesh, allow),
          geodesic_(triangles_, static_cast<long double>(1e-9 * size_)),
          far_(triangles_, static_cast<long double>(1e-4 * edge_)) {}

    double edge() const { return edge_; }

    /// The walk's answer, after comparing it with the oracle's.
    template <int D>
    Walked check(const WalkPoint& place, const Vec<D>& step, WalkTally& tally, const WalkOptions& options = {}) {
        const Walked walked = mesh_.walk(place, step, options);
        ++tally.walks;
        tally.crossings += walked.crossings;
        tally.slid += walked.met == WalkMet::border;
        tally.stopped += walked.met == WalkMet::corner;
        tally.mirrored += walked.turn.mirrored();
        std::vector<End> ends;
        const auto fault = [&](const std::string& what) {
            std::ostringstream out;
            out.precision(9);
            out << "from " << test::text(place) << " step";
            for (int i = 0; i < D; ++i) out << " " << step[i];
            out << " to " << test::text(walked);
            for (const End& end : ends) out << "\n    oracle: " << text(end, walked);
            tally.fault(what, out.str());
        };
        Walked stayed;
        stayed.place = place;
        if (walked.place.triangle >= triangles_.size() || !triangles_.is_walkable(walked.place.triangle)) {
            fault("off the mesh");
            return stayed;
        }
        if (!are_valid_weights(walked.place.weights)) {
            fault("weights");
            return stayed;
        }
        if (walked.met == WalkMet::limit) {
            fault("limit");
            return walked;
        }
        ends = geodesic_.walk(place, step);
        tally.near_corners += ends.size() > 1;
        std::string first;
        for (const End& end : ends) {
            const std::string kind = fault_of(place, length(DVec<D>(step)), walked, end, tally);
            if (kind.empty()) return walked;
            if (first.empty()) first = kind;
        }
        if (geodesic_.is_complete())
            fault(first);
        else
            ++tally.open;
        return walked;
    }

    /// Walks back over the path, if no corner is near: the walk ends at the start.
    void check_back(const WalkPoint& place, const Vec3& step, const Walked& walked, WalkTally& tally) {
        if (walked.met != WalkMet::nothing || walked.length > 30 * edge_) return;
        const std::vector<End> ends = far_.walk(place, step);
        if (ends.size() != 1 || ends[0].near_corner || ends[0].met != WalkMet::nothing) return;
        const Vec3 on_surface = mesh_.to_space(place.triangle, mesh_.to_plane(place.triangle, step));
        const Walked back = mesh_.walk(walked.place, -(walked.turn * on_surface));
        ++tally.home;
        const double away = length(where(back.place) - where(place));
        if (back.met != WalkMet::nothing && away > 1e-5 * size_) return;  // home is at a border, or nearly so
        if (away > 1e-5 * size_)
            tally.fault("not home", "by " + std::to_string(away) + "; from " + test::text(place) + " step " +
                                        test::text(step) + " to " + test::text(walked));
    }

    DVec<3> where(const WalkPoint& place) const { return geodesic_.point_of(place).rounded(); }

private:
    double allowed(const Walked& walked) const { return size_ * (1e-7 + 1e-8 * walked.crossings); }

    std::string text(const End& end, const Walked& walked) const {
        std::ostringstream out;
        out.precision(9);
        out << "triangle " << end.triangle << " length " << static_cast<double>(end.length) << " lost "
            << static_cast<double>(end.lost) << " met " << static_cast<int>(end.met) << " side " << end.side.triangle
            << "/" << end.side.side << " crossings " << end.crossings << " mirrored " << is_mirrored(end) << ", off "
            << length(where(walked.place) - end.point.rounded()) / allowed(walked) << " of what is allowed";
        return out.str();
    }

    /// The name of a wrong part of the answer; empty if the oracle agrees.
    std::string fault_of(const WalkPoint& start, double step, const Walked& walked, const End& end,
                         WalkTally& tally) const {
        // The length along the surface is a difference of doubles.
        const double requested = static_cast<double>(end.requested), rounding = 1e-6 * requested + 1e-15 * step;
        const double off = length(where(walked.place) - end.point.rounded()) / allowed(walked);
        if (!(off <= 1) || !touch(walked.place.triangle, end.triangle)) return "end";
        const double length_off = std::abs(static_cast<double>(walked.length) - static_cast<double>(end.length));
        if (!(length_off <= rounding + allowed(walked))) return "length";
        const double sum = static_cast<double>(walked.length) + static_cast<double>(walked.lost);
        if (!(std::abs(sum - requested) <= rounding)) return "length and lost";
        const double little = rounding + 1e-7 * size_;
        const bool lost_little = static_cast<double>(walked.lost) <= little && static_cast<double>(end.lost) <= little;
        if (walked.met != end.met && !end.near_head_on && !lost_little) return "met";
        if ((walked.met == WalkMet::nothing) != (walked.side.triangle == no_walk_side)) return "met without a side";
        if (walked.met == WalkMet::nothing && walked.lost != 0) return "lost without a border";
        const bool is_inside = is_inner(start.weights);
        if (walked.side != end.side && !lost_little && !end.near_corner && is_inside) return "side";
        if (walked.crossings != end.crossings && is_inside && !end.passed_corner && end.met == WalkMet::nothing &&
            is_inner(walked.place.weights))
            return "crossings";
        if (walked.place.triangle == end.triangle && !is_turned(start, walked, end, tally)) return "turn";
        tally.worst = std::max(tally.worst, off);
        if (requested > 1e-6 * step)
            tally.worst_length = std::max(tally.worst_length, std::abs(sum - requested) / requested);
        return "";
    }

    bool is_mirrored(const End& end) const { return dot(end.normal, geodesic_.normal_of(end.triangle)) < 0; }

    /// The turn maps the step's direction and the triangle's normal to those at the end, in space and in the frames.
    bool is_turned(const WalkPoint& start, const Walked& walked, const End& end, WalkTally& tally) const {
        if (!(end.requested > 0)) return true;
        const Vec3 first = to_float(end.first_direction.rounded()), up = to_float(end.first_normal.rounded());
        const Vec3 direction = walked.turn * first;
        const double off_direction = length(DVec<3>(direction) - end.direction.rounded());
        const double off_up = length(DVec<3>(walked.turn * up) - end.normal.rounded());
        const Vec2 in_frame = mesh_.to_plane(end.triangle, direction);
        const Vec2 turned = walked.turn * mesh_.to_plane(start.triangle, first);
        const double off_frame = length(DVec<2>(in_frame) - DVec<2>(turned));
        const double worst = std::max({off_direction, off_up, off_frame});
        if (!(worst <= 2e-6) || is_mirrored(end) != walked.turn.mirrored()) return false;
        tally.worst_turn = std::max(tally.worst_turn, worst);
        return true;
    }

    static bool is_inner(const Vec3& weights) {
        return std::min({weights.x, weights.y, weights.z}) > 1e-4f * std::max({weights.x, weights.y, weights.z});
    }
    /// Whether two triangles are equal or share a corner.
    bool touch(std::uint32_t a, std::uint32_t b) const {
        for (std::uint32_t i = 0; i < 3; ++i)
            for (std::uint32_t k = 0; k < 3; ++k)
                if (triangles_.vertex(a, i) == triangles_.vertex(b, k)) return true;
        return false;
    }

    const WalkMesh& mesh_;
    double size_, edge_;
    oracle::TriangleAdjacency triangles_;
    oracle::Geodesic<long double> geodesic_, far_;
};

}  // namespace abut::test
