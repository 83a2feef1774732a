#include "gl_context.hpp"

#if __has_include(<EGL/egl.h>) && __has_include(<GLES3/gl3.h>) && __has_include(<dlfcn.h>)

#include <algorithm>
#include <array>
#include <utility>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>

namespace abut::test {

struct GlContext::Parts {
    GlKind kind = GlKind::es_3_0;
    void* library = nullptr;
    __eglMustCastToProperFunctionPointerType (*address)(const char*) = nullptr;
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string name;

    template <class F>
    F egl(const char* function) const {
        return reinterpret_cast<F>(dlsym(library, function));
    }
    template <class F>
    F gl(const char* function) const {
        return reinterpret_cast<F>(address(function));
    }

    ~Parts() {
        if (context != EGL_NO_CONTEXT) {
            egl<decltype(&eglMakeCurrent)>("eglMakeCurrent")(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            egl<decltype(&eglDestroyContext)>("eglDestroyContext")(display, context);
        }
        // The display stays, and with it the library and the driver, because Mesa's threads and exit handlers need
        // them. What an unloaded driver has not freed would be a leak without an owner.
    }
};

#define ABUT_EGL(name) const auto name = parts->egl<decltype(&::name)>(#name)
#define ABUT_GL(name) const auto name = parts_->gl<decltype(&::name)>(#name)

GlContext::GlContext(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
GlContext::~GlContext() = default;

const std::string& GlContext::name() const {
    return parts_->name;
}

std::unique_ptr<GlContext> GlContext::open(GlKind kind, std::string& why) {
    auto parts = std::make_unique<Parts>();
    parts->kind = kind;
    parts->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (parts->library == nullptr) {
        why = "there is no libEGL.so.1";
        return nullptr;
    }
    parts->address = parts->egl<decltype(parts->address)>("eglGetProcAddress");
    ABUT_EGL(eglInitialize);
    ABUT_EGL(eglBindAPI);
    ABUT_EGL(eglChooseConfig);
    ABUT_EGL(eglCreateContext);
    ABUT_EGL(eglMakeCurrent);
    const auto get_display = parts->gl<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr) {
        why = "this EGL has no platforms";
        return nullptr;
    }
    // Mesa draws without a screen; the driver of a graphics card may know its devices alone.
    const auto open_display = [&](EGLenum platform, void* native) {
        const EGLDisplay display = get_display(platform, native, nullptr);
        EGLint major = 0, minor = 0;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return false;
        parts->display = display;
        return true;
    };
    if (!open_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY)) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (const auto query = parts->gl<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT"); query != nullptr)
            query(static_cast<EGLint>(devices.size()), devices.data(), &count);
        const auto end = devices.begin() + count;
        if (std::none_of(devices.begin(), end,
                         [&](EGLDeviceEXT device) { return open_display(EGL_PLATFORM_DEVICE_EXT, device); })) {
            why = "this EGL can't do without a screen: no EGL_MESA_platform_surfaceless, and none of " +
                  std::to_string(count) + " devices of EGL_EXT_platform_device";
            return nullptr;
        }
    }
    const bool es = kind == GlKind::es_3_0;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                             es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
    const EGLint of_es[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    const EGLint of_core[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) ||
        !eglChooseConfig(parts->display, wanted, &config, 1, &count) || count < 1) {
        why = "this EGL has no such configuration";
        return nullptr;
    }
    parts->context = eglCreateContext(parts->display, config, EGL_NO_CONTEXT, es ? of_es : of_core);
    if (parts->context == EGL_NO_CONTEXT ||
        !eglMakeCurrent(parts->display, EGL_NO_SURFACE, EGL_NO_SURFACE, parts->context)) {
        why = "this EGL makes no such context";
        return nullptr;
    }
    const auto get_string = parts->gl<decltype(&::glGetString)>("glGetString");
    for (const GLenum what : {GLenum(GL_RENDERER), GLenum(GL_VERSION)})
        if (const GLubyte* text = get_string(what))
            parts->name += std::string(reinterpret_cast<const char*>(text)) + " ";
    return std::unique_ptr<GlContext>(new GlContext(std::move(parts)));
}

std::vector<glm::vec4> GlContext::run(std::string_view source, const GlTexture& texture,
                                      std::span<const GlUniform> uniforms, std::span<const glm::vec4> questions,
                                      std::string& log) {
    ABUT_GL(glCreateShader);
    ABUT_GL(glShaderSource);
    ABUT_GL(glCompileShader);
    ABUT_GL(glGetShaderiv);
    ABUT_GL(glGetShaderInfoLog);
    ABUT_GL(glCreateProgram);
    ABUT_GL(glAttachShader);
    ABUT_GL(glLinkProgram);
    ABUT_GL(glGetProgramiv);
    ABUT_GL(glGetProgramInfoLog);
    ABUT_GL(glUseProgram);
    ABUT_GL(glGetUniformLocation);
    ABUT_GL(glUniform1i);
    ABUT_GL(glUniform1f);
    ABUT_GL(glUniform2fv);
    ABUT_GL(glUniform3fv);
    ABUT_GL(glGenTextures);
    ABUT_GL(glBindTexture);
    ABUT_GL(glActiveTexture);
    ABUT_GL(glTexParameteri);
    ABUT_GL(glPixelStorei);
    ABUT_GL(glTexImage2D);
    ABUT_GL(glTexImage3D);
    ABUT_GL(glGenFramebuffers);
    ABUT_GL(glBindFramebuffer);
    ABUT_GL(glFramebufferTexture2D);
    ABUT_GL(glCheckFramebufferStatus);
    ABUT_GL(glGenVertexArrays);
    ABUT_GL(glBindVertexArray);
    ABUT_GL(glViewport);
    ABUT_GL(glDrawArrays);
    ABUT_GL(glReadPixels);
    ABUT_GL(glGetError);

    const std::string version = parts_->kind == GlKind::es_3_0 ? "#version 300 es\n" : "#version 330 core\n";
    const std::string corners = version +
                                "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, "
                                "0.0, 1.0); }\n";
    const std::string pixels = version + std::string(source) +
                               "\nuniform highp sampler2D questions;\nout highp vec4 result;\n"
                               "void main() { result = answer(texelFetch(questions, ivec2(gl_FragCoord.xy), 0)); }\n";
    const GLuint program = glCreateProgram();
    for (const auto& [kind, text] :
         {std::pair{GLenum(GL_VERTEX_SHADER), &corners}, {GLenum(GL_FRAGMENT_SHADER), &pixels}}) {
        const GLuint shader = glCreateShader(kind);
        const char* characters = text->c_str();
        glShaderSource(shader, 1, &characters, nullptr);
        glCompileShader(shader);
        GLint good = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
        char message[4096] = {};
        glGetShaderInfoLog(shader, sizeof message, nullptr, message);
        log += message;
        if (!good) return {};
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char message[4096] = {};
        glGetProgramInfoLog(program, sizeof message, nullptr, message);
        log += message;
        return {};
    }
    glUseProgram(program);

    GLuint textures[3] = {};
    glGenTextures(3, textures);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const auto bind = [&](int unit, GLenum target, GLuint name, GLint filter) {
        glActiveTexture(GLenum(GL_TEXTURE0 + unit));
        glBindTexture(target, name);
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
        glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
        for (const GLenum axis : {GLenum(GL_TEXTURE_WRAP_S), GLenum(GL_TEXTURE_WRAP_T), GLenum(GL_TEXTURE_WRAP_R)})
            glTexParameteri(target, axis, GL_CLAMP_TO_EDGE);
    };
    const GLenum target = texture.flat ? GL_TEXTURE_2D : GL_TEXTURE_3D;
    const auto format = GLint(texture.internal_format);
    const glm::vec<3, GLsizei> size(texture.size);
    bind(0, target, textures[0], texture.linear ? GL_LINEAR : GL_NEAREST);
    if (texture.flat)
        glTexImage2D(target, 0, format, size.x, size.y, 0, GL_RED, texture.type, texture.bytes);
    else
        glTexImage3D(target, 0, format, size.x, size.y, size.z, 0, GL_RED, texture.type, texture.bytes);

    constexpr GLsizei width = 256;
    const auto height = GLsizei((questions.size() + width - 1) / width);
    std::vector<glm::vec4> padded(questions.begin(), questions.end());
    padded.resize(std::size_t(width) * std::size_t(height), glm::vec4(0));
    bind(1, GL_TEXTURE_2D, textures[1], GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, padded.data());
    bind(2, GL_TEXTURE_2D, textures[2], GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);

    GLuint frame = 0, vertices = 0;
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[2], 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        log += "no pictures of floats (EXT_color_buffer_float)";
        return {};
    }
    glUniform1i(glGetUniformLocation(program, "abut_texture"), 0);
    glUniform1i(glGetUniformLocation(program, "questions"), 1);
    for (const GlUniform& uniform : uniforms) {
        const GLint place = glGetUniformLocation(program, uniform.name);
        if (uniform.value.size() == 1) glUniform1f(place, uniform.value[0]);
        if (uniform.value.size() == 2) glUniform2fv(place, 1, uniform.value.data());
        if (uniform.value.size() == 3) glUniform3fv(place, 1, uniform.value.data());
    }
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glViewport(0, 0, width, height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, padded.data());
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
        log += "OpenGL error " + std::to_string(error);
        return {};
    }
    padded.resize(questions.size());
    return padded;
}

}  // namespace abut::test

#else

namespace abut::test {

struct GlContext::Parts {
    std::string name;
};
GlContext::GlContext(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
GlContext::~GlContext() = default;
const std::string& GlContext::name() const {
    return parts_->name;
}
std::unique_ptr<GlContext> GlContext::open(GlKind, std::string& why) {
    why = "built without the headers of EGL and OpenGL ES 3";
    return nullptr;
}
std::vector<glm::vec4> GlContext::run(std::string_view, const GlTexture&, std::span<const GlUniform>,
                                      std::span<const glm::vec4>, std::string&) {
    return {};
}

}  // namespace abut::test

#endif
