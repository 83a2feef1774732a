#include <abut/io/write_file.hpp>
#include <abut/io/write_gltf.hpp>
#include <abut/io/write_mesh.hpp>
#include <abut/io/write_obj.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace abut {
namespace {

enum class MeshFormat { none, gltf, glb, obj };

MeshFormat format_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (ending == ".gltf") return MeshFormat::gltf;
    if (ending == ".glb") return MeshFormat::glb;
    return ending == ".obj" ? MeshFormat::obj : MeshFormat::none;
}

template <class Content>
std::optional<Problem> write(const std::filesystem::path& file, const Result<Content>& content) {
    return content ? write_file(file, *content) : std::optional(content.problem());
}

}  // namespace

Geometry mesh_of(const Polyhedron& polyhedron, std::string name) {
    const std::span<const Vec3> points = polyhedron.points();
    Geometry mesh{std::move(name), {points.begin(), points.end()}, {}};
    const detail::Facets& facets = polyhedron.facets();
    for (std::size_t face = 0; face < facets.normals.size(); ++face) {
        const std::span<const std::uint32_t> loop = facets.loop(face);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) mesh.triangles.emplace_back(loop[0], loop[i], loop[i + 1]);
    }
    return mesh;
}

}  // namespace abut

namespace abut::detail {

std::optional<Problem> problem_of(std::span<const Geometry> meshes) {
    if (meshes.empty()) return Problem{ProblemCode::empty_input, "no meshes to write"};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Geometry& mesh = meshes[i];
        const auto problem = [&](ProblemCode code, const std::string& what) {
            return Problem{code, "mesh " + std::to_string(i) + (mesh.name.empty() ? "" : " '" + mesh.name + "'") + what,
                           i};
        };
        if (mesh.triangles.empty()) return problem(ProblemCode::empty_input, " has no triangles");
        if (!std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return is_finite(p); }))
            return problem(ProblemCode::not_finite, " has a point that is not finite");
        for (const glm::uvec3& t : mesh.triangles)
            if (std::max({t.x, t.y, t.z}) >= mesh.points.size())
                return problem(ProblemCode::index_out_of_range, " has a triangle with a corner that is not there");
    }
    return std::nullopt;
}

}  // namespace abut::detail

namespace abut {

bool can_write_meshes(const std::filesystem::path& file) {
    return format_of(file) != MeshFormat::none;
}

std::optional<Problem> write_meshes(const std::filesystem::path& file, std::span<const Geometry> meshes) {
    switch (format_of(file)) {
        case MeshFormat::gltf:
            return write(file, write_gltf(meshes));
        case MeshFormat::glb:
            return write(file, write_glb(meshes));
        case MeshFormat::obj:
            return write(file, write_obj(meshes));
        case MeshFormat::none:
            break;
    }
    return Problem{ProblemCode::bad_argument, "doesn't end in .gltf, .glb or .obj"};
}

}  // namespace abut
