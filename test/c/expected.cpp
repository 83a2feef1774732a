// The C++ side: the scene and its answers by the C++ API alone, without a handle of the C API.
#include "expected.h"

#include <abut/abut.hpp>
#include <abut/bake.hpp>

#include <cstring>
#include <deque>
#include <functional>
#include <list>
#include <memory>

namespace {

using namespace abut;

template <class To, class From>
To as(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
    return std::bit_cast<To>(from);
}
template <class To, class From, std::size_t N>
std::vector<To> list(const From (&from)[N]) {
    std::vector<To> result;
    for (const From& one : from) result.push_back(as<To>(one));
    return result;
}
template <int N, std::size_t Count>
std::vector<glm::vec<N, std::uint32_t>> faces(const std::uint32_t (&numbers)[Count]) {
    std::vector<glm::vec<N, std::uint32_t>> result(Count / N);
    std::memcpy(result.data(), numbers, sizeof(numbers));
    return result;
}

/// A shape at a pose, as `at(shape, pose)` of the typed shape is viewed, and the view of the shape alone.
template <int D>
struct Item {
    View<D> own;
    std::function<View<D>(const Pose<D>&)> at;
    std::optional<detail::Convex<D>> polytope;  // as `intersection` of the typed shape sees it
};

template <int D>
class Scene {
public:
    template <class S>
    void add(S shape) {
        const auto stored = std::make_shared<const S>(std::move(shape));
        Item<D> item{View<D>(view(*stored)),
                     [stored](const Pose<D>& pose) { return View<D>(view(abut::at(*stored, pose))); },
                     {}};
        if constexpr (std::is_same_v<S, Aabb<D>>)
            item.polytope = view(polytopes_.emplace_back(abut::polytope(*stored)));
        else if constexpr (PolytopeShape<S>)
            item.polytope = view(*stored);
        items_.push_back(std::move(item));
    }
    const Item<D>& operator[](int i) const { return items_[static_cast<std::size_t>(i)]; }
    View<D> at(int i, const Pose<D>& pose) const { return items_[static_cast<std::size_t>(i)].at(pose); }

private:
    std::deque<Item<D>> items_;
    std::list<PolytopeOf<D>> polytopes_;  // what views refer to stays where it is, also when the scene moves
};

template <int D>
const Scene<D>& scene();

template <>
const Scene<2>& scene() {
    static const Scene<2> result = [] {
        Scene<2> s;
        const auto box = as<Box2>(box2);
        const auto loop = list<Vec2>(loop_points);
        s.add(as<Circle>(ball2));
        s.add(as<Capsule2>(capsule2));
        s.add(box);
        s.add(as<Aabb2>(aabb2));
        s.add(as<Segment2>(segment2));
        s.add(as<Triangle2>(triangle2));
        s.add(as<HalfSpace2>(half_space2));
        s.add(*Polygon::build(list<Vec2>(polygon_points)));
        s.add(*Chain::build(list<Vec2>(chain_points), false));
        s.add(*TileMap::build(list<Tile>(tiles), 3, Vec2(0.5f, 0.5f)));
        s.add(*Compound2::build({box, as<Circle>(ball2)}));
        s.add(*SolidBsp2::build(loop, faces<2>(loop_faces)));
        s.add(*SolidBsp2::from_brushes(list<HalfSpace2>(brush_sides2), brush_ends2));
        s.add(at(Box2(box), as<Pose2>(tilted2)));
        s.add(rounded(Box2(box), 0.125f));
        s.add(stretched(Box2(box), as<Vec2>(scale2)));
        return s;
    }();
    return result;
}

template <>
const Scene<3>& scene() {
    static const Scene<3> result = [] {
        Scene<3> s;
        const auto box = as<Box3>(box3);
        const auto mesh = *Mesh::build(list<Vec3>(corners), faces<3>(cube));
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits |= std::uint64_t{voxels[i]} << i;
        s.add(as<Sphere>(ball3));
        s.add(as<Capsule3>(capsule3));
        s.add(box);
        s.add(as<Aabb3>(aabb3));
        s.add(as<Segment3>(segment3));
        s.add(as<Triangle3>(triangle3));
        s.add(as<HalfSpace3>(half_space3));
        s.add(as<Cylinder>(cylinder));
        s.add(as<Cone>(cone));
        s.add(*Polyhedron::build(list<Vec3>(corners)));
        s.add(mesh);
        s.add(solid(Mesh(mesh)));
        s.add(*HeightField::build(heights, 3, Vec2(0.75f, 0.5f), {.holes = holes}));
        s.add(*VoxelMap::build(std::span(&bits, 1), {2, 2, 2}, Vec3(0.5f, 0.5f, 0.5f)));
        s.add(*Compound3::build({box, as<Sphere>(ball3)}));
        s.add(*SolidBsp3::build(list<Vec3>(corners), faces<3>(cube)));
        s.add(*SolidBsp3::from_brushes(list<HalfSpace3>(brush_sides3), brush_ends3));
        s.add(at(Box3(box), as<Pose3>(tilted3)));
        s.add(rounded(Box3(box), 0.125f));
        s.add(stretched(Box3(box), as<Vec3>(scale3)));
        return s;
    }();
    return result;
}

abut_feature c_of(const Feature& f) {
    return {f.part, f.index, static_cast<std::uint32_t>(f.kind)};
}
abut_id c_of(Id id) {
    return as<abut_id>(id);
}

// The C structs of both dimensions have the same members.
template <class C, int D>
C closest_as(const Closest<D>& closest) {
    C result{};
    result.distance = closest.distance;
    std::memcpy(&result.normal, &closest.normal, sizeof(result.normal));
    std::memcpy(&result.on_a, &closest.on_a, sizeof(result.on_a));
    std::memcpy(&result.on_b, &closest.on_b, sizeof(result.on_b));
    result.feature_a = c_of(closest.feature_a);
    result.feature_b = c_of(closest.feature_b);
    return result;
}
template <class C, int D>
C contact_as(const Contact<D>& contact) {
    C result{};
    if (!contact) return result;
    std::memcpy(&result.normal, &contact.normal, sizeof(result.normal));
    result.depth = contact.depth;
    for (const auto& point : contact.points) {
        auto& place = result.points[result.count++];
        std::memcpy(&place.position, &point.position, sizeof(place.position));
        place.depth = point.depth;
        place.feature = point.feature;
    }
    result.feature_a = c_of(contact.feature_a);
    result.feature_b = c_of(contact.feature_b);
    return result;
}
template <class C, int D>
C hit_as(const std::optional<Hit<D>>& hit) {
    C result{};
    if (!hit) return result;
    result.found = 1;
    result.fraction = hit->fraction;
    result.distance = hit->distance;
    std::memcpy(&result.point, &hit->point, sizeof(result.point));
    std::memcpy(&result.normal, &hit->normal, sizeof(result.normal));
    result.started_inside = hit->started_inside ? 1 : 0;
    result.feature = c_of(hit->feature);
    return result;
}

/// The hit of a level that is no view has its own definition.
template <int D>
std::optional<Hit<D>> raycast_of(int a, const Ray<D>& ray) {
    if constexpr (D == 2) {
        if (a == 11) return raycast(ray, *SolidBsp2::build(list<Vec2>(loop_points), faces<2>(loop_faces)));
        if (a == 12) return raycast(ray, *SolidBsp2::from_brushes(list<HalfSpace2>(brush_sides2), brush_ends2));
    } else {
        if (a == 15) return raycast(ray, *SolidBsp3::build(list<Vec3>(corners), faces<3>(cube)));
        if (a == 16) return raycast(ray, *SolidBsp3::from_brushes(list<HalfSpace3>(brush_sides3), brush_ends3));
    }
    return raycast(ray, scene<D>()[a].own);
}

template <class C, class Points>
std::uint32_t write(const Points& points, C* out, std::uint32_t capacity) {
    std::uint32_t count = 0;
    for (const auto& point : points)
        if (count < capacity) out[count++] = as<C>(point);
    return count;
}

Field<2> field(Vec2) {
    const auto loop = list<Vec2>(loop_points);
    return *bake_field(loop, {}, {.cell = 0.125f});
}
Field<3> field(Vec3) {
    return *bake_field(*Mesh::build(list<Vec3>(corners), faces<3>(cube)), {.cell = 0.25f});
}

WalkMesh walk_mesh() {
    return *WalkMesh::build(list<Vec3>(corners), faces<3>(cube));
}

}  // namespace

