#pragma once

// Other libraries, and the 3D shapes that all of them have: balls, capsules, boxes and hulls.

#include "../oracle/sample.hpp"

#include <optional>
#include <string>
#include <vector>

namespace abut::differential {

using detail::DVec;

enum class Form { ball, capsule, box, hull };

/// A shape about a center whose coordinates are floats. The rest is relative to it, in double.
struct PeerShape {
    Form form = Form::hull;
    DVec<3> center{0.0};
    std::vector<DVec<3>> points;  ///< ball: its center; capsule: its ends; box and hull: corners
    double radius = 0;            ///< of a ball or capsule
    DVec<3> half{0.0};            ///< of a box, along `axes`
    std::array<DVec<3>, 3> axes = detail::Affine<3>::identity();
    std::vector<std::vector<int>> faces;  ///< of a hull: loops of points, counter-clockwise from outside
    double size = 0;

    /// The offset of a ball's or box's exact center from `center`.
    DVec<3> middle() const { return (points.front() + points.back()) * 0.5; }
};

struct PeerAnswer {
    enum class State : int { none, answered, refused };
    State state = State::none;
    bool overlap = false;
    bool knows_distance = true;  ///< some peers return only the depth, or only overlap
    double distance = 0;         ///< the gap, or minus the depth
    DVec<3> normal{0.0};         ///< from A to B, of length 1; zero if the peer returns none for a gap
};

/// The shape for the peers; none if some peer doesn't have its kind.
std::optional<PeerShape> peer_shape(const oracle::Sample<3>& sample);

/// Queries a peer about two shapes; `smaller` is the size of the smaller one, for peers with a tolerance.
using Peer = PeerAnswer (*)(const PeerShape& a, const PeerShape& b, double smaller);

PeerAnswer query_bullet(const PeerShape& a, const PeerShape& b, double smaller);
PeerAnswer query_fcl_libccd(const PeerShape& a, const PeerShape& b, double smaller);
PeerAnswer query_fcl_indep(const PeerShape& a, const PeerShape& b, double smaller);
PeerAnswer query_ccd_epa(const PeerShape& a, const PeerShape& b, double smaller);
PeerAnswer query_ccd_mpr(const PeerShape& a, const PeerShape& b, double smaller);

}  // namespace abut::differential
