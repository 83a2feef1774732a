# Installs abut, moves the folder, builds the consumer against it from outside (where there is no Assimp), by CMake and by
# pkg-config, and compares what it prints with what ours prints.
#   cmake -D build= -D folder= -D consumer= -D here= -D with_recast= -D asserts= -D with_io= -D pkg_config= -D generator=
#       -D compiler= -D flags= -P installed_package.cmake
function(must)
    execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}: ${result}\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# Anew each time: a header that is no longer installed must not be found.
file(REMOVE_RECURSE ${folder})
must(${CMAKE_COMMAND} --install ${build} --prefix ${folder}/before)
file(RENAME ${folder}/before ${folder}/prefix)
file(GLOB_RECURSE shaders ${folder}/prefix/abut_field.glsl)
if(NOT shaders MATCHES "/abut/field/abut_field.glsl$")
    message(FATAL_ERROR "abut_field.glsl is not installed beside the headers: ${shaders}")
endif()
must(${CMAKE_COMMAND} -S ${consumer} -B ${folder}/build -G ${generator}
    -D CMAKE_BUILD_TYPE=None
    -D CMAKE_PREFIX_PATH=${folder}/prefix
    -D CMAKE_CXX_COMPILER=${compiler}
    -D CMAKE_DISABLE_FIND_PACKAGE_assimp=ON
    -D with_recast=${with_recast}
    "-D CMAKE_CXX_FLAGS=${flags} -O3 -march=native")
must(${CMAKE_COMMAND} --build ${folder}/build)

must(${folder}/build/consumer)
set(outside "${output}")
must(${folder}/build/consumer_intrinsics)
set(with_intrinsics "${output}")
must(${here})
if(NOT outside STREQUAL output OR NOT with_intrinsics STREQUAL output)
    message(FATAL_ERROR
        "built outside:\n${outside}\nwith glm's intrinsics:\n${with_intrinsics}\nbuilt here:\n${output}")
endif()
set(answers "${output}")
must(${folder}/build/consumer_misuse)
set(assertions "assertions 0")
if(asserts)
    set(assertions "assertions 1")
endif()
if(NOT output MATCHES "^${assertions},")
    message(FATAL_ERROR "The package must have ${assertions}: ${output}")
endif()
must(${folder}/build/consumer_c)
if(with_recast)
    must(${folder}/build/consumer_recast)
endif()

# Without CMake. The flags of the build, such as a sanitizer's, come after those of the package.
if(pkg_config)
    file(GLOB_RECURSE package ${folder}/prefix/abut.pc)
    get_filename_component(package_folder ${package} DIRECTORY)
    set(ENV{PKG_CONFIG_PATH} ${package_folder}:$ENV{PKG_CONFIG_PATH})
    must(${pkg_config} --print-errors --exists abut abut-bake abut-draw abut-c)
    if(with_io)
        must(${pkg_config} --print-errors --exists abut-io)
    endif()
    if(with_recast)
        must(${pkg_config} --print-errors --exists abut-recast)
    endif()
    separate_arguments(own_flags UNIX_COMMAND "${flags}")
    must(${pkg_config} --cflags --libs abut)
    if(NOT output MATCHES "-ffp-contract=off")
        message(FATAL_ERROR "The flags of abut.pc miss -ffp-contract=off: ${output}")
    endif()
    separate_arguments(package_flags UNIX_COMMAND "${output}")
    must(${compiler} ${consumer}/main.cpp ${package_flags} ${own_flags} -O0 -o ${folder}/with_pkg_config)
    must(${folder}/with_pkg_config)
    if(NOT output STREQUAL answers)
        message(FATAL_ERROR "built with pkg-config:\n${output}\nbuilt here:\n${answers}")
    endif()
    must(${pkg_config} --cflags --libs abut-c)
    separate_arguments(package_flags UNIX_COMMAND "${output}")
    must(${compiler} -x c ${consumer}/main.c -x none ${package_flags} ${own_flags} -o ${folder}/c_with_pkg_config)
    must(${folder}/c_with_pkg_config)
endif()
message(STATUS "${answers}")
