#pragma once

// The contact manifold of two shapes on one plane of their surfaces, joined from the contact areas of all their parts
// there. For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/detail/surface/surface_normal_flags.hpp>

namespace abut::detail {

/// The contact of a pair of parts.
template <int D>
struct PairDistance {
    SignedDistance<D> distance;
    std::uint32_t index_a = 0, index_b = 0;  ///< of the parts
};

/// Compares contacts by themselves, not by their parts nor by which shape is first: the deepest is the least. Returns a
/// number below, equal to or above 0.
template <int D>
int compare(const SignedDistance<D>& a, const SignedDistance<D>& b);
template <int D>
int compare(const DVec<D>& a, const DVec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// The plane of a contact.
template <int D>
struct ContactPlane {
    DVec<D> normal, on_a, on_b;
    double depth = 0;
    double step = 0;  ///< planes within this height of each other are one, and so are faces

    ContactPlane() = default;
    ContactPlane(const SignedDistance<D>& distance, double max_step)
        : normal(distance.normal),
          on_a(distance.on_a),
          on_b(distance.on_b()),
          depth(-distance.distance),
          step(max_step) {}

    /// Whether another contact is on the same plane, of A or of B.
    bool has(const SignedDistance<D>& distance) const;
    /// Whether two points on the surfaces of A and B, one above the other, are on the plane of A or of B.
    bool has(const DVec<D>& point_a, const DVec<D>& point_b) const;
};

/// The normal from A to B of the face that a part has on a plane that replaces the normal of the parts' contact; none
/// if it has no face there. The part is B's, if B's surface doesn't have that normal, or A's. Rounding tilts the plane
/// between two parts, but not their faces.
template <int D>
std::optional<DVec<D>> face_normal(const Part<D>& part_a, const Part<D>& part_b, const SurfaceNormalFlags& flags,
                                   const ContactPlane<D>& plane);

/// The normals of all faces of a part, if it is a triangle or a box. Other parts may have any.
template <int D>
class FaceNormals {
public:
    explicit FaceNormals(const Part<D>& part);

    /// Whether the part may have a face along a direction of length 1, or none at all because it is thin.
    bool may_face(const DVec<D>& direction) const;

private:
    std::array<DVec<D>, D> normals_;  ///< of any length
    std::size_t count_ = 0;           ///< 0: of any direction
};

/// Of any number of points, those that are extreme along fixed directions, and the deepest: the corners of their area,
/// or in 3D points that span all but 2 % of it. The order in which they are added has no influence.
template <int D>
class ExtremePoints {
public:
    void clear() { count_ = 0; }
    void add(const ManifoldPoint<D>& point, const DVec<D>& normal);
    /// The points, without those that others are equal to within `tolerance`.
    ManifoldCandidates<D> distinct(double tolerance) const;
    /// Whether two of the points are farther apart than a length.
    bool extend_beyond(double length) const;

private:
    static constexpr std::size_t directions = D == 2 ? 2 : 16;

    std::array<ManifoldPoint<D>, directions> extreme_;
    std::array<double, directions> along_;
    ManifoldPoint<D> deepest_;
    std::size_t count_ = 0;  // of all points that were added
};

/// After what the points of a manifold are named: the corners and sides of the smaller shape and of the parts of the
/// level, which is A or B, or those of two shapes of one part each.
enum class ManifoldNames : std::uint8_t { level_is_a, level_is_b, single_parts };

/// The manifold of two shapes on one plane.
template <int D>
class SurfaceManifold {
public:
    /// `first` is the deepest contact on the plane. Features are named after the corners of the smaller shape, as far
    /// as it has some, so that they survive while it moves over the parts of the larger one, the level.
    void begin(const PairDistance<D>& first, double step, ManifoldNames names, double margin);

    const ContactPlane<D>& plane() const { return plane_; }

    /// Adds a pair whose contact is on the plane: the corners of its contact area, and its deepest point.
    void add(const Part<D>& part_a, const Part<D>& part_b, const PairDistance<D>& pair);
    /// The corners of the contact area on the plane of any pair; there are none if its faces are elsewhere.
    ManifoldCandidates<D> area(const Part<D>& part_a, const Part<D>& part_b, std::uint32_t index_a,
                               std::uint32_t index_b) const;
    void add(const ManifoldCandidates<D>& points);
    /// Adds the deepest point of a contact.
    void add_deepest(const PairDistance<D>& pair);

    /// Whether the points are farther apart than a sliver, whose support matters to nothing.
    bool has_extent() const;
    /// Writes the normal, the depth of the deepest point, and the points; the features are left as they are.
    void write(Contact<D>& contact) const;

private:
    void add_points_of_mixed(const Part<D>& part_a, const Part<D>& part_b, const PairDistance<D>& pair);

    ContactPlane<D> plane_;
    double margin_ = 0, tolerance_ = 0;
    ManifoldNames names_{};
    ExtremePoints<D> points_;
};

extern template class FaceNormals<2>;
extern template class FaceNormals<3>;
extern template class SurfaceManifold<2>;
extern template class SurfaceManifold<3>;

}  // namespace abut::detail
