# What other platforms need, checked without them: which vector units the targets switch off, and that x87 arithmetic is refused.
#   cmake -D compiler= -D source= -D folder= -D generator= -P platform_flags.cmake
cmake_minimum_required(VERSION 3.22)

# No test covers SVE and RISC-V's vector unit. The NEON of 32-bit ARM takes denormals as zero.
set(off_aarch64 HWY_SVE HWY_SVE2 HWY_SVE_256 HWY_SVE2_128)
set(off_riscv64 HWY_RVV)
set(off_armv7l "HWY_NEON.HWY_ARCH_ARM_V7")
foreach(processor IN ITEMS aarch64 riscv64 armv7l)
    set(build ${folder}/${processor})
    file(REMOVE_RECURSE ${build})
    execute_process(COMMAND ${CMAKE_COMMAND} -S ${source}/test/everywhere -B ${build} -G ${generator}
        -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=${processor} -D CMAKE_CXX_COMPILER=${compiler}
        -D CMAKE_EXPORT_COMPILE_COMMANDS=ON
        OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${processor}: cmake stopped:\n${said}")
    endif()
    file(STRINGS ${build}/compile_commands.json commands REGEX "\"command\": .*/abut_[a-z]+\\.dir/")
    list(LENGTH commands count)
    if(count LESS 50)
        message(SEND_ERROR "${processor}: only ${count} commands found")
    endif()
    foreach(unit IN LISTS off_${processor})
        set(without ${commands})
        list(FILTER without EXCLUDE REGEX "HWY_DISABLED_TARGETS=[^ ]*[|]${unit}[|)]")
        if(without)
            list(GET without 0 first)
            message(SEND_ERROR "${processor}: ${unit} is not switched off in\n${first}")
        endif()
    endforeach()
endforeach()

# Only g++ has x87 arithmetic on x86-64 too.
execute_process(COMMAND ${compiler} -std=c++20 -fsyntax-only -mfpmath=387 -I ${source} -x c++ ${source}/abut/math/vec.hpp
    OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE result)
if(result EQUAL 0 OR NOT said MATCHES "abut needs numbers without excess precision|387|fpmath")
    message(SEND_ERROR "x87 arithmetic (${result}):\n${said}")
endif()
