// The page of `abut check --report`; play/viewer/test opens it in a browser.

#include "tool/page/page_mesh.hpp"
#include "tool/page/report_template.hpp"
#include "tool_runs.hpp"
#include <abut/io/file/base64.hpp>

#include <cstring>

namespace abut {
namespace {

using test::Json;
using test::Ran;

class Page : public test::ToolRuns {
protected:
    void SetUp() override {
        if (tool::report_template.empty()) GTEST_SKIP() << "built without npm";
    }

    /// Boxes with edges of length 1 along x.
    std::string boxes(const std::vector<std::pair<std::string, float>>& named) const {
        test::GltfBuilder builder;
        const int mesh = builder.add_mesh("Box", test::box_triangles({0.5f, 0.5f, 0.5f}));
        for (const auto& [name, x] : named) builder.add_node(name, mesh, {x, 0, 0});
        return write("boxes.gltf", builder.text()).string();
    }

    /// The data of the page of a scene.
    Json data_of(const std::string& scene, int code) const {
        const Ran ran = run({"check", scene, "--report", out("out.html")});
        EXPECT_EQ(ran.code, code) << ran.err;
        return data_in(content(out("out.html")));
    }
    static Json data_in(const std::string& page) {
        const std::string start = "<script type=\"application/json\" id=\"report\">";
        const std::size_t begin = page.find(start) + start.size(), end = page.find("</script>", begin);
        return Json::parse(page.substr(begin, end - begin));
    }
};

template <class Number>
std::vector<Number> numbers_of(const Json& base64) {
    const auto bytes = detail::decode_base64(base64.get<std::string>());
    std::vector<Number> result(bytes->size() / sizeof(Number));
    std::memcpy(result.data(), bytes->data(), bytes->size());
    return result;
}

TEST_F(Page, ShowsEachFindingInItsPlace) {
    const Json data = data_of(boxes({{"A", 0}, {"B", 0.75f}, {"C", 5}}), 1);
    EXPECT_EQ(data["dimension"], 3);
    EXPECT_FALSE(data["clean"]);
    ASSERT_EQ(data["findings"].size(), 1u);
    const Json& finding = data["findings"][0];
    EXPECT_EQ(finding["code"], "ABUT101");
    EXPECT_EQ(finding["kind"], "contact");
    EXPECT_EQ(finding["severity"], "error");
    EXPECT_EQ(finding["depth"], 0.25);
    EXPECT_EQ(finding["normal"], Json({1.0, 0.0, 0.0}));
    EXPECT_EQ(finding["points"].size(), 4u);
    ASSERT_EQ(finding["parties"].size(), 2u);
    const Json& a = data["objects"][finding["parties"][0][0].get<std::size_t>()];
    const Json& b = data["objects"][finding["parties"][1][0].get<std::size_t>()];
    EXPECT_EQ(a["name"], "A");
    EXPECT_EQ(b["name"], "B");
    EXPECT_EQ(b["box"], Json({0.25, -0.5, -0.5, 1.25, 0.5, 0.5}));
    EXPECT_EQ(numbers_of<std::uint32_t>(b["mesh"]["elements"]).size(), 36u);
    EXPECT_EQ(numbers_of<std::uint16_t>(b["mesh"]["points"]).size(), 24u);
    const std::vector<float> pose = numbers_of<float>(b["poses"]);
    ASSERT_EQ(pose.size(), 12u);
    EXPECT_EQ(pose[9], 0.75f);
    // The link stays when something else is found too.
    const Json more = data_of(boxes({{"0", -0.5f}, {"A", 0}, {"B", 0.75f}}), 1);
    bool is_there = false;
    for (const Json& other : more["findings"]) is_there = is_there || other["id"] == finding["id"];
    EXPECT_TRUE(is_there);
}

TEST_F(Page, NamesAreText) {
    const std::string evil = "</script><script>alert(1)</script>";
    const Json data = data_of(boxes({{evil, 0}, {"@TITLE@ <!--", 0.75f}}), 1);
    const std::string page = content(out("out.html"));
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    EXPECT_EQ(page.find("<!--"), std::string::npos);
    EXPECT_NE(data["findings"][0]["title"].get<std::string>().find("<script>alert"), std::string::npos);
}

TEST_F(Page, LargeMeshesAreCutDownToTheFindings) {
    tool::Facets<3> shape;
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const auto x = static_cast<float>(i);
        points.insert(points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        shape.facets.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    shape.points = points;
    const std::vector<std::uint32_t> nearest = tool::nearest_facets(shape, {{50.5f, 0.5f, 0}}, 3);
    EXPECT_EQ(nearest, (std::vector<std::uint32_t>{49, 50, 51}));
    const tool::Json mesh = tool::mesh_json(shape, nearest);
    EXPECT_EQ(mesh["partial"], true);
    EXPECT_EQ(mesh["low"], tool::Json({49.0, 0.0, 0.0}));
    EXPECT_EQ(tool::nearest_facets(shape, {}, 100).size(), 100u);
}

TEST_F(Page, PicturesAndRefusals) {
    const std::string file = boxes({{"A", 0}, {"B", 0.75f}});
    EXPECT_EQ(run({"check", file, "--svg", out("out.svg")}).code, 1);
    const std::string picture = content(out("out.svg"));
    EXPECT_TRUE(picture.starts_with("<svg ")) << picture.substr(0, 80);
    EXPECT_NE(picture.find("ABUT101"), std::string::npos);
    EXPECT_EQ(refusal({"check", file, file, "--report", out("two.html")}),
              "abut: --report takes one scene, and here are 2");
    EXPECT_FALSE(std::filesystem::exists(out("two.html")));
    const Ran unwritten = run({"check", file, "--report", out("no/folder.html")});
    EXPECT_EQ(unwritten.code, 2);
}

}  // namespace
}  // namespace abut
