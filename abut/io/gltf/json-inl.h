#pragma once

// Reads fields of a glTF file's JSON. Included by the files of this folder that parse JSON.

#include <abut/math/detail/no_index.hpp>
#include <abut/math/result.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace abut::gltf {

using Json = nlohmann::json;

/// The array element that a message refers to.
struct Where {
    const char* array;
    std::size_t index;
};

inline std::string text(const Where& where) {
    return std::string(where.array) + "[" + std::to_string(where.index) + "]";
}

inline const Json* member(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// Names only serve people, so a name of the wrong type is ignored.
inline std::string name_in(const Json& object) {
    const Json* name = member(object, "name");
    return name != nullptr && name->is_string() ? name->get<std::string>() : std::string();
}

/// The extension of this name in an object of the file; null if there is none.
inline const Json* extension(const Json& object, const char* name) {
    const Json* extensions = member(object, "extensions");
    return extensions == nullptr ? nullptr : member(*extensions, name);
}

/// Reads fields and records the first error. Invalid values are replaced by defaults.
class FieldReader {
public:
    explicit FieldReader(const Json& root) : root_(root) {}

protected:
    void fail(ProblemCode code, std::string message) {
        if (!problem_) problem_ = Problem{code, std::move(message)};
    }
    void fail(const Where& where, const char* key, const char* what) {
        fail(ProblemCode::bad_format, text(where) + "." + key + ": " + what);
    }

    std::size_t count(const char* array) const {
        const Json* found = member(root_, array);
        return found == nullptr ? 0 : found->size();
    }
    /// Visits the objects of an array of the root.
    template <class Visit>
    void each(const char* array, Visit visit) {
        each_of(root_, array, visit);
    }
    /// Visits the objects of an array of any object.
    template <class Visit>
    void each_of(const Json& object, const char* array, Visit visit) {
        const Json* found = member(object, array);
        if (found == nullptr) return;
        if (!found->is_array()) return fail(ProblemCode::bad_format, std::string(array) + ": an array was expected");
        std::size_t i = 0;
        for (const Json& element : *found) {
            if (!element.is_object())
                return fail(ProblemCode::bad_format, text({array, i}) + ": an object was expected");
            visit(element, Where{array, i++});
        }
    }
    /// Visits the elements of an array, of any type.
    template <class Visit>
    void each_member(const Json& object, const char* key, const Where& where, Visit visit) {
        const Json* found = member(object, key);
        if (found == nullptr) return;
        if (!found->is_array()) return fail(where, key, "an array was expected");
        for (const Json& element : *found) visit(element);
    }

    /// Accepts 3.0 for 3: some exporters write integers as floats.
    static std::optional<std::uint64_t> unsigned_integer(const Json& value) {
        if (value.is_number_unsigned()) return value.get<std::uint64_t>();
        if (!value.is_number_float()) return std::nullopt;
        const double number = value.get<double>();
        constexpr double max_exact = 9007199254740992.0;  // 2^53: larger integers are not all representable
        if (!(number >= 0 && number <= max_exact && number == std::floor(number))) return std::nullopt;
        return static_cast<std::uint64_t>(number);
    }
    std::uint64_t unsigned_integer(const Json& object, const char* key, std::uint64_t default_value,
                                   const Where& where) {
        const Json* value = member(object, key);
        if (value == nullptr) return default_value;
        const std::optional<std::uint64_t> number = unsigned_integer(*value);
        if (!number) fail(where, key, "a whole number was expected");
        return number.value_or(default_value);
    }
    std::uint32_t type_number(const Json& object, const char* key, std::uint32_t default_value, const Where& where) {
        const std::uint64_t number = unsigned_integer(object, key, default_value, where);
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(number, detail::no_index));
    }

    std::uint32_t index(const Json& value, std::size_t size, const Where& where, const char* key) {
        const std::optional<std::uint64_t> number = unsigned_integer(value);
        if (!number) {
            fail(where, key, "a whole number was expected");
        } else if (*number >= size) {
            fail(ProblemCode::index_out_of_range, text(where) + "." + key + ": index " + std::to_string(*number) +
                                                      " is out of range (" + std::to_string(size) + " exist)");
        } else {
            return static_cast<std::uint32_t>(*number);
        }
        return detail::no_index;
    }
    /// An index into an array of the root; `no_index` if the key is missing.
    std::uint32_t index(const Json& object, const char* key, const char* array, const Where& where) {
        return index(object, key, count(array), where);
    }
    std::uint32_t index(const Json& object, const char* key, std::size_t size, const Where& where) {
        const Json* value = member(object, key);
        return value == nullptr ? detail::no_index : index(*value, size, where, key);
    }

    double number(const Json& object, const char* key, double default_value, const Where& where) {
        const Json* value = member(object, key);
        if (value == nullptr) return default_value;
        if (value->is_number()) return value->get<double>();
        fail(where, key, "a number was expected");
        return default_value;
    }
    template <int N>
    bool numbers(const Json& object, const char* key, double (&out)[N], const Where& where) {
        const Json* value = member(object, key);
        if (value == nullptr) return false;
        if (!value->is_array() || value->size() != N) {
            fail(where, key, "an array of numbers was expected, of another length");
            return false;
        }
        std::size_t i = 0;
        for (const Json& element : *value) {
            if (!element.is_number()) {
                fail(where, key, "a number was expected");
                return false;
            }
            out[i++] = element.get<double>();
        }
        return true;
    }

    const Json& root_;
    std::optional<Problem> problem_;
};

}  // namespace abut::gltf
