#include <abut/io/file/scanner.hpp>
#include <abut/io/level_shape.hpp>
#include <abut/io/svg/path.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace abut::svg {

using namespace detail;

namespace {

using Point = DVec<2>;

constexpr double default_tolerance = 1e-3;
constexpr double max_segments = 4096;
constexpr std::size_t max_points = std::size_t{1} << 22;

bool is_command(char c) {
    return std::string_view("MmLlHhVvCcSsQqTtAaZz").find(c) != std::string_view::npos;
}
char upper(char c) {
    return c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
}
Point mirrored(const Point& p, const Point& at) {
    return 2.0 * at - p;
}

// Reads path data in one pass and flattens its curves.
class PathFlattener {
public:
    PathFlattener(std::string_view data, std::optional<double> tolerance) : scanner_(data), tolerance_(tolerance) {}

    Result<std::vector<Subpath>> flatten();

private:
    void fail(ProblemCode code, std::string what) {
        if (!problem_)
            problem_ = Problem{
                code, "path data: " + std::move(what) + " at character " + std::to_string(scanner_.position() + 1)};
    }
    double number() {
        const std::optional<double> value = problem_ ? std::nullopt : scanner_.number();
        if (!value) fail(ProblemCode::bad_format, "a number was expected");
        return value.value_or(0);
    }
    bool flag() {
        const std::optional<bool> value = problem_ ? std::nullopt : scanner_.flag();
        if (!value) fail(ProblemCode::bad_format, "a flag, 0 or 1, was expected");
        return value.value_or(false);
    }
    Point point(bool relative) {
        const double x = number();
        return Point(x, number()) + (relative ? at_ : Point(0));
    }

    void segment(char command);
    void move_to(const Point& to);
    void line_to(const Point& to);
    void cubic_to(const Point& b, const Point& c, const Point& to);
    void quadratic_to(const Point& b, const Point& to);
    void arc_to(Point radii, double degrees, bool large, bool sweep, const Point& to);
    void close();
    /// Adds a curve from the current point as `segments` line segments; `curve` maps (0, 1) to points.
    template <class Curve>
    void add_curve(double segments, const Point& to, Curve curve);
    double tolerance_for(double extent) const { return tolerance_.value_or(default_tolerance * extent); }

    Scanner scanner_;
    std::optional<double> tolerance_;
    std::vector<Subpath> subpaths_;
    std::size_t points_ = 0;
    Point at_{0}, start_{0};
    std::optional<Point> last_cubic_, last_quadratic_;  ///< last control points, which S and T reflect
    bool is_open_ = false;                              ///< the last subpath can be extended
    std::optional<Problem> problem_;
};

void PathFlattener::move_to(const Point& to) {
    subpaths_.push_back({{to}, false});
    at_ = start_ = to;
    is_open_ = true;
}

void PathFlattener::line_to(const Point& to) {
    // After Z the next subpath starts at the start of the last one.
    if (!is_open_) move_to(at_);
    if (++points_ > max_points) return fail(ProblemCode::too_large, "more than 4194304 points");
    subpaths_.back().points.push_back(to);
    at_ = to;
}

template <class Curve>
void PathFlattener::add_curve(double segments, const Point& to, Curve curve) {
    if (!(segments <= max_segments))
        return fail(ProblemCode::too_large, "a curve needs more than 4096 segments for this tolerance");
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(segments)));
    for (std::size_t i = 1; i < count && !problem_; ++i)
        line_to(curve(static_cast<double>(i) / static_cast<double>(count)));
    line_to(to);
}

// A chord over a parameter interval h deviates from the curve by at most h^2 / 8 times the maximum second derivative.
// For a Bezier curve of degree n this derivative is at most n (n - 1) times the maximum second difference of its
// control points.
void PathFlattener::cubic_to(const Point& b, const Point& c, const Point& to) {
    const Point a = at_;
    const double second_difference = std::max(length(a - 2.0 * b + c), length(b - 2.0 * c + to));
    const double extent = std::max({length(b - a), length(c - a), length(to - a)});
    const double segments = second_difference == 0 ? 1 : square_root(0.75 * second_difference / tolerance_for(extent));
    add_curve(segments, to, [&](double t) {
        const double s = 1 - t;
        return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * to;
    });
    last_cubic_ = c;
}

