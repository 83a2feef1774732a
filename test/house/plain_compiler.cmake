# The core needs neither CMake, exceptions nor type information: the line of docs/packages.md compiles the consumer with all
# sources of the core, without the two. It takes minutes: only where ABUT_LONG is set in the environment. Otherwise the headers
# alone are compiled so.
#   cmake -D compiler= -D source=PROJECT -D folder= -D libraries=highway -D here= -P plain_compiler.cmake
set(flags -std=c++20 -ffp-contract=off -fno-exceptions -fno-rtti -I ${source})
set(consumer ${source}/test/house/consumer/main.cpp)
if(NOT DEFINED ENV{ABUT_LONG})
    execute_process(COMMAND ${compiler} ${flags} -fsyntax-only ${consumer} COMMAND_ERROR_IS_FATAL ANY)
    return()
endif()
file(GLOB_RECURSE sources ${source}/abut/*.cpp)
list(FILTER sources INCLUDE REGEX "${source}/abut/(math|broad_phase|convex|shape|query|motion|field|walk|world)/")
list(LENGTH sources count)
if(count LESS 200)
    message(FATAL_ERROR "only ${count} sources of the core are found")
endif()
string(TIMESTAMP begin %s)
execute_process(COMMAND ${compiler} -O0 ${flags} ${consumer} ${sources} ${libraries} -pthread -o ${folder}/plain_compiler
    COMMAND_ERROR_IS_FATAL ANY)
string(TIMESTAMP end %s)
math(EXPR seconds "${end} - ${begin}")
execute_process(COMMAND ${folder}/plain_compiler OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${here} OUTPUT_VARIABLE answers COMMAND_ERROR_IS_FATAL ANY)
if(NOT output STREQUAL answers)
    message(FATAL_ERROR "by the compiler alone:\n${output}\nby CMake:\n${answers}")
endif()
message(STATUS "${count} sources in ${seconds} s")
