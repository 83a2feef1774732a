#pragma once

#include <string_view>

namespace abut::tool {

/// The page of `abut check --report` without its data; empty in builds without npm. It has the places @TITLE@ and
/// @REPORT@.
extern const std::string_view report_template;

}  // namespace abut::tool
