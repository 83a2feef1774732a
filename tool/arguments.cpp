#include "tool/arguments.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace abut::tool {

using namespace detail;

namespace {

constexpr std::size_t max_bounces = 100'000;
constexpr float max_cells = 1e6f;
constexpr std::uint32_t max_vertices = 1'000'000, max_parts = 100'000;

// True if the entire text is one number.
template <class Number>
bool parse(const std::string& text, Number& number) {
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stopped == end;
}

Problem parse_problem(const std::string& text, const char* expected) {
    return {ProblemCode::bad_argument, "'" + text + "' is not " + expected};
}

template <class Number>
Result<Number> parse_whole(const std::string& text, Number min, Number max) {
    Number number = 0;
    if (parse(text, number) && number >= min && number <= max) return number;
    return parse_problem(text, ("a whole number from " + std::to_string(min) + " to " + std::to_string(max)).c_str());
}

}  // namespace

Result<float> parse_length(const std::string& text) {
    float length = 0;
    if (!parse(text, length) || !std::isfinite(length) || length < 0)
        return parse_problem(text, "a number of at least 0");
    return length;
}

Result<std::size_t> parse_frames(const std::string& text) {
    return parse_whole<std::size_t>(text, 1, max_frames);
}

Result<std::size_t> parse_threads(const std::string& text) {
    return parse_whole<std::size_t>(text, 1, max_threads);
}

template <int D>
Result<Vec<D>> parse_point(const std::string& text) {
    Vec<D> point{};
    std::size_t first = 0;
    bool is_point = true;
    for (int i = 0; i < D; ++i) {
        const std::size_t comma = i + 1 < D ? text.find(',', first) : text.size();
        is_point = is_point && comma != std::string::npos && parse(text.substr(first, comma - first), point[i]);
        first = is_point ? comma + 1 : 0;
    }
    if (is_point && is_finite(point)) return point;
    return parse_problem(text, D == 2 ? "a point of a level, two numbers with a comma between them: X,Y"
                                      : "a point, three numbers with commas between them: X,Y,Z");
}
template Result<Vec<2>> parse_point<2>(const std::string& text);
template Result<Vec<3>> parse_point<3>(const std::string& text);

Result<std::size_t> parse_bounces(const std::string& text) {
    return parse_whole<std::size_t>(text, 1, max_bounces);
}

Result<std::uint32_t> parse_vertices(const std::string& text) {
    return parse_whole<std::uint32_t>(text, 4, max_vertices);
}

Result<std::uint32_t> parse_parts(const std::string& text) {
    return parse_whole<std::uint32_t>(text, 1, max_parts);
}

Result<float> parse_cell(const std::string& text) {
    float cell = 0;
    if (!parse(text, cell) || !std::isfinite(cell) || !(cell > 0)) return parse_problem(text, "a number above 0");
    return cell;
}

Result<float> parse_cells(const std::string& text) {
    float cells = 0;
    if (!parse(text, cells) || !(cells >= 1 && cells <= max_cells))
        return parse_problem(text, "a number from 1 to 1000000");
    return cells;
}

Result<FieldSlice> parse_slice(const std::string& text) {
    FieldSlice slice;
    const bool is_slice = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=' &&
                          parse(text.substr(2), slice.at) && std::isfinite(slice.at);
    if (!is_slice) return parse_problem(text, "an axis and a number, such as z=0.3");
    slice.axis = text[0] - 'x';
    return slice;
}

Result<double> parse_share(const std::string& text) {
    double share = 0;
    if (!parse(text, share) || !(share >= 0 && share <= 1)) return parse_problem(text, "a number from 0 to 1");
    return share;
}

Result<double> parse_time(const std::string& text) {
    double time = 0;
    if (!parse(text, time) || !std::isfinite(time)) return parse_problem(text, "a number of seconds");
    return time;
}

Result<Character> parse_character(const std::string& text) {
    const std::size_t comma = text.find(',');
    Character character;
    const bool is_character = comma != std::string::npos && parse(text.substr(0, comma), character.radius) &&
                              parse(text.substr(comma + 1), character.height) && std::isfinite(character.height) &&
                              character.radius > 0 && character.height >= 2 * character.radius;
    if (!is_character)
        return parse_problem(text, "a radius above 0 and a height of at least twice as much: RADIUS,HEIGHT");
    return character;
}

Result<GapRange> parse_gap(const std::string& text) {
    const std::size_t comma = text.find(',');
    GapRange range;
    const bool has_min = comma != std::string::npos;
    const bool is_range = (!has_min || parse(text.substr(0, comma), range.min_width)) &&
                          parse(text.substr(has_min ? comma + 1 : 0), range.width) && std::isfinite(range.width) &&
                          range.min_width >= 0 && range.width > range.min_width;
    if (!is_range) return parse_problem(text, "a width above 0, or two of which the second is greater: LEAST,WIDTH");
    if (!has_min) range.min_width = default_min_gap * range.width;
    return range;
}

Result<UpDirection> parse_up(const std::string& text) {
    if (text == "none") return UpDirection{-1, 1};
    const bool has_sign = text.size() == 2 && (text[0] == '-' || text[0] == '+');
    const char axis = text.empty() ? ' ' : text.back();
    if ((text.size() != 1 && !has_sign) || axis < 'x' || axis > 'z')
        return parse_problem(text, "one of x, -x, y, -y, z, -z and none");
    return UpDirection{axis - 'x', text[0] == '-' ? -1.0f : 1.0f};
}

Result<PairPattern> parse_pair(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos || colon == 0 ||
        colon + 1 == text.size())
        return parse_problem(text, "two patterns with one ':' between them (a ':' in a name is matched by '?')");
    return PairPattern{text.substr(0, colon), text.substr(colon + 1)};
}

Result<IgnorePattern> parse_ignore(const std::string& text) {
    IgnorePattern pattern;
    pattern.text = text;
    std::string objects = text;
    const std::size_t blank = text.find(' ');
    if (blank != std::string::npos && text.starts_with("ABUT") && names_any_rule(text.substr(0, blank))) {
        pattern.code = text.substr(0, blank);
        objects = text.substr(blank + 1);
    }
    if (objects.empty() || objects.find(':') == std::string::npos) {
        pattern.a = objects;
        if (!objects.empty()) return pattern;
    } else if (const Result<PairPattern> pair = parse_pair(objects)) {
        pattern.a = pair->a;
        pattern.b = pair->b;
        return pattern;
    }
    return parse_problem(text,
                         "one pattern, or two with one ':' between them (a ':' in a name is matched by '?'), after "
                         "a code and a blank or alone");
}

}  // namespace abut::tool
