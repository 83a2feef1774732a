#include <abut/convex/sides.hpp>

namespace abut {
namespace {

/// Corners, in their order, to rows.
class Rows {
public:
    Rows(double* numbers, std::uint32_t count) : numbers_(numbers), count_(count), room_(room_for_sides(count)) {}

    template <class Corner>
    void write(const Corner& corner) {
        const DVec<2> first = corner(0);
        DVec<2> from = first, low = from, high = from;
        double area = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const DVec<2> to = corner(i + 1 == count_ ? 0 : i + 1), edge = to - from;
            // In double no square of a difference of floats overflows, or vanishes.
            const double part = 1 / std::sqrt(dot(edge, edge));
            const DVec<2> normal(edge.y * part, -edge.x * part);
            put(i, from, normal, dot(normal, from));
            area += cross(from - first, edge);
            low = {std::min(low.x, from.x), std::min(low.y, from.y)};
            high = {std::max(high.x, from.x), std::max(high.y, from.y)};
            from = to;
        }
        for (std::uint32_t i = count_; i < room_; ++i)
            for (std::uint32_t row = 0; row < 5; ++row) numbers_[row * room_ + i] = numbers_[row * room_];
        numbers_[5 * room_] = 0.5 * length(high - low);
        numbers_[5 * room_ + 1] = 0.5 * area;
    }

private:
    void put(std::uint32_t i, const DVec<2>& corner, const DVec<2>& normal, double offset) {
        numbers_[i] = corner.x;
        numbers_[room_ + i] = corner.y;
        numbers_[2 * room_ + i] = normal.x;
        numbers_[3 * room_ + i] = normal.y;
        numbers_[4 * room_ + i] = offset;
    }

    double* numbers_;
    std::uint32_t count_, room_;
};

/// Field by field, as what is written in parts and read as a whole has to be waited for.
void refer_to(const double* numbers, std::uint32_t count, Numbering numbering, Sides& sides) {
    const std::uint32_t room = room_for_sides(count);
    sides.x = numbers;
    sides.y = numbers + room;
    sides.normal_x = numbers + std::size_t{2} * room;
    sides.normal_y = numbers + std::size_t{3} * room;
    sides.offset = numbers + std::size_t{4} * room;
    sides.count = count;
    sides.room = room;
    sides.numbering = numbering;
    sides.size = numbers[std::size_t{5} * room];
    sides.area = numbers[std::size_t{5} * room + 1];
}

void sides_of_box(const Vec2& half, FewSides& room, Sides& sides) {
    static constexpr double normals_x[4] = {0, -1, 0, 1}, normals_y[4] = {1, 0, -1, 0};
    const double x = static_cast<double>(half.x), y = static_cast<double>(half.y);
    double* numbers = room.numbers;
    numbers[0] = numbers[3] = numbers[9] = numbers[11] = x;
    numbers[1] = numbers[2] = -x;
    numbers[4] = numbers[5] = numbers[8] = numbers[10] = y;
    numbers[6] = numbers[7] = -y;
    sides.x = numbers;
    sides.y = numbers + 4;
    sides.normal_x = normals_x;
    sides.normal_y = normals_y;
    sides.offset = numbers + 8;
    sides.count = 4;
    sides.room = 4;
    sides.numbering = Numbering::box;
    sides.size = x + y;
    sides.area = 4 * x * y;
}

bool sides_of_segment(const Vec2* points, FewSides& room, Sides& sides) {
    if (points[0] == points[1]) return false;
    Rows rows(room.numbers, 2);
    rows.write([&](std::uint32_t i) { return DVec<2>(points[i]); });
    refer_to(room.numbers, 2, Numbering::listed, sides);
    return true;
}

/// A triangle so thin that its area may be rounding has none.
bool sides_of_triangle(const Vec2* points, FewSides& room, Sides& sides) {
    const DVec<2> u = DVec<2>(points[1]) - DVec<2>(points[0]), v = DVec<2>(points[2]) - DVec<2>(points[0]);
    const double area = cross(u, v);
    const double most = std::max({dot(u, u), dot(v, v), length_squared(v - u)});
    if (!(std::abs(area) > 1e-9 * most)) return false;
    const bool backwards = area < 0;
    Rows rows(room.numbers, 3);
    rows.write([&](std::uint32_t i) { return DVec<2>(points[backwards ? (3 - i) % 3 : i]); });
    refer_to(room.numbers, 3, backwards ? Numbering::backwards : Numbering::listed, sides);
    return true;
}

}  // namespace

void write_sides(std::span<const Vec2> points, double* numbers) {
    Rows(numbers, static_cast<std::uint32_t>(points.size())).write([&](std::uint32_t i) { return DVec<2>(points[i]); });
}

bool sides_of(const Convex<2>& convex, FewSides& room, Sides& sides) {
    const bool rigid = keeps_its_form(convex) && std::abs(convex.scale - 1) <= 1e-12 &&
                       cross(convex.place.column[0], convex.place.column[1]) > 0;
    if (!rigid) return false;
    if (convex.sides != nullptr) {
        refer_to(convex.sides, convex.count, Numbering::listed, sides);
        return true;
    }
    if (convex.core == Core::box) {
        sides_of_box(convex.own[0], room, sides);
        return true;
    }
    if (convex.core != Core::points) return false;
    if (convex.count == 2) return sides_of_segment(convex.vertices(), room, sides);
    return convex.count == 3 && sides_of_triangle(convex.vertices(), room, sides);
}

}  // namespace abut
