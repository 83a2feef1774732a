#include <abut/draw/svg.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

/// Two decimals without trailing zeros. Streams and printf depend on the locale.
std::string number(double value) {
    constexpr double max_number = 1e9;
    const long long hundredths = std::isnan(value) ? 0 : std::llround(std::clamp(value, -max_number, max_number) * 100);
    const long long size = hundredths < 0 ? -hundredths : hundredths;
    std::string result(hundredths < 0 ? "-" : "");
    result += std::to_string(size / 100);
    if (size % 100 == 0) return result;
    result += '.';
    result += static_cast<char>('0' + size / 10 % 10);
    if (size % 10 != 0) result += static_cast<char>('0' + size % 10);
    return result;
}
std::string number(float value) {
    return number(static_cast<double>(value));
}

std::string hexadecimal(const Color& color) {
    constexpr char digits[] = "0123456789abcdef";
    std::string result = "#";
    for (const std::uint8_t part : {color.red, color.green, color.blue}) {
        result += digits[part / 16];
        result += digits[part % 16];
    }
    return result;
}

/// Writes a tag at the end of a document.
class Tag {
public:
    Tag(std::string& out, std::string_view name) : out_(out) { (out_ += '<') += name; }

    Tag& set(std::string_view name, std::string_view value) {
        (((out_ += ' ') += name) += "=\"") += value;
        out_ += '"';
        return *this;
    }
    Tag& paint(std::string_view name, const Color& color) {
        if (!color.visible()) return set(name, "none");
        set(name, hexadecimal(color));
        if (color.alpha == 255) return *this;
        return set(std::string(name).append("-opacity"), number(static_cast<double>(color.alpha) / 255));
    }
    Tag& stroke(const Style& style) {
        if (!style.stroke.visible()) return *this;
        paint("stroke", style.stroke).set("stroke-width", number(style.width));
        return style.dashed ? set("stroke-dasharray", number(3 * style.width)) : *this;
    }

    void empty() { out_ += "/>\n"; }
    void open() { out_ += ">\n"; }
    /// Escapes characters that XML reserves, and replaces those that it forbids.
    void text(std::string_view text, std::string_view name) {
        out_ += '>';
        for (const char c : text) {
            if (c == '&')
                out_ += "&amp;";
            else if (c == '<')
                out_ += "&lt;";
            else if (c == '>')
                out_ += "&gt;";
            else
                out_ += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
        ((out_ += "</") += name) += ">\n";
    }

private:
    std::string& out_;
};

}  // namespace

SvgCanvas::SvgCanvas(const Aabb2& shown, float pixels_a_unit, Color background)
    : shown_(shown), scale_(static_cast<double>(pixels_a_unit)), background_(background) {}

std::string SvgCanvas::x(const Vec2& position) const {
    return number((static_cast<double>(position.x) - static_cast<double>(shown_.min.x)) * scale_);
}
std::string SvgCanvas::y(const Vec2& position) const {
    return number((static_cast<double>(shown_.max.y) - static_cast<double>(position.y)) * scale_);
}

void SvgCanvas::line(const Vec2& a, const Vec2& b, const Style& style) {
    Tag(body_, "line").set("x1", x(a)).set("y1", y(a)).set("x2", x(b)).set("y2", y(b)).stroke(style).empty();
}

void SvgCanvas::point(const Vec2& position, const Style& style) {
    Tag tag(body_, "circle");
    tag.set("cx", x(position)).set("cy", y(position)).set("r", number(0.5f * point_size_));
    tag.paint("fill", style.stroke).empty();
}

void SvgCanvas::polygon(std::span<const Vec2> points, const Style& style) {
    std::string list;
    for (const Vec2& point : points) {
        if (!list.empty()) list += ' ';
        ((list += x(point)) += ',') += y(point);
    }
    Tag(body_, "polygon").set("points", list).paint("fill", style.fill).stroke(style).empty();
}

void SvgCanvas::ball(const Vec2& center, float radius, const Style& style) {
    Tag tag(body_, "circle");
    tag.set("cx", x(center)).set("cy", y(center)).set("r", number(static_cast<double>(radius) * scale_));
    tag.paint("fill", style.fill).stroke(style).empty();
}

void SvgCanvas::text(const Vec2& position, std::string_view text, const Style& style) {
    Tag tag(body_, "text");
    tag.set("x", x(position)).set("y", y(position)).set("dy", "0.35em").set("font-size", number(text_height_));
    tag.paint("fill", style.stroke).text(text, "text");
}

std::string SvgCanvas::document() const {
    const std::string width = x(shown_.max), height = y(shown_.min);
    std::string result;
    Tag svg(result, "svg");
    svg.set("xmlns", "http://www.w3.org/2000/svg").set("width", width).set("height", height);
    svg.set("viewBox", std::string("0 0 ").append(width).append(" ").append(height)).open();
    if (background_.visible())
        Tag(result, "rect").set("width", width).set("height", height).paint("fill", background_).empty();
    Tag group(result, "g");
    group.set("stroke-linecap", "round").set("stroke-linejoin", "round");
    group.set("font-family", "sans-serif").set("text-anchor", "middle").open();
    return result.append(body_).append("</g>\n</svg>\n");
}

}  // namespace abut
