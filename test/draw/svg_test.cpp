#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <cctype>
#include <limits>
#include <locale>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// Reads the subset of SVG that the library writes: tags with quoted attributes, texts without raw < > &, all closed in
/// order.
class Reader {
public:
    explicit Reader(const std::string& document) : rest_(document) {}

    bool well_formed() {
        while (!rest_.empty())
            if (!(rest_[0] == '<' ? tag() : characters())) return false;
        return open_.empty() && tags > 0;
    }

    int tags = 0;

private:
    bool skip(std::string_view what) {
        if (!rest_.starts_with(what)) return false;
        rest_.remove_prefix(what.size());
        return true;
    }
    std::string word() {
        std::string result;
        while (!rest_.empty() && (std::isalnum(static_cast<unsigned char>(rest_[0])) != 0 || rest_[0] == '-')) {
            result += rest_[0];
            rest_.remove_prefix(1);
        }
        return result;
    }
    bool characters() {
        for (; !rest_.empty() && rest_[0] != '<'; rest_.remove_prefix(1)) {
            if (rest_[0] == '>') return false;
            if (static_cast<unsigned char>(rest_[0]) < 0x20 && rest_[0] != '\n') return false;
            if (rest_[0] == '&' && !rest_.starts_with("&amp;") && !rest_.starts_with("&lt;") &&
                !rest_.starts_with("&gt;"))
                return false;
        }
        return true;
    }
    bool tag() {
        if (skip("</")) {
            if (open_.empty() || word() != open_.back()) return false;
            open_.pop_back();
            return skip(">");
        }
        skip("<");
        const std::string name = word();
        ++tags;
        std::vector<std::string> seen;
        while (skip(" ")) {
            const std::string attribute = word();
            if (attribute.empty() || std::find(seen.begin(), seen.end(), attribute) != seen.end()) return false;
            seen.push_back(attribute);
            if (!skip("=\"")) return false;
            const std::size_t end = rest_.find('"');
            if (end == std::string_view::npos || rest_.substr(0, end).find_first_of("<&") != std::string_view::npos)
                return false;
            rest_.remove_prefix(end + 1);
        }
        if (skip("/>")) return !name.empty();
        open_.push_back(name);
        return skip(">") && !name.empty();
    }

    std::string_view rest_;
    std::vector<std::string> open_;
};

/// The drawing without the frame of the document.
std::string body(const SvgCanvas& canvas) {
    const std::string document = canvas.document();
    const std::size_t begin = document.find('\n', document.find("<g")) + 1;
    return document.substr(begin, document.find("</g>") - begin);
}

TEST(Svg, IsWrittenAsExpected) {
    SvgCanvas canvas({{-1, 0}, {3, 2}}, 50, {250, 251, 252});
    canvas.line({-1, 0}, {3, 2}, {{255, 0, 16}, 1.5f});
    canvas.ball({0, 1}, 0.5f, {{0, 0, 0, 51}, 1, {1, 2, 3, 255}, true});
    const Vec2 corners[] = {{0, 0}, {1, 0}, {0, 0.125f}};
    canvas.polygon(corners, {.stroke = transparent, .fill = {16, 32, 48, 128}});
    canvas.point({1, 1}, {{1, 2, 3}});
    canvas.text({1, 1}, "here", {{1, 2, 3}});
    EXPECT_EQ(canvas.document(),
              R"(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100" viewBox="0 0 200 100">
<rect width="200" height="100" fill="#fafbfc"/>
<g stroke-linecap="round" stroke-linejoin="round" font-family="sans-serif" text-anchor="middle">
<line x1="0" y1="100" x2="200" y2="0" stroke="#ff0010" stroke-width="1.5"/>
<circle cx="50" cy="50" r="25" fill="#010203" stroke="#000000" stroke-opacity="0.2" stroke-width="1" stroke-dasharray="3"/>
<polygon points="50,100 100,100 50,93.75" fill="#102030" fill-opacity="0.5"/>
<circle cx="100" cy="50" r="3.5" fill="#010203"/>
<text x="100" y="50" dy="0.35em" font-size="14" fill="#010203">here</text>
</g>
</svg>
)");
}

TEST(Svg, WritesNumbersToAHundredthOfAPixel) {
    SvgCanvas canvas({{0, 0}, {1, 1}}, 1);
    constexpr float most = std::numeric_limits<float>::max(), nan = std::numeric_limits<float>::quiet_NaN();
    canvas.line({-0.004f, 1}, {0.05f, 1 - 12.345f}, {.stroke = transparent});
    canvas.line({-0.006f, nan}, {most, -most}, {.stroke = transparent});
    EXPECT_EQ(body(canvas),
              "<line x1=\"0\" y1=\"0\" x2=\"0.05\" y2=\"12.35\"/>\n"
              "<line x1=\"-0.01\" y1=\"0\" x2=\"1000000000\" y2=\"1000000000\"/>\n");
}

TEST(Svg, IsWellFormedWhateverIsWritten) {
    SvgCanvas canvas({{0, 0}, {10, 10}}, 20);
    const Style style{{1, 2, 3, 4}, 1, {5, 6, 7, 8}, true};
    draw(canvas, Circle{{3, 3}, 1}, style);
    draw(canvas, Box2{{3, 3}, {1, 2}, Turn::by(1)}, style);
    draw(canvas, HalfSpace2{{0, 1}, 2}, style);
    draw(canvas, contact(Circle{{3, 3}, 1}, Box2{{3, 3}, {1, 2}}), style);
    canvas.text({1, 1}, "a < b && \"c\" > 'd'\n\t\x01 \xc3\xa9 ]]>", style);
    const std::string document = canvas.document();
    Reader reader(document);
    EXPECT_TRUE(reader.well_formed()) << document;
    EXPECT_GE(reader.tags, 9);
    EXPECT_NE(document.find("a &lt; b &amp;&amp; \"c\" &gt; 'd'    \xc3\xa9 ]]&gt;<"), std::string::npos) << document;
}

TEST(SvgReader, FindsWhatIsMalformed) {
    for (const char* bad :
         {"", "<a>", "<a></b>", "<a b></a>", "<a b=\"c></a>", "<a b=\"1\" b=\"2\"/>", "<a>&</a>", "</a>"})
        EXPECT_FALSE(Reader(bad).well_formed()) << bad;
    EXPECT_TRUE(Reader("<a b=\"c\"><d/>&amp;</a>\n").well_formed());
}

struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(Svg, IsTheSameTwiceAndInEveryLocale) {
    const auto document = [] {
        SvgCanvas canvas({{0, 0}, {2000, 2000}}, 1.5f);
        draw(canvas, Box2{{1000, 1000}, {700, 500.3f}, Turn::by(0.3f)});
        return canvas.document();
    };
    const std::string first = document();
    EXPECT_EQ(document(), first);
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    const std::string elsewhere = document();
    std::locale::global(before);
    EXPECT_EQ(elsewhere, first);
}

}  // namespace
}  // namespace abut
