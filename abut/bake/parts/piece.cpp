#include <abut/bake/parts/piece.hpp>
#include <abut/bake/solid.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace abut::detail {
namespace {

/// One side of a cut. Points have the numbers of the piece that is cut.
struct Side {
    std::vector<glm::uvec3> triangles;
    std::vector<CapEdge> cap_edges;
    /// edges of the new cap; some occur in both directions
    std::vector<std::pair<std::uint32_t, std::uint32_t>> cap_outline;
};

class Cutter {
public:
    Cutter(const Piece& piece, const CutPlane& plane, double tolerance) : piece_(piece), points_(piece.points) {
        heights_.reserve(points_.size());
        for (const DVec<3>& p : points_) {
            const double height = dot(plane.normal, p) - plane.offset;
            heights_.push_back(std::abs(height) <= tolerance ? 0 : height);
        }
        for (const glm::uvec3& triangle : piece.triangles) cut_triangle(triangle, plane);
        if (piece.closed) cut_caps(plane);
    }

    Piece side(int which, const CutPlane& plane) {
        Side& from = sides_[static_cast<std::size_t>(which)];
        Piece result;
        result.points = points_;
        result.triangles = std::move(from.triangles);
        result.closed = piece_.closed;
        result.thickness = piece_.thickness;
        if (!piece_.closed) return result;
        result.cap_edges = std::move(from.cap_edges);
        result.cap_origins = piece_.cap_origins;
        result.cap_normals = piece_.cap_normals;
        const auto cap = static_cast<std::uint32_t>(result.cap_origins.size());
        for (const auto& [a, b] : without_opposite_pairs(from.cap_outline)) result.cap_edges.push_back({a, b, cap});
        if (!from.cap_outline.empty()) {
            result.cap_origins.push_back(points_[from.cap_outline.front().first]);
            result.cap_normals.push_back(which == 0 ? plane.normal : -plane.normal);
        }
        return result;
    }

private:
    using Outline = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

    static Outline without_opposite_pairs(Outline cap_outline) {
        const auto key = [](const std::pair<std::uint32_t, std::uint32_t>& edge) {
            const auto [low, high] = std::minmax(edge.first, edge.second);
            return std::tuple(low, high, edge.first);
        };
        std::sort(cap_outline.begin(), cap_outline.end(),
                  [&](const auto& a, const auto& b) { return key(a) < key(b); });
        Outline result;
        for (const auto& edge : cap_outline) {
            if (!result.empty() && result.back() == std::pair(edge.second, edge.first))
                result.pop_back();
            else
                result.push_back(edge);
        }
        return result;
    }

    /// The intersection of the plane and an edge. It is the same point for both directions of the edge.
    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [found, is_new] = cuts_.try_emplace({a, b}, static_cast<std::uint32_t>(points_.size()));
        if (is_new) {
            const double fraction = heights_[a] / (heights_[a] - heights_[b]);
            points_.push_back(points_[a] + (points_[b] - points_[a]) * fraction);
        }
        return found->second;
    }

