#pragma once

// A non-owning reference to a callable: two pointers, no allocation. It passes visitors into .cpp files.

#include <abut/math/simd/upper_halves.hpp>

#include <memory>
#include <type_traits>
#include <utility>

namespace abut {

template <class Signature>
class FunctionRef;

/// Refers to the callable it was made from and must not outlive it.
template <class R, class... Arguments>
class FunctionRef<R(Arguments...)> {
public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef> && std::is_invocable_r_v<R, F&, Arguments...>)
        FunctionRef(F&& f)
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
          call_([](void* object, Arguments... arguments) -> R {
              auto& callable = *static_cast<std::remove_reference_t<F>*>(object);
              if constexpr (std::is_void_v<R>) {
                  callable(std::forward<Arguments>(arguments)...);
                  detail::clear_upper_halves();
              } else if constexpr (std::is_reference_v<R>) {
                  return callable(std::forward<Arguments>(arguments)...);
              } else {
                  R result = callable(std::forward<Arguments>(arguments)...);
                  detail::clear_upper_halves();
                  return result;
              }
          }) {}

    R operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

private:
    void* object_;
    R (*call_)(void*, Arguments...);
};

}  // namespace abut
