#pragma once

// Post-processing shared by all level readers, and warnings for whatever they leave out.

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace abut::detail {

/// Collects warnings: one line for each kind of thing left out, with the count and the path of the first one.
class LeftOut {
public:
    /// `one` and `many` are the singular and the plural that begin the line: "text object is", "text objects are".
    void add(const char* one, const char* many, const char* what, const std::string& such_as);
    std::vector<std::string> lines() const;

private:
    struct Kind {
        const char *one, *many, *what;
        std::size_t count = 0;
        std::string first;
    };
    std::vector<Kind> kinds_;
};

/// Makes the paths of all objects and points unique ("Crate", "Crate#2"). Returns a Problem (`empty_input`) for a level
/// without any.
Result<Level> finish_level(Level level);

}  // namespace abut::detail