    void cut_triangle(const glm::uvec3& triangle, const CutPlane& plane) {
        int below = 0, above = 0;
        for (int i = 0; i < 3; ++i) {
            below += heights_[triangle[i]] < 0;
            above += heights_[triangle[i]] > 0;
        }
        if (below == 0 && above == 0) {
            const DVec<3>&a = points_[triangle.x], &b = points_[triangle.y], &c = points_[triangle.z];
            const bool up = dot(cross(b - a, c - a), plane.normal) > 0;
            Side& side = sides_[!piece_.closed ? 2 : up ? 0 : 1];
            side.triangles.push_back(triangle);
            for (int i = 0; i < 3; ++i) side.cap_outline.emplace_back(triangle[(i + 1) % 3], triangle[i]);
        } else if (below == 0 || above == 0) {
            Side& side = sides_[below > 0 ? 0 : 1];
            side.triangles.push_back(triangle);
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
                if (heights_[from] == 0 && heights_[to] == 0) side.cap_outline.emplace_back(to, from);
            }
        } else {
            split(triangle);
        }
    }

    void split(const glm::uvec3& triangle) {
        std::array<std::array<std::uint32_t, 4>, 2> loops{};
        std::array<std::size_t, 2> counts{};
        std::uint32_t down = no_index,
                      up = no_index;  // where the triangle's boundary crosses the plane downwards and upwards
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
            const double at = heights_[from], next = heights_[to];
            if (at <= 0) loops[0][counts[0]++] = from;
            if (at >= 0) loops[1][counts[1]++] = from;
            if (at == 0) (next > 0 ? up : down) = from;
            if ((at < 0 && next > 0) || (at > 0 && next < 0)) {
                const std::uint32_t middle = between(from, to);
                loops[0][counts[0]++] = middle;
                loops[1][counts[1]++] = middle;
                (next > 0 ? up : down) = middle;
            }
        }
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t i = 2; i < counts[side]; ++i)
                sides_[side].triangles.emplace_back(loops[side][0], loops[side][i - 1], loops[side][i]);
        sides_[0].cap_outline.emplace_back(down, up);  // the triangle below runs from up to down along the plane
        sides_[1].cap_outline.emplace_back(up, down);
    }

    /// Cuts the caps that the plane crosses, each along a line. Points in the plane count as below, which avoids
    /// special cases.
    void cut_caps(const CutPlane& plane) {
        struct Crossing {
            double along;
            std::uint32_t point;
            int direction;  // upward minus downward crossings of the outline
        };
        std::vector<std::vector<Crossing>> crossings(piece_.cap_origins.size());
        for (const CapEdge& edge : piece_.cap_edges) {
            const double from = heights_[edge.from], to = heights_[edge.to];
            if (from <= 0 && to <= 0) {
                sides_[0].cap_edges.push_back(edge);
                if (from == 0 && to == 0) sides_[0].cap_outline.emplace_back(edge.to, edge.from);
                continue;
            }
            if (from > 0 && to > 0) {
                sides_[1].cap_edges.push_back(edge);
                continue;
            }
            const std::uint32_t middle = from == 0 ? edge.from : to == 0 ? edge.to : between(edge.from, edge.to);
            const bool up = to > 0;
            if (middle != edge.from) sides_[up ? 0 : 1].cap_edges.push_back({edge.from, middle, edge.cap});
            if (middle != edge.to) sides_[up ? 1 : 0].cap_edges.push_back({middle, edge.to, edge.cap});
            const DVec<3> line = cross(plane.normal, piece_.cap_normals[edge.cap]);
            crossings[edge.cap].push_back({dot(line, points_[middle]), middle, up ? 1 : -1});
        }
        for (std::uint32_t cap = 0; cap < crossings.size(); ++cap) {
            std::vector<Crossing>& at = crossings[cap];
            std::sort(at.begin(), at.end(), [](const Crossing& a, const Crossing& b) {
                return std::tie(a.along, a.point, a.direction) < std::tie(b.along, b.point, b.direction);
            });
            int winding = 0;
            for (std::size_t i = 0; i + 1 < at.size(); ++i) {
                winding += at[i].direction;
                // The outline goes up at one crossing and comes down at another; the line closes both sides.
                const std::uint32_t from = winding > 0 ? at[i].point : at[i + 1].point;
                const std::uint32_t to = winding > 0 ? at[i + 1].point : at[i].point;
                if (from == to) continue;
                for (int copy = 0; copy < std::abs(winding); ++copy) {
                    // Below the plane the outline arrives at `from` and continues from `to`; above it is the other way
                    // round.
                    sides_[0].cap_edges.push_back({from, to, cap});
                    sides_[0].cap_outline.emplace_back(to, from);
                    sides_[1].cap_edges.push_back({to, from, cap});
                    sides_[1].cap_outline.emplace_back(from, to);
                }
            }
        }
    }

    const Piece& piece_;
    std::vector<DVec<3>> points_;
    std::vector<double> heights_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts_;
    std::array<Side, 3> sides_;  ///< below, above, and in the plane if the component is open
};

/// The winding number of the piece around a point, by ray casting. Adjacent triangles evaluate their common edge
/// identically, so the ray cannot slip through between them.
int winding(const Piece& piece, const DVec<3>& point) {
    const DVec<3> ray(1, 0.0271828, 0.0141421);  // unlikely to be parallel to modelled faces
    int result = 0;
    for (const SignedTriangle& t : signed_triangles(piece)) {
        const DVec<3> a = t.a - point, b = t.b - point, c = t.c - point;
        const bool ab = dot(ray, cross(a, b)) > 0, bc = dot(ray, cross(b, c)) > 0, ca = dot(ray, cross(c, a)) > 0;
        if (ab != bc || bc != ca) continue;
        const bool outwards = ab;
        if ((dot(a, cross(b, c)) > 0) == outwards) result += outwards ? 1 : -1;
    }
    return result;
}

