# gdb prints the values of main.cpp as packaging/debug/abut_gdb.py says.
#   cmake -D gdb= -D program= -D printers=abut_gdb.py -P expected.cmake
set(names vec3 vec2 pose3 pose2 aabb ball box ray null id pair polygon good bad)
set(expected
    "(1, 2.5, -3)"
    "(1, 2)"
    "at (1, 2, 3) turn w 0.5 (0.5, 0.5, 0.5)"
    "at (1, 2) turn (0, 1)"
    "(0, 1) to (2, 3)"
    "center (1, 2, 3) radius 0.5"
    "center (0, 0) half (1, 2) rotation turn (0, 1)"
    "origin (0, 0, 0) direction (1, 0, 0) length 4"
    "null"
    "3, generation 1"
    "{1, generation 0} {3, generation 1}"
    "Polygon of 3 points = {(0, 0), (1, 0), (0, 1)}"
    "Result = {value = Polygon of 3 points = {(0, 0), (1, 0), (0, 1)}}"
    "Problem abut::ProblemCode::empty_input: \"there are no points to build from\"")
set(commands)
foreach(name IN LISTS names)
    list(APPEND commands -ex "print ${name}")
endforeach()
execute_process(COMMAND ${gdb} -nx -batch -ex "set print pretty off" -ex "source ${printers}" -ex "break done" -ex run -ex up ${commands}
    -ex "print hull" ${program}
    OUTPUT_VARIABLE output ERROR_VARIABLE said)
if(NOT output MATCHES "Breakpoint 1, ")
    # Some containers don't allow it; the test then counts as skipped.
    message("gdb can't run a program here:\n${output}\n${said}")
    return()
endif()
set(number 0)
foreach(name IN LISTS names)
    list(GET expected ${number} line)
    math(EXPR number "${number} + 1")
    string(FIND "${output}\n" "\n$${number} = ${line}\n" at)
    if(at EQUAL -1)
        string(REGEX MATCH "\n.${number} = [^\n]*" printed "${output}")
        message(SEND_ERROR "${name}: ${line}\nis printed as${printed}\n${said}")
    endif()
endforeach()
# A library without debug symbols has no names for what it stores.
if(NOT output MATCHES "= Result = {value = Polyhedron (of 2 points = {\\(0, 0, 0\\), \\(1, 0, 0\\)}|\\(its points are)")
    message(SEND_ERROR "hull:\n${output}\n${said}")
endif()
