# glm's configuration macros that the library can't be used with are refused in one sentence, which names the macro.
#   cmake -D compiler= -D include= -D folder= -P glm_macros.cmake
file(WRITE ${folder}/includes_abut.cpp "#include <abut/abut.hpp>\n")
# Alone it changes nothing.
set(also_GLM_FORCE_DEFAULT_ALIGNED_GENTYPES -D GLM_FORCE_INTRINSICS)
foreach(macro IN ITEMS GLM_FORCE_SIZE_T_LENGTH GLM_FORCE_DEFAULT_ALIGNED_GENTYPES GLM_FORCE_QUAT_DATA_WXYZ)
    execute_process(COMMAND ${compiler} -std=c++20 -fsyntax-only ${also_${macro}} -D ${macro} -I ${include} ${folder}/includes_abut.cpp
        OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE result)
    if(result EQUAL 0 OR NOT said MATCHES "abut needs glm's [^\n]*: build without ${macro}")
        message(SEND_ERROR "${macro} (${result}):\n${said}")
    endif()
endforeach()