void PathFlattener::quadratic_to(const Point& b, const Point& to) {
    const Point a = at_;
    const double second_difference = length(a - 2.0 * b + to);
    const double segments =
        second_difference == 0
            ? 1
            : square_root(0.25 * second_difference / tolerance_for(std::max(length(b - a), length(to - a))));
    add_curve(segments, to, [&](double t) {
        const double s = 1 - t;
        return s * s * a + 2 * s * t * b + t * t * to;
    });
    last_quadratic_ = b;
}

// Converts the end points to the centre: SVG 2, B.2.4 "Conversion from endpoint to center parameterization".
void PathFlattener::arc_to(Point radii, double degrees, bool large, bool sweep, const Point& to) {
    radii = {std::abs(radii.x), std::abs(radii.y)};
    if (radii.x == 0 || radii.y == 0 || to == at_) return line_to(to);
    const Affine<2> turn = rotation_by(degrees);
    const Point half = turn.transposed(0.5 * (at_ - to));
    const double scale_up =
        square_root((half.x / radii.x) * (half.x / radii.x) + (half.y / radii.y) * (half.y / radii.y));
    if (scale_up > 1) radii *= scale_up;
    // In the frame in which the ellipse is the unit circle, the centre is perpendicular to the half chord.
    const Point chord(half.x / radii.x, half.y / radii.y);
    const double squared = length_squared(chord);
    const double height = square_root(std::max(0.0, 1 / squared - 1)) * (large == sweep ? -1 : 1);
    const Point centre(height * chord.y, -height * chord.x);
    const Point from = chord - centre, until = -chord - centre;
    const double first = angle_of(from.x, from.y);
    double angle = angle_of(until.x, until.y) - first;
    if (sweep && angle <= 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle >= 0) angle -= 2 * std::numbers::pi;

    const Point middle = 0.5 * (at_ + to);
    const double radius = std::max(radii.x, radii.y);
    const double segments = std::ceil(std::abs(angle) * square_root(radius / (8 * tolerance_for(radius))));
    add_curve(segments, to, [&](double t) {
        const SinCos at = sin_cos(first + t * angle);
        const Point on = Point(at.cos, at.sin) + centre;
        return middle + turn.vector({radii.x * on.x, radii.y * on.y});
    });
}

void PathFlattener::close() {
    if (is_open_) subpaths_.back().closed = true;
    is_open_ = false;
    at_ = start_;
}

void PathFlattener::segment(char command) {
    const bool relative = command >= 'a';
    const std::optional<Point> cubic = std::exchange(last_cubic_, {}), quadratic = std::exchange(last_quadratic_, {});
    switch (upper(command)) {
        case 'M': {
            const Point to = point(relative);
            if (!problem_) move_to(to);
            return;
        }
        case 'L': {
            const Point to = point(relative);
            return line_to(to);
        }
        case 'H': {
            const double x = number() + (relative ? at_.x : 0);
            return line_to({x, at_.y});
        }
        case 'V': {
            const double y = number() + (relative ? at_.y : 0);
            return line_to({at_.x, y});
        }
        case 'C':
        case 'S': {
            const Point b = upper(command) == 'C' ? point(relative) : mirrored(cubic.value_or(at_), at_);
            const Point c = point(relative), to = point(relative);
            return cubic_to(b, c, to);
        }
        case 'Q':
        case 'T': {
            const Point b = upper(command) == 'Q' ? point(relative) : mirrored(quadratic.value_or(at_), at_);
            const Point to = point(relative);
            return quadratic_to(b, to);
        }
        default: {
            const double x = number(), y = number(), degrees = number();
            const bool large = flag(), sweep = flag();
            const Point to = point(relative);
            return arc_to({x, y}, degrees, large, sweep, to);
        }
    }
}

Result<std::vector<Subpath>> PathFlattener::flatten() {
    char command = 0;
    while (!scanner_.at_end() && !problem_) {
        const char next = scanner_.peek();
        if (is_command(next)) {
            if (subpaths_.empty() && upper(next) != 'M') fail(ProblemCode::bad_format, "M was expected");
            scanner_.skip();
            command = next;
            if (upper(command) == 'Z') {
                close();
                continue;
            }
        } else if (command == 0 || upper(command) == 'Z') {
            fail(ProblemCode::bad_format, "a command was expected");
        } else if (upper(command) == 'M') {
            command = command == 'M' ? 'L' : 'l';  // further coordinates after M are line segments
        }
        if (!problem_) segment(command);
    }
    if (problem_) return *problem_;
    return std::move(subpaths_);
}

}  // namespace

Result<std::vector<Subpath>> flatten_path(std::string_view data, std::optional<double> tolerance) {
    return PathFlattener(data, tolerance).flatten();
}

}  // namespace abut::svg
