#include <abut/io/write_mesh.hpp>
#include <abut/io/write_obj.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

namespace abut {
namespace {

template <class Number>
void add(std::string& text, Number number) {
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text += ' ';
    text.append(digits.data(), end);
}

std::string one_word(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
    return name.empty() ? "part" : name;
}

}  // namespace

Result<std::string> write_obj(std::span<const Geometry> meshes) {
    if (std::optional<Problem> problem = detail::problem_of(meshes)) return *std::move(problem);
    std::string text = "# obj, written by abut\n";
    std::size_t first = 1;
    for (const Geometry& mesh : meshes) {
        text += "o " + one_word(mesh.name) + "\n";
        for (const Vec3& point : mesh.points) {
            text += 'v';
            for (int i = 0; i < 3; ++i) add(text, point[i]);
            text += '\n';
        }
        for (const glm::uvec3& triangle : mesh.triangles) {
            text += 'f';
            for (int i = 0; i < 3; ++i) add(text, first + triangle[i]);
            text += '\n';
        }
        first += mesh.points.size();
    }
    return text;
}

}  // namespace abut
