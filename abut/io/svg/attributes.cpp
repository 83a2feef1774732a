#include <abut/io/file/scanner.hpp>
#include <abut/io/level_shape.hpp>
#include <abut/io/svg/attributes.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <numbers>
#include <span>
#include <string>

namespace abut::svg {

using namespace detail;

namespace {

double tangent(double degrees) {
    const SinCos at = sin_cos(degrees * (std::numbers::pi / 180));
    return at.sin / at.cos;
}

// Evaluates one transform function; nothing if the name or the count of arguments is unknown.
std::optional<Affine<2>> function(std::string_view name, std::span<const double> numbers) {
    const std::size_t count = numbers.size();
    Affine<2> result;
    if (name == "matrix" && count == 6) {
        result.column = {DVec<2>(numbers[0], numbers[1]), DVec<2>(numbers[2], numbers[3])};
        result.offset = {numbers[4], numbers[5]};
        return result;
    }
    if (name == "translate" && (count == 1 || count == 2))
        return translation_by({numbers[0], count == 2 ? numbers[1] : 0});
    if (name == "scale" && (count == 1 || count == 2))
        return scaling_by({numbers[0], count == 2 ? numbers[1] : numbers[0]});
    if (name == "rotate" && count == 1) return rotation_by(numbers[0]);
    if (name == "rotate" && count == 3)
        return translation_by({numbers[1], numbers[2]}) * rotation_by(numbers[0]) *
               translation_by({-numbers[1], -numbers[2]});
    if (name == "skewX" && count == 1) {
        result.column[1].x = tangent(numbers[0]);
        return result;
    }
    if (name == "skewY" && count == 1) {
        result.column[0].y = tangent(numbers[0]);
        return result;
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> length(std::string_view text, double whole) {
    Scanner scanner(trimmed(text));
    const std::optional<double> value = scanner.number();
    if (!value) return std::nullopt;
    const std::string_view unit = trimmed(trimmed(text).substr(scanner.position()));
    struct Unit {
        std::string_view name;
        double pixels;
    };
    constexpr double inch = 96;
    const std::array<Unit, 12> units{{{"", 1},
                                      {"px", 1},
                                      {"in", inch},
                                      {"cm", inch / 2.54},
                                      {"mm", inch / 25.4},
                                      {"Q", inch / 101.6},
                                      {"pt", inch / 72},
                                      {"pc", inch / 6},
                                      {"em", 16},
                                      {"rem", 16},
                                      {"ex", 8},
                                      {"%", 0.01 * whole}}};
    for (const Unit& known : units)
        if (known.name == unit) return *value * known.pixels;
    return std::nullopt;
}

Result<Affine<2>> transform(std::string_view text) {
    Affine<2> result;
    Scanner scanner(text);
    const auto problem = [&] {
        return Problem{ProblemCode::bad_format,
                       "transform: syntax error at character " + std::to_string(scanner.position() + 1)};
    };
    while (!scanner.at_end()) {
        const std::string_view name = scanner.word();
        if (name == "none" && scanner.at_end()) break;
        if (name.empty() || scanner.peek() != '(') return problem();
        scanner.skip();
        std::array<double, 6> numbers{};
        std::size_t count = 0;
        for (; scanner.peek() != ')'; ++count) {
            const std::optional<double> value = scanner.number();
            if (!value || count == numbers.size()) return problem();
            numbers[count] = *value;
        }
        const std::optional<Affine<2>> map = function(name, std::span(numbers).first(count));
        if (!map) return problem();
        scanner.skip();
        result = result * *map;
    }
    return result;
}

std::optional<std::string_view> declared(std::string_view style, std::string_view property) {
    std::optional<std::string_view> result;
    while (!style.empty()) {
        const std::size_t end = style.find(';');
        const std::string_view one = style.substr(0, end);
        const std::size_t colon = one.find(':');
        if (colon != std::string_view::npos && trimmed(one.substr(0, colon)) == property)
            result = trimmed(one.substr(colon + 1));
        style.remove_prefix(end == std::string_view::npos ? style.size() : end + 1);
    }
    return result;
}

}  // namespace abut::svg
