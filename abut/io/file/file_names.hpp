#pragma once

// Names by which a scene or level refers to other files, and what their text alone decides.

#include <abut/math/result.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace abut::detail {

/// True if the Problem reports a name outside of the folder.
bool is_outside(const Problem& problem);
/// The Problem for a name outside of the folder.
Problem outside_problem();

/// Checks the text of a name only, without the file system. Returns a Problem if the name is empty, has a scheme other
/// than "file", or is outside of the folder and that is not allowed.
std::optional<Problem> check_name(std::string_view name, bool allow_outside);

/// The name in single quotes for a message, cut after 200 characters.
std::string quoted_name(std::string_view name);

/// The path that a name stands for: that of a "file" URI, whose host is ignored, and else the name itself.
std::string_view path_named(std::string_view name);

}  // namespace abut::detail