/// The centroid of the largest triangle: a point of the surface on no cap. Without a surface, the mean of all points.
DVec<3> sample_surface_point(const Piece& piece) {
    DVec<3> result(0.0);
    for (const DVec<3>& p : piece.points) result += p / static_cast<double>(piece.points.size());
    double largest = 0;
    for (const glm::uvec3& t : piece.triangles) {
        const DVec<3>&a = piece.points[t.x], &b = piece.points[t.y], &c = piece.points[t.z];
        const double area = length_squared(cross(b - a, c - a));
        if (area <= largest) continue;
        largest = area;
        result = (a + b + c) / 3.0;
    }
    return result;
}

void append(Piece& component, const Piece& other) {
    const auto points = static_cast<std::uint32_t>(component.points.size());
    const auto caps = static_cast<std::uint32_t>(component.cap_origins.size());
    component.points.insert(component.points.end(), other.points.begin(), other.points.end());
    component.cap_origins.insert(component.cap_origins.end(), other.cap_origins.begin(), other.cap_origins.end());
    component.cap_normals.insert(component.cap_normals.end(), other.cap_normals.begin(), other.cap_normals.end());
    for (const glm::uvec3& t : other.triangles) component.triangles.push_back(t + glm::uvec3(points));
    for (const CapEdge& edge : other.cap_edges)
        component.cap_edges.push_back({edge.from + points, edge.to + points, edge.cap + caps});
    component.volume += other.volume;
}

/// Joins each piece for which `inside_of` returns a point with the smallest other piece that encloses this point.
template <class InsideOf>
void join_with_surrounding(std::vector<Piece>& pieces, InsideOf inside_of) {
    std::vector<std::optional<DVec<3>>> inside;
    for (const Piece& piece : pieces) inside.push_back(inside_of(piece));
    std::vector<std::size_t> around(pieces.size());
    std::iota(around.begin(), around.end(), std::size_t{0});
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!inside[i]) continue;
        for (std::size_t j = 0; j < pieces.size(); ++j)
            if (!inside[j] && (around[i] == i || pieces[j].volume < pieces[around[i]].volume) &&
                winding(pieces[j], *inside[i]) > 0)
                around[i] = j;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (around[i] != i) append(pieces[around[i]], pieces[i]);
    std::vector<Piece> result;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (around[i] == i) result.push_back(std::move(pieces[i]));
    pieces = std::move(result);
}

/// Joins faces in the plane of a cut, if they are disconnected from the rest of the surface, with the component next to
/// the plane.
void join_coplanar_faces(std::vector<Piece>& pieces, const CutPlane& plane, double tolerance, bool below) {
    const double beside = (below ? -4 : 4) * tolerance;
    join_with_surrounding(pieces, [&](const Piece& piece) -> std::optional<DVec<3>> {
        const bool flat = std::all_of(piece.points.begin(), piece.points.end(), [&](const DVec<3>& p) {
            return std::abs(dot(plane.normal, p) - plane.offset) <= tolerance;
        });
        if (!flat) return std::nullopt;
        return sample_surface_point(piece) + plane.normal * beside;
    });
}

}  // namespace

void join_cavities(std::vector<Piece>& pieces) {
    join_with_surrounding(pieces, [](const Piece& piece) -> std::optional<DVec<3>> {
        if (!piece.closed || piece.volume >= 0) return std::nullopt;
        return sample_surface_point(piece);
    });
}

double measured_volume(const Piece& piece) {
    if (piece.points.empty()) return 0;
    const DVec<3>& origin = piece.points.front();
    double six_volumes = 0, two_areas = 0;
    for (const SignedTriangle& t : signed_triangles(piece)) {
        const DVec<3> area = cross(t.b - t.a, t.c - t.a);
        six_volumes += dot(t.a - origin, area);
        two_areas += length(area);
    }
    return piece.closed ? six_volumes / 6 : piece.thickness * two_areas / 2;
}

