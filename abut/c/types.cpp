// Values, buffers and threads of the C API, and its last error.

#include <abut/c/detail/handles.hpp>

#include <cstdio>
#include <limits>

namespace {

constexpr std::size_t message_capacity = 256;
thread_local char last_message[message_capacity] = "";
thread_local std::uint32_t last_index = 0;

}  // namespace

namespace abut::detail {

abut_code report(const Fault& fault) {
    const bool has_index = fault.index != Fault::no_index;
    last_index = has_index ? static_cast<std::uint32_t>(fault.index) : 0;
    if (has_index)
        std::snprintf(last_message, message_capacity, "%s[%zu] %s", fault.argument, fault.index, fault.what);
    else
        std::snprintf(last_message, message_capacity, "%s %s", fault.argument, fault.what);
    return fault.code;
}

abut_code report(const Problem& problem) {
    last_index = static_cast<std::uint32_t>(problem.index);
    std::snprintf(last_message, message_capacity, "%s", problem.message.c_str());
    static_assert(static_cast<int>(ProblemCode::empty_input) + 1 == ABUT_EMPTY_INPUT &&
                  static_cast<int>(ProblemCode::cancelled) + 1 == ABUT_CANCELLED);
    return static_cast<abut_code>(static_cast<int>(problem.code) + 1);
}

}  // namespace abut::detail

using namespace abut::detail;

const char* abut_last_error(void) {
    return last_message;
}

uint32_t abut_last_error_index(void) {
    return last_index;
}

const char* abut_version(void) {
    return ABUT_VERSION;
}

abut_code abut_turn_by(float radians, abut_turn* out) {
    return entry({present(out, "out"), finite(radians, "radians")},
                 [&] { *out = same_bytes<abut_turn>(abut::Turn::by(radians)); });
}

abut_code abut_turn_about(abut_vec3 axis, float radians, abut_quat* out) {
    return entry({present(out, "out"), finite(axis, "axis"), finite(radians, "radians")},
                 [&] { *out = same_bytes<abut_quat>(abut::turn_about(same_bytes<abut::Vec3>(axis), radians)); });
}

#define ABUT_C_ENTRIES(D)                                                                                        \
    abut_code abut_ray##D##_between(abut_vec##D a, abut_vec##D b, abut_ray##D* out) {                            \
        return entry({present(out, "out"), finite(a, "a"), finite(b, "b")}, [&] {                                \
            using V = abut::Vec<D>;                                                                              \
            *out = same_bytes<abut_ray##D>(abut::Ray<D>::between(same_bytes<V>(a), same_bytes<V>(b)));           \
        });                                                                                                      \
    }                                                                                                            \
    abut_code abut_motion##D##_between(abut_pose##D from, abut_pose##D to, abut_motion##D* out) {                \
        return entry({present(out, "out"), finite(from, "from"), finite(to, "to")}, [&] {                        \
            using P = abut::Pose<D>;                                                                             \
            *out = same_bytes<abut_motion##D>(abut::Motion<D>::between(same_bytes<P>(from), same_bytes<P>(to))); \
        });                                                                                                      \
    }                                                                                                            \
    abut_code abut_motion##D##_pose_at(abut_motion##D motion, float fraction, abut_pose##D* out) {               \
        return entry({present(out, "out"), finite(motion, "motion"), finite(fraction, "fraction")}, [&] {        \
            *out = same_bytes<abut_pose##D>(pose_at(same_bytes<abut::Motion<D>>(motion), fraction));             \
        });                                                                                                      \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES

abut_code abut_buffer_create(abut_buffer** out) {
    return entry({present(out, "out")}, [&] { *out = new abut_buffer(); });
}

const uint8_t* abut_buffer_data(const abut_buffer* buffer) {
    if (present(buffer, "buffer").code != ABUT_OK || buffer->bytes.empty()) return nullptr;
    return reinterpret_cast<const uint8_t*>(buffer->bytes.data());
}

size_t abut_buffer_size(const abut_buffer* buffer) {
    return present(buffer, "buffer").code != ABUT_OK ? 0 : buffer->bytes.size();
}

void abut_buffer_release(abut_buffer* buffer) {
    release(buffer);
}

abut_code abut_thread_pool_create(uint32_t workers, abut_thread_pool** out) {
    return entry({present(out, "out")}, [&] { *out = new abut_thread_pool(workers); });
}

void abut_thread_pool_release(abut_thread_pool* pool) {
    release(pool);
}
