#pragma once

// Runs all queries on a pair and compares the answers with the oracle's.

#include "pairs.hpp"
#include "round_pairs.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>

#include <sstream>
#include <string>

namespace abut::corpus {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;

/// A kind of wrong answer. One pair may give several.
enum class Fault {
    oracle,          ///< the oracle can't prove its own answer
    not_finite,      ///< a number that is NaN or infinite
    overlaps,        ///< a wrong overlap test
    distance,        ///< a wrong distance of `closest`
    normal,          ///< a normal not of length 1, or without a gap of the distance along it
    points,          ///< on_a or on_b is no support point along the normal, or not opposite
    contact_exists,  ///< a contact of separated shapes; none of overlapping ones, or within the margin
    contact_depth,   ///< a depth other than minus the distance, or than the deepest point's
    contact_normal,  ///< a normal that does not separate the shapes
    contact_points,  ///< a point not midway between the surfaces
    certify,         ///< a right answer without a certificate, or a wrong one with it
    contains,        ///< a wrong containment test
    raycast,         ///< a missed target, or a hit off the surface
};
inline constexpr int fault_count = 13;
inline constexpr std::array<std::string_view, fault_count> fault_names{
    "oracle",        "not_finite",     "overlaps",       "distance", "normal",   "points", "contact_exists",
    "contact_depth", "contact_normal", "contact_points", "certify",  "contains", "raycast"};

/// The verdict on one pair.
struct Verdict {
    bool overlap = false;
    double distance = 0, margin = 0;
    double worst_distance = 0;  ///< error of the distance, relative to the tolerance
    std::uint32_t faults = 0;   ///< bits, by Fault
    std::string story;          ///< a description of the errors

    /// Records a fault if `value` exceeds `limit` or is NaN.
    void expect(Fault fault, double value, double limit, const char* what) {
        if (value <= limit) return;
        faults |= 1u << static_cast<int>(fault);
        std::ostringstream line;
        line.precision(9);
        line << "    " << fault_names[static_cast<std::size_t>(fault)] << ": " << what << ", " << value << " > "
             << limit << '\n';
        story += line.str();
    }
    void expect(Fault fault, bool right, const char* what) { expect(fault, right ? 0 : 1, 0.5, what); }
};

/// The known facts about a pair.
struct Known {
    double distance = 0;
    double margin = 0;
    double too_deep = 0;  ///< the allowed excess of a depth over the minimum
    double duality_gap = 0;
    double sizes = 0;  ///< the sum of both sizes
};

/// One shape of a pair for the oracle: extent(n) is the support value along a unit vector from `origin`, and
/// beyond(point) the distance of a point outside.
template <int D>
struct PolytopeSide {
    const Sample<D>& sample;
    DVec<D> origin;
    oracle::LocalPolytope<D> at;

    PolytopeSide(const Sample<D>& of, const DVec<D>& from) : sample(of), origin(from), at(of.solid, from) {}
    double extent(const DVec<D>& n) const { return at.max_along(n) + sample.solid.radius; }
    double signed_distance(const DVec<D>& point) const {
        Polytope<D> spot;
        spot.points.push_back(Vec<D>(0.0f));
        spot.place.offset = point;
        return oracle::truth(sample.solid, spot, Arithmetic::floating_point).distance;
    }
    double beyond(const DVec<D>& point) const { return std::max(signed_distance(point), 0.0); }
};
template <int D>
struct RoundSide {
    const RoundShape<D>& shape;
    DVec<D> origin;

    double extent(const DVec<D>& n) const { return shape.extent(n, origin); }
    double beyond(const DVec<D>& point) const { return shape.beyond(point); }
};
template <int D>
struct HalfSpaceSide {
    DVec<D> normal;
    double offset;
    DVec<D> origin;

