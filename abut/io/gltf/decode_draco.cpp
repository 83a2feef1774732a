#include <abut/io/gltf/decompress.hpp>
#include <abut/math/detail/no_index.hpp>

#include <array>
#include <memory>
#include <string>
#include <utility>

#ifdef ABUT_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

namespace abut::gltf {

#ifdef ABUT_HAS_DRACO

namespace {

Problem draco_problem(const std::string& what) {
    return {ProblemCode::bad_format, "Draco: " + what};
}

template <class Number>
void append(const draco::PointAttribute& attribute, draco::PointIndex point, std::uint32_t components,
            std::vector<double>& to) {
    std::array<Number, 4> values{};
    attribute.ConvertValue(attribute.mapped_index(point), static_cast<std::int8_t>(components), values.data());
    for (std::uint32_t i = 0; i < components; ++i) to.push_back(static_cast<double>(values[i]));
}

Result<std::vector<double>> numbers_of(const draco::Mesh& mesh, const DracoAttribute& wanted) {
    std::vector<double> result;
    if (wanted.id == detail::no_index) return result;
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (attribute == nullptr) return draco_problem("there is no attribute " + std::to_string(wanted.id));
    if (attribute->num_components() != static_cast<int>(wanted.components))
        return draco_problem("attribute " + std::to_string(wanted.id) + " has another number of components");
    result.reserve(wanted.components * mesh.num_points());
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        if (attribute->data_type() == draco::DT_FLOAT32 || wanted.is_normalized)
            append<float>(*attribute, i, wanted.components, result);
        else
            append<std::int32_t>(*attribute, i, wanted.components, result);
    }
    return result;
}

}  // namespace

Result<DracoMesh> decode_draco(std::span<const std::byte> bytes, std::span<const DracoAttribute> attributes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return draco_problem(decoded.status().error_msg_string());
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    DracoMesh result;
    for (draco::FaceIndex i(0); i < mesh->num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh->face(i);
        result.triangles.emplace_back(face[0].value(), face[1].value(), face[2].value());
    }
    for (const DracoAttribute& attribute : attributes) {
        Result<std::vector<double>> numbers = numbers_of(*mesh, attribute);
        if (!numbers) return numbers.problem();
        result.attributes.push_back(*std::move(numbers));
    }
    return result;
}

#else

Result<DracoMesh> decode_draco(std::span<const std::byte>, std::span<const DracoAttribute>) {
    return Problem{ProblemCode::bad_format, "is compressed with Draco, and this abut was built without it"};
}

#endif

}  // namespace abut::gltf
