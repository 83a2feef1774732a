#pragma once

// Reads levels of Neverball, files `.sol` of version 8: convex brushes in 3D, some of which move along paths. Purely
// visual data is skipped.

#include "little_endian.hpp"
#include <abut/math/vec.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/world/world.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <glm/ext/vector_uint2.hpp>

namespace abut::scenes {

/// A half-space of a brush: dot(normal, p) <= offset.
struct NeverballHalfSpace {
    Vec3 normal{};
    float offset = 0;
};

/// A convex brush, with y up. Lists of a brush and of a body are indices into lists of the level.
struct NeverballBrush {
    std::vector<std::uint32_t> points, edges, sides;
    bool detail = false;  ///< visual only: nothing collides with it
};

/// A stop of a path, and the segment to the next one.
struct NeverballStop {
    Vec3 position{};
    float seconds = 0;
    std::uint32_t next = 0;
    bool moves = false;
};

struct NeverballBody {
    std::uint32_t first_brush = 0, brushes = 0;
    std::optional<std::uint32_t> stop;  ///< initial stop; brushes are relative to it
};

struct NeverballBall {
    Vec3 position{};
    float radius = 0;
};

struct NeverballLevel {
    std::vector<Vec3> points;
    std::vector<glm::uvec2> edges;
    std::vector<NeverballHalfSpace> sides;
    std::vector<NeverballBrush> brushes;
    std::vector<NeverballStop> stops;
    std::vector<NeverballBody> bodies;
    std::vector<NeverballBall> goals, balls;  ///< goals are circles on the ground; balls are start positions
};

namespace detail {

/// Reads the file front to back; after the first error all reads fail.
class NeverballReader {
public:
    NeverballReader(std::string name, std::vector<char> bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

    Result<NeverballLevel> read() {
        constexpr std::int32_t magic = 0xaf | 'S' << 8 | 'O' << 16 | 'L' << 24, version = 8;
        if (!bytes_.holds(0, 8) || integer() != magic)
            return Problem{ProblemCode::bad_format, name_ + ": not a level of Neverball"};
        if (integer() != version)
            return Problem{ProblemCode::bad_format, name_ + ": a level of Neverball, but not of version 8", 4};
        read_all();
        if (problem_) return *problem_;
        return level_;
    }

private:
    // Counts are in the file's order, which differs from the order of the data.
    enum Kind {
        text,
        words,
        materials,
        points,
        edges,
        sides,
        places_on_pictures,
        corners,
        triangles,
        brushes,
        nodes,
        stops,
        bodies,
        items,
        goals,
        jumps,
        switches,
        billboards,
        balls,
        views,
        indices,
        kinds
    };

    void read_all() {
        for (std::size_t& count : count_) {
            const std::int32_t number = integer();
            if (number < 0) return fail(ProblemCode::bad_format, "a count is below zero");
            count = static_cast<std::size_t>(number);
        }
        skip(count_[text] + 8 * count_[words]);
        for (std::size_t i = 0; i < count_[materials] && !problem_; ++i) {
            constexpr std::uint32_t has_alpha_test = 1 << 9;
            skip(17 * 4);
            const std::uint32_t flags = bits();
            skip(64 + (flags & has_alpha_test ? 8 : 0));
        }
        each(level_.points, points, 12, [&](Vec3& point) { point = position(); });
        each(level_.edges, edges, 8, [&](glm::uvec2& edge) {
            edge.x = index(points);
            edge.y = index(points);
        });
        each(level_.sides, sides, 16, [&](NeverballHalfSpace& side) {
            side.normal = position();
            side.offset = number();
        });
        skip(8 * count_[places_on_pictures] + 12 * count_[corners] + 16 * count_[triangles]);
        each(lists_, brushes, 36, [&](Lists& lists) {
            lists.flags = bits();
            for (Range* range : {&lists.points, &lists.edges, &lists.triangles, &lists.sides}) *range = this->range();
        });
        skip(20 * count_[nodes]);
        each(level_.stops, stops, 32, [&](NeverballStop& stop) { read_stop(stop); });
        each(level_.bodies, bodies, 28, [&](NeverballBody& body) { read_body(body); });
        skip(20 * count_[items]);
        each(level_.goals, goals, 16, [&](NeverballBall& goal) { goal = ball(); });
        skip(28 * count_[jumps] + 40 * count_[switches] + 88 * count_[billboards]);
        each(level_.balls, balls, 16, [&](NeverballBall& start) { start = ball(); });
        skip(24 * count_[views]);
        const std::size_t table = at_;
        skip(4 * count_[indices]);
        if (problem_) return;
        for (const Lists& lists : lists_) {
            NeverballBrush brush;
            brush.detail = (lists.flags & 1) != 0;
            take(lists.points, table, points, brush.points);
            take(lists.edges, table, edges, brush.edges);
            take(lists.sides, table, sides, brush.sides);
            level_.brushes.push_back(std::move(brush));
        }
    }

    void read_stop(NeverballStop& stop) {
        constexpr std::uint32_t turned = 1, moved_itself = 2;
        stop.position = position();
        stop.seconds = number();
        stop.next = index(stops);
        stop.moves = integer() != 0;
        skip(4);
        const std::uint32_t flags = bits();
        skip((flags & turned ? 16 : 0) + (flags & moved_itself ? 8 : 0));
    }
    void read_body(NeverballBody& body) {
        const std::int32_t stop = integer();
        if (stop >= 0) body.stop = within(stop, stops);
        skip(8);
        const Range range = this->range();
        body.first_brush = static_cast<std::uint32_t>(range.first);
        body.brushes = static_cast<std::uint32_t>(range.count);
        if (range.first + range.count > count_[brushes])
            fail(ProblemCode::index_out_of_range, "a body has no such brush");
        skip(8);
    }

    struct Range {
        std::size_t first = 0, count = 0;
    };
    struct Lists {
        std::uint32_t flags = 0;
        Range points, edges, triangles, sides;
    };

    /// A list of records of at least this many bytes each.
    template <class T, class Read>
    void each(std::vector<T>& list, Kind kind, std::size_t size, Read read) {
        if (!has(size * count_[kind])) return;
        list.resize(count_[kind]);
        for (T& item : list) {
            read(item);
            if (problem_) return;
        }
    }
    /// The values of a range of the index table.
    void take(const Range& range, std::size_t table, Kind kind, std::vector<std::uint32_t>& result) {
        if (problem_) return;
        at_ = table;
        if (range.first + range.count > count_[indices])
            return fail(ProblemCode::index_out_of_range, "a brush has no such part");
        at_ = table + 4 * range.first;
        for (std::size_t i = 0; i < range.count && !problem_; ++i) result.push_back(index(kind));
    }

    bool has(std::size_t count) {
        if (!problem_ && !bytes_.holds(at_, count)) fail(ProblemCode::bad_format, "ends too early");
        return !problem_;
    }
    void skip(std::size_t count) {
        if (has(count)) at_ += count;
    }
    std::uint32_t bits() {
        if (!has(4)) return 0;
        at_ += 4;
        return bytes_.u32(at_ - 4);
    }
    std::int32_t integer() { return static_cast<std::int32_t>(bits()); }
    float number() {
        const float result = std::bit_cast<float>(bits());
        if (std::isfinite(result)) return result;
        fail(ProblemCode::not_finite, "a number isn't finite");
        return 0;
    }
    Vec3 position() {
        Vec3 result;
        for (int i = 0; i < 3; ++i) result[i] = number();
        return result;
    }
    NeverballBall ball() {
        const Vec3 center = position();
        return {center, number()};
    }
    std::uint32_t within(std::int32_t number, Kind kind) {
        if (number >= 0 && static_cast<std::size_t>(number) < count_[kind]) return static_cast<std::uint32_t>(number);
        fail(ProblemCode::index_out_of_range, "an index names nothing");
        return 0;
    }
    std::uint32_t index(Kind kind) { return within(integer(), kind); }
    Range range() {
        const std::int32_t first = integer(), count = integer();
        if (first >= 0 && count >= 0) return {static_cast<std::size_t>(first), static_cast<std::size_t>(count)};
        fail(ProblemCode::index_out_of_range, "a range begins below zero");
        return {};
    }
    void fail(ProblemCode code, const std::string& what) {
        if (!problem_) problem_ = Problem{code, name_ + ": " + what + ", at byte " + std::to_string(at_), at_};
    }

    std::string name_;
    LittleEndian bytes_;
    std::size_t at_ = 0;
    std::array<std::size_t, kinds> count_{};
    std::vector<Lists> lists_;
    NeverballLevel level_;
    std::optional<Problem> problem_;
};

}  // namespace detail

/// Parses a level. A Problem describes invalid data, with the byte offset as index.
inline Result<NeverballLevel> neverball_level(const std::string& name, std::vector<char> bytes) {
    return detail::NeverballReader(name, std::move(bytes)).read();
}
inline Result<NeverballLevel> read_neverball(const std::string& path) {
    Result<std::vector<char>> bytes = read_bytes(path);
    if (!bytes) return bytes.problem();
    return neverball_level(path, *std::move(bytes));
}

/// The hull of the brush's vertices, if the file has them.
inline Result<Polyhedron> polyhedron(const NeverballLevel& level, const NeverballBrush& brush) {
    std::vector<Vec3> points;
    for (const std::uint32_t i : brush.points) points.push_back(level.points[i]);
    return Polyhedron::build(points);
}

/// Calls visit(body, brush, polyhedron) for all colliding brushes, relative to their body.
template <class Visit>
void each_solid(const NeverballLevel& level, Visit&& visit) {
    for (const NeverballBody& body : level.bodies)
        for (std::uint32_t i = 0; i < body.brushes; ++i) {
            const NeverballBrush& brush = level.brushes[body.first_brush + i];
            if (brush.detail) continue;
            if (const Result<Polyhedron> shape = polyhedron(level, brush)) visit(body, brush, *shape);
        }
}
inline Vec3 start_of(const NeverballLevel& level, const NeverballBody& body) {
    return body.stop ? level.stops[*body.stop].position : Vec3(0.0f);
}

/// All colliding brushes in their initial positions; a Problem if there is none.
inline Result<Compound3> compound(const NeverballLevel& level) {
    std::vector<AnyShape<3>> children;
    each_solid(level, [&](const NeverballBody& body, const NeverballBrush&, const Polyhedron& shape) {
        children.push_back(at(shape, Pose3{start_of(level, body)}));
    });
    return Compound3::build(children);
}

/// Adds all colliding brushes to a world, one item each; static ones are fixed. Items of body i have `user` i.
inline void add_to(World3& world, const NeverballLevel& level) {
    each_solid(level, [&](const NeverballBody& body, const NeverballBrush&, const Polyhedron& shape) {
        world.add(shape, {.pose = {start_of(level, body)},
                          .user = static_cast<std::uint64_t>(&body - level.bodies.data()),
                          .fixed = !body.stop});
    });
}

}  // namespace abut::scenes