    double extent(const DVec<D>& n) const {
        // A half-space is unbounded except along its normal; directions within rounding of it count as the normal.
        return dot(n, normal) > 1 - 1e-12 ? offset - dot(normal, origin) : std::numeric_limits<double>::infinity();
    }
    double beyond(const DVec<D>& point) const { return std::max(dot(normal, point) - offset, 0.0); }
};

template <int D>
bool all_finite(const Vec<D>& v) {
    for (int i = 0; i < D; ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

template <int D, class A, class B>
class Judge {
public:
    Judge(const View<D>& view_a, const View<D>& view_b, const A& a, const B& b, const Known& known, Verdict& verdict)
        : view_a_(view_a), view_b_(view_b), a_(a), b_(b), known_(known), verdict_(verdict) {
        verdict.distance = known.distance;
        verdict.margin = known.margin;
        verdict.overlap = known.distance <= 0;
    }

    void judge(const QueryOptions<D>& options) {
        verdict_.expect(Fault::oracle, known_.duality_gap, 0.1 * known_.margin, "the oracle can't prove its distance");
        if (std::abs(known_.distance) > known_.margin)
            verdict_.expect(Fault::overlaps, overlaps(view_a_, view_b_, options) == (known_.distance < 0),
                            known_.distance < 0 ? "no for yes" : "yes for no");
        judge_closest(closest(view_a_, view_b_, options));
        judge_contact(contact(view_a_, view_b_, options));
        judge_near_miss();
    }

private:
    /// A depth may be too large by a bound, and not too small.
    void judge_distance(Fault fault, double distance, const char* what) {
        verdict_.expect(fault, distance - known_.distance, known_.margin, what);
        verdict_.expect(fault, known_.distance - distance,
                        known_.margin + (known_.distance < known_.margin ? known_.too_deep : 0), what);
    }
    /// The gap, or the minimal separating translation, along the normal is the distance within the tolerance.
    void judge_normal(Fault fault, const DVec<D>& normal) {
        verdict_.expect(fault, std::abs(length(normal) - 1), 1e-6, "of some other length than 1");
        const DVec<D> n = normalized(normal);
        // Rounding to float rotates the normal by about 1e-7.
        verdict_.expect(fault, known_.distance + a_.extent(n) + b_.extent(-n),
                        known_.margin + 1e-7 * known_.sizes + (known_.distance < known_.margin ? known_.too_deep : 0),
                        "parts them by less");
    }

    void judge_closest(const Closest<D>& found) {
        const bool finite = std::isfinite(found.distance) && all_finite<D>(found.normal) && all_finite<D>(found.on_a) &&
                            all_finite<D>(found.on_b);
        verdict_.expect(Fault::not_finite, finite, "closest");
        if (!finite) return;
        const double distance = static_cast<double>(found.distance);
        judge_distance(Fault::distance, distance, "wrong by");
        verdict_.worst_distance = std::abs(distance - known_.distance) / known_.margin;
        const DVec<D> normal(found.normal), on_a(found.on_a), on_b(found.on_b);
        judge_normal(Fault::normal, normal);

        const double rounding = 2 * oracle::rounding_of<D>(found.on_a) + 2 * oracle::rounding_of<D>(found.on_b);
        const double limit = known_.margin + rounding;
        const DVec<D> n = normalized(normal);
        verdict_.expect(Fault::points, a_.beyond(on_a), limit, "on_a is outside of A");
        verdict_.expect(Fault::points, b_.beyond(on_b), limit, "on_b is outside of B");
        verdict_.expect(Fault::points, std::abs(a_.extent(n) - dot(n, on_a - a_.origin)), limit + 1e-7 * known_.sizes,
                        "on_a is not at the end of A");
        verdict_.expect(Fault::points, std::abs(b_.extent(-n) + dot(n, on_b - b_.origin)), limit + 1e-7 * known_.sizes,
                        "on_b is not at the end of B");
        verdict_.expect(Fault::points, length(on_b - on_a - normal * distance), rounding + 2e-7 * std::abs(distance),
                        "on_b is not across from on_a");

        verdict_.expect(Fault::certify, !!certify(view_a_, view_b_, found), "not of what was found");
        Closest<D> wrong = found;
        wrong.distance += static_cast<float>(8 * limit);
        verdict_.expect(Fault::certify, !certify(view_a_, view_b_, wrong), "of what was found and then moved");
    }

    void judge_contact(const Contact<D>& found) {
        if (known_.distance > known_.margin) verdict_.expect(Fault::contact_exists, !found, "a contact across a gap");
        if (known_.distance < -known_.margin)
            verdict_.expect(Fault::contact_exists, !!found, "no contact of what overlaps");
        if (found) judge_points(found, 0);
    }
    /// Contacts of separated shapes, with a margin that just covers the gap.
    void judge_near_miss() {
        if (known_.distance < 2 * known_.margin) return;
        const float margin = static_cast<float>(1.01 * (known_.distance + known_.margin));
        const Contact<D> found = contact(view_a_, view_b_, QueryOptions<D>{.margin = margin});
        verdict_.expect(Fault::contact_exists, !!found, "no contact within the requested margin");
        if (found) judge_points(found, static_cast<double>(margin));
    }
    void judge_points(const Contact<D>& found, double margin) {
        bool finite = std::isfinite(found.depth) && all_finite<D>(found.normal);
        for (const ContactPoint<D>& point : found.points)
            finite = finite && std::isfinite(point.depth) && all_finite<D>(point.position);
        verdict_.expect(Fault::not_finite, finite, "contact");
        if (!finite) return;
        const double depth = static_cast<double>(found.depth);
        judge_distance(Fault::contact_depth, -depth, "the depth is not minus the distance");
        judge_normal(Fault::contact_normal, DVec<D>(found.normal));
        const DVec<D> n = normalized(DVec<D>(found.normal));
        double deepest = -std::numeric_limits<double>::infinity();
        for (const ContactPoint<D>& point : found.points) {
            const double here = static_cast<double>(point.depth);
            deepest = std::max(deepest, here);
            const double limit = known_.margin + 2 * oracle::rounding_of<D>(point.position);
            verdict_.expect(Fault::contact_depth, -here, margin + known_.margin, "a point that doesn't touch");
            const DVec<D> middle(point.position);
            verdict_.expect(Fault::contact_points, a_.beyond(middle + n * (0.5 * here)), limit, "off A");
            verdict_.expect(Fault::contact_points, b_.beyond(middle - n * (0.5 * here)), limit, "off B");
        }
        if (margin > 0 || known_.distance < -known_.margin)
            judge_distance(Fault::contact_depth, -deepest, "the deepest point's is not minus the distance");
    }

    const View<D>&view_a_, &view_b_;
    const A& a_;
    const B& b_;
    const Known& known_;
    Verdict& verdict_;
};

}  // namespace abut::corpus