#define DEFINE(D)                                                                                                      \
    bool expected_overlaps##D(int a, int b, abut_pose##D pose) {                                                       \
        return overlaps(scene<D>()[a].own, scene<D>().at(b, as<Pose<D>>(pose)));                                       \
    }                                                                                                                  \
    abut_closest##D expected_closest##D(int a, int b, abut_pose##D pose) {                                             \
        return closest_as<abut_closest##D>(closest(scene<D>()[a].own, scene<D>().at(b, as<Pose<D>>(pose))));           \
    }                                                                                                                  \
    abut_closest##D expected_closest_to_point##D(int a, abut_vec##D point) {                                           \
        return closest_as<abut_closest##D>(closest(scene<D>()[a].own, as<Vec<D>>(point)));                             \
    }                                                                                                                  \
    abut_contact##D expected_contact##D(int a, int b, abut_pose##D pose, float margin) {                               \
        return contact_as<abut_contact##D>(                                                                            \
            contact(scene<D>()[a].own, scene<D>().at(b, as<Pose<D>>(pose)), {.margin = margin}));                      \
    }                                                                                                                  \
    uint32_t expected_each_contact##D(int a, int b, abut_pose##D pose, abut_contact##D* out, uint32_t capacity) {      \
        uint32_t count = 0;                                                                                            \
        each_contact(scene<D>()[a].own, scene<D>().at(b, as<Pose<D>>(pose)), [&](const Contact<D>& contact) {          \
            if (count < capacity) out[count] = contact_as<abut_contact##D>(contact);                                   \
            ++count;                                                                                                   \
        });                                                                                                            \
        return count;                                                                                                  \
    }                                                                                                                  \
    abut_hit##D expected_sweep##D(int a, abut_vec##D motion_a, int b, abut_vec##D motion_b, abut_pose##D pose) {       \
        return hit_as<abut_hit##D>(sweep(scene<D>()[a].own, as<Vec<D>>(motion_a), scene<D>().at(b, as<Pose<D>>(pose)), \
                                         as<Vec<D>>(motion_b)));                                                       \
    }                                                                                                                  \
    abut_hit##D expected_sweep_motion##D(int a, abut_motion##D motion_a, int b, abut_motion##D motion_b) {             \
        return hit_as<abut_hit##D>(                                                                                    \
            sweep(scene<D>()[a].own, as<Motion<D>>(motion_a), scene<D>()[b].own, as<Motion<D>>(motion_b)));            \
    }                                                                                                                  \
    abut_hit##D expected_raycast##D(int a, abut_ray##D ray) {                                                          \
        return hit_as<abut_hit##D>(raycast_of<D>(a, as<Ray<D>>(ray)));                                                 \
    }                                                                                                                  \
    uint32_t expected_raycast_all##D(int a, abut_ray##D ray, abut_hit##D* out, uint32_t capacity) {                    \
        std::vector<Hit<D>> hits;                                                                                      \
        raycast_all(as<Ray<D>>(ray), scene<D>()[a].own, hits);                                                         \
        for (uint32_t i = 0; i < std::min<std::size_t>(capacity, hits.size()); ++i)                                    \
            out[i] = hit_as<abut_hit##D>(std::optional(hits[i]));                                                      \
        return static_cast<uint32_t>(hits.size());                                                                     \
    }                                                                                                                  \
    bool expected_contains##D(int a, abut_vec##D point) {                                                              \
        return contains(scene<D>()[a].own, as<Vec<D>>(point));                                                         \
    }                                                                                                                  \
    double expected_certificate##D(int a, int b, abut_pose##D pose, bool* holds) {                                     \
        const View<D> placed = scene<D>().at(b, as<Pose<D>>(pose));                                                    \
        const auto found = certify(scene<D>()[a].own, placed, closest(scene<D>()[a].own, placed));                     \
        *holds = found.holds;                                                                                          \
        return found.plane;                                                                                            \
    }                                                                                                                  \
    abut_aabb##D expected_bounds##D(int a) {                                                                           \
        return as<abut_aabb##D>(bounds(scene<D>()[a].own));                                                            \
    }                                                                                                                  \
    bool is_polytope##D(int a) {                                                                                       \
        return scene<D>()[a].polytope.has_value();                                                                     \
    }                                                                                                                  \
    bool expected_intersection##D(int a, int b, abut_vec##D* out, uint32_t capacity, uint32_t* count) {                \
        const auto found = intersection(*scene<D>()[a].polytope, *scene<D>()[b].polytope);                             \
        *count = found ? write(found->points(), out, capacity) : 0;                                                    \
        return found.has_value();                                                                                      \
    }                                                                                                                  \
    uint32_t expected_minkowski##D(int a, int b, bool difference, abut_vec##D* out, uint32_t capacity) {               \
        const auto& x = *scene<D>()[a].polytope;                                                                       \
        const auto& y = *scene<D>()[b].polytope;                                                                       \
        return write((difference ? minkowski_difference(x, y) : minkowski_sum(x, y)).points(), out, capacity);         \
    }                                                                                                                  \
    void expected_world##D(const abut_pose##D* poses, abut_ray##D ray, abut_vec##D point, abut_id_pair* began,         \
                           uint32_t capacity, uint32_t* began_count, uint32_t* contact_count,                          \
                           abut_world_contact##D* first, abut_world_hit##D* hit, abut_world_closest##D* closest) {     \
        World<D> world;                                                                                                \
        for (int i = 0; i < pose_count; ++i)                                                                           \
            world.add(Unowned<D>{scene<D>()[i % 3].own}, {.pose = as<Pose<D>>(poses[i])});                             \
        const Events events = world.update();                                                                          \
        *began_count = write(events.began, began, capacity);                                                           \
        *contact_count = static_cast<uint32_t>(world.contacts().size());                                               \
        const auto& one = world.contacts()[0];                                                                         \
        *first = {c_of(one.a), c_of(one.b), contact_as<abut_contact##D>(one.contact)};                                 \
        const auto found = world.raycast(as<Ray<D>>(ray));                                                             \
        *hit = {c_of(found->id), hit_as<abut_hit##D>(std::optional(found->hit))};                                      \
        const auto nearest = world.closest(as<Vec<D>>(point));                                                         \
        *closest = {c_of(nearest->id), closest_as<abut_closest##D>(nearest->closest)};                                 \
    }                                                                                                                  \
    void expected_field##D(abut_vec##D point, abut_vec##D light, abut_field_sample##D* sample, abut_vec##D* closest,   \
                           float* shadow) {                                                                            \
        const Field<D> own = field(as<Vec<D>>(point));                                                                 \
        const auto found = own.sample(as<Vec<D>>(point));                                                              \
        *sample = {found.distance, as<abut_vec##D>(found.normal)};                                                     \
        *closest = as<abut_vec##D>(own.closest(as<Vec<D>>(point)));                                                    \
        *shadow = own.shadow(as<Vec<D>>(point), as<Vec<D>>(light), 0.1f);                                              \
    }
DEFINE(2)
DEFINE(3)

void expected_walk(abut_vec3 point, abut_vec3 step, abut_walked* walked) {
    const WalkMesh mesh = walk_mesh();
    const Walked found = mesh.walk(mesh.nearest(as<Vec3>(point)), as<Vec3>(step));
    *walked = {{found.place.triangle, as<abut_vec3>(found.place.weights)},
               as<abut_vec3>(mesh.to_world(found.place)),
               found.length,
               found.lost,
               static_cast<uint32_t>(found.met),
               {found.side.triangle, found.side.side},
               as<abut_quat>(found.turn.in_space()),
               found.turn.mirrored() ? 1u : 0u,
               found.crossings};
}

uint32_t expected_path(abut_vec3 from, abut_vec3 to, abut_vec3* out, uint32_t capacity, double* length) {
    const WalkMesh mesh = walk_mesh();
    const auto path = mesh.find_path(mesh.nearest(as<Vec3>(from)), mesh.nearest(as<Vec3>(to)));
    *length = path->length;
    return write(path->points, out, capacity);
}

uint32_t expected_parts(void) {
    return static_cast<uint32_t>(decompose(*Mesh::build(list<Vec3>(corners), faces<3>(cube)))->size());
}
