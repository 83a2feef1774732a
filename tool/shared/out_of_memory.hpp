#pragma once

// Handling of failed allocations.

#include <string>

namespace abut::tool {

/// Makes the program exit with code 2 and this line on stderr if an allocation fails, on any thread and inside noexcept
/// functions.
/// Control characters in the line are replaced by blanks.
void exit_when_out_of_memory(const std::string& line);

/// Restores std::bad_alloc, for a child process that reports the failure otherwise.
void throw_when_out_of_memory();

}  // namespace abut::tool
