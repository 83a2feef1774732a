# A program that replaces operator new has all memory of the core: its objects call no other allocator.
#   cmake -D nm= "-D libraries=libabut.a;..." -P one_allocator.cmake
set(others "malloc|calloc|realloc|reallocarray|aligned_alloc|posix_memalign|memalign|valloc|mmap|mmap64|strdup|strndup|free|munmap")
foreach(library IN LISTS libraries)
    execute_process(COMMAND ${nm} -A --undefined-only ${library} OUTPUT_VARIABLE symbols ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[^\n]* U (${others})(@[^\n]*)?\n" calls "${symbols}")
    if(calls)
        message(SEND_ERROR "Calls of other allocators: ${calls}")
    endif()
    string(LENGTH "${symbols}" length)
    if(length LESS 10000)
        message(SEND_ERROR "${library} has next to no undefined symbols")
    endif()
endforeach()
