#include <abut/io/file/scanner.hpp>
#include <abut/io/file/xml-inl.h>
#include <abut/io/finish_level.hpp>
#include <abut/io/level_shape.hpp>
#include <abut/io/svg/attributes.hpp>
#include <abut/io/svg/path.hpp>
#include <abut/io/svg/read_svg.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace abut::detail {
namespace {

using pugi::xml_node;

constexpr int max_depth = 256;
// Nested <use> elements can grow exponentially.
constexpr std::size_t max_copies = 100'000;

std::string_view tag(const xml_node& node) {
    const std::string_view name = node.name();
    return name.starts_with("svg:") ? name.substr(4) : name;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Properties that elements inherit from their ancestors.
struct Inherited {
    Affine<2> map;
    bool has_area = true;  ///< fill is not none
    bool is_visible = true;
    FillRule rule = FillRule::nonzero;
    DVec<2> viewport{0};  ///< reference size of percentages
    std::string path;     ///< path of the enclosing groups, with a trailing '/'
    int depth = 0;
    bool copied = false;  ///< drawn by <use>
};

class Reader {
public:
    Reader(const Xml& xml, std::optional<double> tolerance) : xml_(xml), tolerance_(tolerance) {}

    Result<Level> read();

private:
    void fail(const xml_node& node, ProblemCode code, const std::string& what) {
        if (!problem_) problem_ = Problem{code, xml_.line(node) + "<" + node.name() + ">: " + what};
    }
    void find_ids();
    std::string name_of(const xml_node& node) const;
    std::string_view style(const xml_node& node, const char* property) const;
    double length(const xml_node& node, const char* key, double whole, double default_value = 0);
    DVec<2> lengths(const xml_node& node, const char* x, const char* y, const DVec<2>& whole);
    Affine<2> viewport(const xml_node& node, const DVec<2>& size, DVec<2>& inner);

    void children(const xml_node& node, const Inherited& from);
    void element(const xml_node& node, const Inherited& from);
    void group(const xml_node& node, Inherited from);
    void inner_svg(const xml_node& node, Inherited from, const DVec<2>& size);
    void use(const xml_node& node, Inherited from);
    void switch_child(const xml_node& node, const Inherited& from);

    void shape(const xml_node& node, std::string_view kind, const Inherited& from);
    Result<PlacedShape> rectangle(const xml_node& node, const Inherited& from);
    Result<PlacedShape> round(const xml_node& node, bool circle, const Inherited& from);
    Result<PlacedShape> poly(const xml_node& node, bool closed, const Inherited& from);
    Result<PlacedShape> path(const xml_node& node, const Inherited& from);
    double tolerance_in(const Affine<2>& map, double extent) const;

    const Xml& xml_;
    std::optional<double> tolerance_;
    std::unordered_map<std::string_view, xml_node> ids_;
    std::size_t copies_ = 0;  ///< count of elements drawn by <use>
    Level level_;
    LeftOut left_out_;
    std::optional<Problem> problem_;
};

void Reader::find_ids() {
    for (xml_node node = xml_.root(); node;) {
        const pugi::xml_attribute id = node.attribute("id");
        if (id) ids_.try_emplace(id.value(), node);
        // Iterates in document order without recursion.
        xml_node next = node.first_child();
        for (xml_node up = node; !next && up; up = up.parent()) next = up.next_sibling();
        node = next;
    }
}

std::string Reader::name_of(const xml_node& node) const {
    for (const char* key : {"inkscape:label", "id"})
        if (const std::string name = node.attribute(key).value(); !name.empty()) return name;
    return {};
}

// A property is an attribute of its own or part of `style`, which takes precedence.
std::string_view Reader::style(const xml_node& node, const char* property) const {
    if (const auto value = svg::declared(node.attribute("style").value(), property)) return *value;
    return trimmed(node.attribute(property).value());
}

double Reader::length(const xml_node& node, const char* key, double whole, double default_value) {
    const std::string_view text = trimmed(node.attribute(key).value());
    if (text.empty() || text == "auto") return default_value;
    const std::optional<double> value = svg::length(text, whole);
    if (!value) fail(node, ProblemCode::bad_format, std::string(key) + ": a length was expected");
    return value.value_or(default_value);
}

DVec<2> Reader::lengths(const xml_node& node, const char* x, const char* y, const DVec<2>& whole) {
    const double first = length(node, x, whole.x);
    return {first, length(node, y, whole.y)};
}

// The map from the user space of a nested <svg> or <symbol> to its rectangle:
// https://www.w3.org/TR/SVG2/coords.html#ViewBoxAttribute
Affine<2> Reader::viewport(const xml_node& node, const DVec<2>& size, DVec<2>& inner) {
    inner = size;
    const std::string_view text = node.attribute("viewBox").value();
    if (trimmed(text).empty()) return {};
    Scanner scanner(text);
    std::array<double, 4> box{};
    for (double& number : box) {
        const std::optional<double> value = scanner.number();
        if (!value) fail(node, ProblemCode::bad_format, "viewBox: four numbers were expected");
        number = value.value_or(1);
    }
    if (!(box[2] > 0 && box[3] > 0 && size.x > 0 && size.y > 0)) return {};
    inner = {box[2], box[3]};
    DVec<2> scale = size / inner;
    const std::string_view fit = trimmed(node.attribute("preserveAspectRatio").value());
    if (!fit.starts_with("none"))
        scale = DVec<2>(fit.ends_with("slice") ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y));
    const DVec<2> free_space = size - scale * inner;
    const auto alignment = [&](const char* low, const char* high) {
        return fit.find(low) != std::string_view::npos ? 0 : fit.find(high) != std::string_view::npos ? 1 : 0.5;
    };
    return translation_by({free_space.x * alignment("xMin", "xMax"), free_space.y * alignment("YMin", "YMax")}) *
           scaling_by(scale) * translation_by({-box[0], -box[1]});
}

double Reader::tolerance_in(const Affine<2>& map, double extent) const {
    constexpr double relative_tolerance = 1e-3;
    const double scale = abut::detail::length(map.column[0]) + abut::detail::length(map.column[1]);
    return tolerance_ ? *tolerance_ / std::max(scale, 1e-30) : relative_tolerance * extent;
}

void Reader::children(const xml_node& node, const Inherited& from) {
    if (from.depth > max_depth) return fail(node, ProblemCode::too_large, "elements are nested more than 256 deep");
    for (const xml_node& child : node.children())
        if (!problem_ && child.type() == pugi::node_element) element(child, from);
}

void Reader::element(const xml_node& node, const Inherited& outer) {
    const std::string_view name = tag(node);
    if (outer.copied && ++copies_ > max_copies)
        return fail(node, ProblemCode::too_large, "more than 100000 elements are drawn by <use>");
    if (style(node, "display") == "none") return;
    if (name == "style") return left_out_.add("style sheet is", "style sheets are", "not read", name_of(node));
    const bool groups = is_one_of(name, {"g", "a", "svg", "switch", "use"});
    const bool draws = is_one_of(name, {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"});
    if (is_one_of(name, {"text", "image", "foreignObject"})) {
        const std::string what = name_of(node);
        return left_out_.add("text or picture is", "texts and pictures are", "left out",
                             outer.path + (what.empty() ? std::string(name) : what));
    }
    if (!groups && !draws) return;

    Inherited from = outer;
    const std::string_view fill = style(node, "fill"), rule = style(node, "fill-rule"),
                           visibility = style(node, "visibility");
    if (!fill.empty() && fill != "inherit") from.has_area = fill != "none" && fill != "transparent";
    if (!rule.empty() && rule != "inherit") from.rule = rule == "evenodd" ? FillRule::even_odd : FillRule::nonzero;
    if (!visibility.empty() && visibility != "inherit") from.is_visible = visibility == "visible";
    const Result<Affine<2>> transform = svg::transform(node.attribute("transform").value());
    if (!transform) return fail(node, transform.problem().code, transform.problem().message);
    from.map = from.map * *transform;
    ++from.depth;
    if (draws) {
        if (from.is_visible) shape(node, name, from);
    } else if (name == "use") {
        use(node, std::move(from));
    } else if (name == "switch") {
        switch_child(node, from);
    } else if (name == "svg") {
        from.map = from.map * translation_by(lengths(node, "x", "y", from.viewport));
        const double width = length(node, "width", from.viewport.x, from.viewport.x);
        const DVec<2> size(width, length(node, "height", from.viewport.y, from.viewport.y));
        inner_svg(node, std::move(from), size);
    } else {
        group(node, std::move(from));
    }
}

void Reader::group(const xml_node& node, Inherited from) {
    if (const std::string name = name_of(node); !name.empty()) from.path += name + "/";
    children(node, from);
}

void Reader::inner_svg(const xml_node& node, Inherited from, const DVec<2>& size) {
    DVec<2> inner;
    from.map = from.map * viewport(node, size, inner);
    from.viewport = inner;
    group(node, std::move(from));
}

// https://www.w3.org/TR/SVG2/struct.html#UseElement
void Reader::use(const xml_node& node, Inherited from) {
    std::string_view target = trimmed(node.attribute("href").value());
    if (target.empty()) target = trimmed(node.attribute("xlink:href").value());
    const std::string name = name_of(node);
    const auto found = target.starts_with('#') ? ids_.find(target.substr(1)) : ids_.end();
    if (found == ids_.end())
        return left_out_.add("<use> is", "<use>s are", "left out, without a target in the file",
                             from.path + (name.empty() ? std::string(target) : name));
    if (from.depth > max_depth) return fail(node, ProblemCode::too_large, "elements are nested more than 256 deep");
    from.copied = true;
    from.map = from.map * translation_by(lengths(node, "x", "y", from.viewport));
    if (!name.empty()) from.path += name + "/";
    const xml_node shown = found->second;
    const std::string_view kind = tag(shown);
    if (kind != "symbol" && kind != "svg") return element(shown, from);
    const double width =
        length(node, "width", from.viewport.x, length(shown, "width", from.viewport.x, from.viewport.x));
    const double height =
        length(node, "height", from.viewport.y, length(shown, "height", from.viewport.y, from.viewport.y));
    inner_svg(shown, std::move(from), {width, height});
}

// Reads the first supported child of a <switch>.
void Reader::switch_child(const xml_node& node, const Inherited& from) {
    for (const xml_node& child : node.children()) {
        if (child.type() != pugi::node_element || tag(child) == "foreignObject") continue;
        if (child.attribute("requiredExtensions") || child.attribute("systemLanguage")) continue;
        return element(child, from);
    }
}

Result<PlacedShape> Reader::rectangle(const xml_node& node, const Inherited& from) {
    const DVec<2> corner = lengths(node, "x", "y", from.viewport),
                  size = lengths(node, "width", "height", from.viewport);
    // A single radius is used for both axes.
    const double rx = length(node, "rx", from.viewport.x, -1), ry = length(node, "ry", from.viewport.y, -1);
    const DVec<2> radii(rx < 0 ? std::max(ry, 0.0) : rx, ry < 0 ? std::max(rx, 0.0) : ry);
    if (!(size.x > 0 && size.y > 0)) return Problem{ProblemCode::degenerate, "without an area"};
    const Affine<2> map = from.map * translation_by(corner);
    if (from.has_area) return place_rounded_rectangle(map, size, radii, tolerance_in(map, std::max(radii.x, radii.y)));
    const std::array<DVec<2>, 4> corners{{{0, 0}, {size.x, 0}, size, {0, size.y}}};
    if (!(radii.x > 0 && radii.y > 0)) return place_polyline(map, corners, true, false);
    const DVec<2> clamped_radii(std::min(radii.x, 0.5 * size.x), std::min(radii.y, 0.5 * size.y));
    return place_polyline(
        map,
        rounded_rectangle_points(size, clamped_radii, tolerance_in(map, std::max(clamped_radii.x, clamped_radii.y))),
        true, false);
}

Result<PlacedShape> Reader::round(const xml_node& node, bool circle, const Inherited& from) {
    const DVec<2> middle = lengths(node, "cx", "cy", from.viewport);
    DVec<2> radii;
    if (circle) {
        radii = DVec<2>(length(node, "r", abut::detail::length(from.viewport) / square_root(2.0)));
    } else {
        const double rx = length(node, "rx", from.viewport.x, -1), ry = length(node, "ry", from.viewport.y, -1);
        radii = {rx < 0 ? ry : rx, ry < 0 ? rx : ry};
    }
    if (!(radii.x > 0 && radii.y > 0)) return Problem{ProblemCode::degenerate, "without an area"};
    if (from.has_area) return place_ellipse(from.map * translation_by(middle), radii);
    const Affine<2> map = from.map * translation_by(middle - radii);
    return place_polyline(
        map, rounded_rectangle_points(2.0 * radii, radii, tolerance_in(map, std::max(radii.x, radii.y))), true, false);
}

Result<PlacedShape> Reader::poly(const xml_node& node, bool closed, const Inherited& from) {
    Scanner scanner(node.attribute("points").value());
    std::vector<DVec<2>> points;
    while (!scanner.at_end()) {
        const std::optional<double> x = scanner.number(), y = x ? scanner.number() : std::nullopt;
        if (!y)
            return Problem{ProblemCode::bad_format,
                           "points: pairs of numbers were expected, syntax error at character " +
                               std::to_string(scanner.position() + 1)};
        points.emplace_back(*x, *y);
    }
    return place_polyline(from.map, points, closed || from.has_area, from.has_area);
}

Result<PlacedShape> Reader::path(const xml_node& node, const Inherited& from) {
    std::optional<double> tolerance;
    if (tolerance_) tolerance = tolerance_in(from.map, 0);
    const Result<std::vector<svg::Subpath>> subpaths = svg::flatten_path(node.attribute("d").value(), tolerance);
    if (!subpaths) return subpaths.problem();
    std::vector<PlacedShape> lines;
    for (const svg::Subpath& subpath : *subpaths) {
        Result<PlacedShape> line = place_polyline(from.map, subpath.points, subpath.closed || from.has_area,
                                                  from.has_area && subpaths->size() == 1);
        if (line)
            lines.push_back(*std::move(line));
        else if (line.problem().code != ProblemCode::degenerate)
            return line.problem();
    }
    if (lines.empty()) return Problem{ProblemCode::degenerate, "a path without length"};
    if (subpaths->size() == 1) return lines.front();
    Outlines outlines;
    outlines.rule = from.has_area ? from.rule : FillRule::none;
    for (PlacedShape& line : lines) outlines.chains.push_back(std::get<Chain>(std::move(line.shape)));
    return PlacedShape{std::move(outlines), {}, from.has_area};
}

void Reader::shape(const xml_node& node, std::string_view kind, const Inherited& from) {
    const auto placed = [&]() -> Result<PlacedShape> {
        if (kind == "rect") return rectangle(node, from);
        if (kind == "circle" || kind == "ellipse") return round(node, kind == "circle", from);
        if (kind == "polygon" || kind == "polyline") return poly(node, kind == "polygon", from);
        if (kind == "path") return path(node, from);
        const DVec<2> ends[] = {lengths(node, "x1", "y1", from.viewport), lengths(node, "x2", "y2", from.viewport)};
        return place_polyline(from.map, ends, false, false);
    };
    Result<PlacedShape> result = placed();
    if (problem_) return;
    LevelObject object;
    object.name = name_of(node);
    if (object.name.empty()) object.name = std::string(kind);
    object.path = from.path + object.name;
    if (!result && result.problem().code == ProblemCode::degenerate)
        return left_out_.add("shape is", "shapes are", "left out, without extent", object.path);
    if (!result) return fail(node, result.problem().code, "'" + object.path + "': " + result.problem().message);
    object.type = node.attribute("class").value();
    object.shape = std::move(result->shape);
    object.pose = result->pose;
    object.filled = result->filled;
    level_.objects.push_back(std::move(object));
}

Result<Level> Reader::read() {
    const xml_node root = xml_.root();
    if (tag(root) != "svg")
        return Problem{ProblemCode::bad_format,
                       "not an SVG drawing: its outermost element is <" + std::string(root.name()) + ">"};
    find_ids();
    Inherited from;
    from.viewport = {length(root, "width", 100, 100), length(root, "height", 100, 100)};
    DVec<2> inner;
    viewport(root, from.viewport, inner);
    from.viewport = inner;
    const std::string_view fill = style(root, "fill");
    from.has_area = fill != "none";
    children(root, from);
    if (problem_) return *problem_;
    level_.warnings = left_out_.lines();
    return std::move(level_);
}

}  // namespace

Result<Level> read_svg(std::span<const std::byte> bytes, std::optional<double> tolerance) {
    const Result<std::unique_ptr<Xml>> xml = Xml::parse(bytes);
    if (!xml) return xml.problem();
    Result<Level> level = Reader(**xml, tolerance).read();
    if (!level) return level;
    return finish_level(*std::move(level));
}

}  // namespace abut::detail
