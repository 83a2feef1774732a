#include <abut/convex/ray_forms.hpp>
#include <abut/query/raycast_triangles.hpp>

namespace abut {
namespace {

/// The composite where it was made: its own frame is the world.
bool is_unplaced(const Composite<3>& composite) {
    return composite.place.column == Affine<3>::identity() && composite.place.offset == DVec<3>(0.0);
}

/// The beam as a point on its way in the shape's own frame.
MovingBox<3> seen_by(const Composite<3>& composite, const Beam<3>& beam, double volume) {
    const DVec<3> extent = DVec<3>(composite.bounds.max) - DVec<3>(composite.bounds.min);
    const Affine<3> back = inverse(composite.place, volume);
    MovingBox<3> point;
    point.center = back.point(beam.origin);
    point.direction = back.vector(beam.direction);
    point.length = beam.length;
    // Placed and seen again, a corner is where it was but for a few roundings of all numbers involved.
    double astray = 1e-13 * (largest(point.center) + largest(extent));
    // A search takes for hit what is a little beside a triangle, in its size as it is placed. What is stretched may be
    // large along another axis than the one on which it is beside.
    if (!composite.similar) {
        double squares = 0;
        for (std::size_t i = 0; i < 3; ++i)
            squares += length_squared(back.column[i]) * length_squared(composite.place.column[i]);
        astray += 2e-7 * std::sqrt(squares) * largest(extent);
    }
    point.half = DVec<3>(astray);
    return point;
}

/// Where the beam's origin sees the corners: of a shape that is placed, and of one that isn't.
struct SeenPlaced {
    Affine<3> place;

    DVec<3> operator()(const Vec3& corner) const { return place.point(DVec<3>(corner)); }
};
struct SeenAsTheyAre {
    DVec<3> origin;

    DVec<3> operator()(const Vec3& corner) const { return DVec<3>(corner) - origin; }
};

/// `rest` is what is left of the beam.
template <class Seen>
bool triangle_hit(const Beam<3>& rest, const Seen& seen, const Triangle3& triangle, const Composite<3>& composite,
                  const QueryOptions<3>& options, PartHit<3>& hit) {
    const DVec<3> a = seen(triangle.a), b = seen(triangle.b), c = seen(triangle.c);
    if (!options.back_faces) {
        const double mirrored = determinant(composite.place) < 0 ? -1 : 1;
        if (!(dot(cross(b - a, c - a), rest.direction) * mirrored < 0)) return false;
    }
    const RayEntry<3> entry = enter_triangle(rest, a, b, c);
    if (entry.answer == RayAnswer::misses) return false;
    if (entry.answer == RayAnswer::undecided)
        return part_hit_by_advance(rest, placed(convex(triangle), composite), 0, options.trace, hit);
    hit.along = entry.along;
    hit.normal = entry.normal;
    hit.started_inside = false;
    hit.feature = {0, entry.index, entry.kind};
    return true;
}

/// Calls visit(hit, part) for the triangles that the beam meets. It returns the new reach; the hit's feature lacks the
/// part, which is far away in memory and seldom needed.
template <class Seen, class Visit>
bool visit_hits(const Beam<3>& beam, const Seen& seen, const MovingBox<3>& point, const Composite<3>& composite,
                const QueryOptions<3>& options, Visit& visit) {
    Beam<3> rest = beam;
    PartHit<3> hit;
    const auto decide = [&](const Triangle3& triangle, const std::uint32_t& part) -> float {
        if (triangle_hit(rest, seen, triangle, composite, options, hit)) rest.length = visit(hit, part);
        return static_cast<float>(rest.length);
    };
    return composite.each_triangle_on_line(composite.object, point, decide);
}

template <class Visit>
bool visit_hits(const Beam<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options, Visit visit) {
    const bool thin = composite.radius == 0 && composite.inner_radius == 0;
    if (composite.each_triangle_on_line == nullptr || !thin) return false;
    if (is_unplaced(composite)) {
        const MovingBox<3> point{beam.origin, DVec<3>(0.0), beam.direction, beam.length};
        return visit_hits(beam, SeenAsTheyAre{beam.origin}, point, composite, options, visit);
    }
    const double volume = determinant(composite.place);
    if (volume == 0) return false;
    SeenPlaced seen{composite.place};
    seen.place.offset -= beam.origin;
    return visit_hits(beam, seen, seen_by(composite, beam, volume), composite, options, visit);
}

}  // namespace

bool first_triangle_hit(const Beam<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                        PartHit<3>& first, bool& found) {
    const std::uint32_t* first_part = nullptr;
    const auto keep_first = [&](const PartHit<3>& hit, const std::uint32_t& part) {
        if (first_part == nullptr || hit.along < first.along || part < *first_part) {
            first = hit;
            first_part = &part;
            __builtin_prefetch(first_part);
        }
        return first.along;
    };
    if (!visit_hits(beam, composite, options, keep_first)) return false;
    found = first_part != nullptr;
    if (found) first.feature.part = *first_part;
    return true;
}

bool each_triangle_hit(const Beam<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                       HitVisitor visit) {
    return visit_hits(beam, composite, options, [&](const PartHit<3>& hit, const std::uint32_t& part) {
        PartHit<3> named = hit;
        named.feature.part = part;
        return visit(named);
    });
}

}  // namespace abut
