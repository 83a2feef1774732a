#pragma once

// A graphics context without a screen, to run shaders in tests: EGL on Mesa's software renderer or another driver. It
// is loaded at run time, so nothing has to be linked.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_uint3.hpp>

namespace abut::test {

enum class GlKind : std::uint8_t {
    es_3_0,    ///< OpenGL ES 3.0, which WebGL 2 is made of: #version 300 es
    core_3_3,  ///< OpenGL 3.3 core: #version 330 core
};

/// The data of a `GL_TEXTURE_2D` or `GL_TEXTURE_3D` of one channel.
struct GlTexture {
    std::uint32_t internal_format = 0, type = 0;
    glm::uvec3 size{1};
    bool flat = false;  ///< a texture of two dimensions
    bool linear = false;
    const void* bytes = nullptr;
};

/// A uniform of as many floats as it has values.
struct GlUniform {
    const char* name = "";
    std::vector<float> value;
};

class GlContext {
public:
    /// Null if there is none; then `why` is set.
    static std::unique_ptr<GlContext> open(GlKind kind, std::string& why);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Runs `vec4 answer(vec4 question)` of the source, which has neither #version nor main, for each question. The
    /// texture is `abut_texture`. The result is empty if the shader doesn't compile; then `log` has the message.
    std::vector<glm::vec4> run(std::string_view source, const GlTexture& texture, std::span<const GlUniform> uniforms,
                               std::span<const glm::vec4> questions, std::string& log);

    /// The name of the renderer.
    const std::string& name() const;

private:
    struct Parts;
    explicit GlContext(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace abut::test
