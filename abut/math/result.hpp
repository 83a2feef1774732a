#pragma once

// The result of a builder that takes outside data: a value or a Problem.

#include <abut/math/assert.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace abut {

enum class ProblemCode : std::uint8_t {
    empty_input,         ///< nothing to build from
    not_finite,          ///< a coordinate is NaN or infinite
    index_out_of_range,  ///< an index names nothing
    degenerate,          ///< a piece without extent where one is needed, such as a triangle of zero area
    bad_argument,        ///< a number outside its limits
    not_found,           ///< no such file
    unreadable,          ///< it is there and can't be read
    bad_format,          ///< it was read and isn't what it claims to be
    too_large,           ///< over a stated limit
    cancelled,           ///< the caller asked to stop
};

/// An error: a code, a message, and an index into the input.
struct Problem {
    ProblemCode code = ProblemCode::bad_argument;
    std::string message;    ///< one line for a person, without a full stop
    std::size_t index = 0;  ///< index of the offending input item, if there is one
};

/// A value or a Problem; never throws.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Problem problem) : state_(std::in_place_index<1>, std::move(problem)) {}

    explicit operator bool() const { return state_.index() == 0; }

    T& operator*() & { return value(); }
    const T& operator*() const& { return const_cast<Result*>(this)->value(); }
    T&& operator*() && { return std::move(value()); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &const_cast<Result*>(this)->value(); }

    /// The Problem; only if there is no value.
    const Problem& problem() const {
        const Problem* result = std::get_if<1>(&state_);
        ABUT_ASSERT(result != nullptr);
        return *result;
    }

private:
    T& value() {
        T* result = std::get_if<0>(&state_);
        ABUT_ASSERT(result != nullptr);
        return *result;
    }

    std::variant<T, Problem> state_;
};

}  // namespace abut