std::vector<SignedTriangle> signed_triangles(const Piece& piece) {
    std::vector<SignedTriangle> result;
    result.reserve(piece.triangles.size() + piece.cap_edges.size());
    for (const glm::uvec3& t : piece.triangles)
        result.push_back({piece.points[t.x], piece.points[t.y], piece.points[t.z]});
    for (const CapEdge& edge : piece.cap_edges)
        result.push_back({piece.cap_origins[edge.cap], piece.points[edge.from], piece.points[edge.to]});
    return result;
}

std::vector<Piece> connected_components(const Piece& piece) {
    std::vector<std::uint32_t> parent(piece.points.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t at) {
        while (parent[at] != at) at = parent[at] = parent[parent[at]];
        return at;
    };
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t first = root(a), second = root(b);
        parent[std::max(first, second)] = std::min(first, second);
    };
    for (const glm::uvec3& t : piece.triangles) {
        unite(t.x, t.y);
        unite(t.y, t.z);
    }
    for (const CapEdge& edge : piece.cap_edges) unite(edge.from, edge.to);

    std::vector<std::uint32_t> number(piece.points.size(), no_index), renumbered(piece.points.size(), no_index);
    std::vector<Piece> result;
    const auto piece_of = [&](std::uint32_t point) -> Piece& {
        std::uint32_t& place = number[root(point)];
        if (place == no_index) {
            place = static_cast<std::uint32_t>(result.size());
            Piece& fresh = result.emplace_back();
            fresh.closed = piece.closed;
            fresh.thickness = piece.thickness;
        }
        return result[place];
    };
    const auto add_point = [&](Piece& into, std::uint32_t point) {
        if (renumbered[point] == no_index) {
            renumbered[point] = static_cast<std::uint32_t>(into.points.size());
            into.points.push_back(piece.points[point]);
        }
        return renumbered[point];
    };
    for (const glm::uvec3& t : piece.triangles) {
        Piece& into = piece_of(t.x);
        const std::uint32_t a = add_point(into, t.x), b = add_point(into, t.y), c = add_point(into, t.z);
        into.triangles.emplace_back(a, b, c);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> caps;  // by piece and previous number
    for (const CapEdge& edge : piece.cap_edges) {
        Piece& into = piece_of(edge.from);
        const std::uint32_t from = add_point(into, edge.from), to = add_point(into, edge.to);
        const auto [cap, is_new] =
            caps.try_emplace({number[root(edge.from)], edge.cap}, static_cast<std::uint32_t>(into.cap_origins.size()));
        if (is_new) {
            into.cap_origins.push_back(into.points[from]);
            into.cap_normals.push_back(piece.cap_normals[edge.cap]);
        }
        into.cap_edges.push_back({from, to, cap->second});
    }
    for (Piece& part : result) part.volume = measured_volume(part);
    return result;
}

std::vector<Piece> cut(const Piece& piece, const CutPlane& plane, double tolerance) {
    constexpr double negligible = 1e-9;  // the residual volume of caps that cancel each other
    Cutter cutter(piece, plane, tolerance);
    std::vector<Piece> result;
    for (const int which : {0, 1, 2}) {
        std::vector<Piece> parts = connected_components(cutter.side(which, plane));
        if (piece.closed) {
            join_coplanar_faces(parts, plane, tolerance, which == 0);
            join_cavities(parts);
        }
        for (Piece& part : parts)
            if (!part.triangles.empty() || part.volume > negligible * piece.volume) result.push_back(std::move(part));
    }
    return result;
}

std::vector<Piece> components_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                 double thickness) {
    Piece soup;
    soup.points.assign(points.begin(), points.end());
    soup.triangles.assign(triangles.begin(), triangles.end());
    soup.closed = false;
    std::vector<Piece> components = connected_components(soup);
    for (Piece& component : components) {
        component.closed = edge_faults(component.triangles).closed;
        component.volume = measured_volume(component);
    }
    join_cavities(components);
    for (Piece& component : components) {
        if (component.closed && component.volume > 0) continue;
        component.closed = false;
        component.thickness = thickness;
        component.volume = measured_volume(component);
    }
    return components;
}

bool is_convex(const Piece& component) {
    if (!component.closed || !component.cap_edges.empty()) return false;
    std::vector<Vec3> points;
    points.reserve(component.points.size());
    for (const DVec<3>& p : component.points) points.push_back(to_float(p));
    return is_convex_solid(points, component.triangles);
}

}  // namespace abut::detail
