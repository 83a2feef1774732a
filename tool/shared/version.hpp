#pragma once

namespace abut::tool {

/// The version of the tool: "1.2.3".
const char* version();

}  // namespace abut::tool
