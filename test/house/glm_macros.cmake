# glm's configuration macros change no answer, or are refused in one sentence that names the macro. `together` is the consumer,
# compiled with all the others at once; with ABUT_LONG in the environment each is tried alone.
#   cmake -D compiler= -D include= -D folder= -D consumer=main.cpp -D libraries= -D here= -D together= -P glm_macros.cmake
set(refused GLM_FORCE_SIZE_T_LENGTH GLM_FORCE_DEFAULT_ALIGNED_GENTYPES GLM_FORCE_QUAT_DATA_WXYZ GLM_FORCE_QUAT_CTOR_XYZW
    GLM_FORCE_CTOR_INIT)
set(harmless GLM_FORCE_ALIGNED_GENTYPES GLM_FORCE_DEFAULT_ALIGNED_GENTYPES GLM_FORCE_EXPLICIT_CTOR GLM_FORCE_SWIZZLE
    GLM_FORCE_INTRINSICS GLM_FORCE_PURE GLM_FORCE_AVX2 GLM_FORCE_INLINE GLM_FORCE_UNRESTRICTED_GENTYPE GLM_FORCE_XYZW_ONLY
    GLM_FORCE_SINGLE_ONLY GLM_FORCE_LEFT_HANDED GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_FORCE_SILENT_WARNINGS GLM_FORCE_MESSAGES
    GLM_FORCE_CXX11 GLM_FORCE_CXX14 GLM_FORCE_CXX17 GLM_FORCE_CXX2A GLM_FORCE_PRECISION_LOWP_FLOAT
    GLM_FORCE_PRECISION_MEDIUMP_FLOAT GLM_FORCE_PRECISION_LOWP_DOUBLE GLM_FORCE_PRECISION_LOWP_INT GLM_FORCE_PRECISION_LOWP_UINT)

file(WRITE ${folder}/includes_abut.cpp "#include <abut/abut.hpp>\n")
# Alone it changes nothing.
set(also_GLM_FORCE_DEFAULT_ALIGNED_GENTYPES -D GLM_FORCE_INTRINSICS)
foreach(macro IN LISTS refused)
    execute_process(COMMAND ${compiler} -std=c++20 -fsyntax-only ${also_${macro}} -D ${macro} -I ${include} ${folder}/includes_abut.cpp
        OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE result)
    if(result EQUAL 0 OR NOT said MATCHES "abut needs glm's [^\n]*: build without ${macro}")
        message(SEND_ERROR "${macro} (${result}):\n${said}")
    endif()
endforeach()

# A program's output must be that of the consumer without macros.
execute_process(COMMAND ${here} OUTPUT_VARIABLE answers COMMAND_ERROR_IS_FATAL ANY)
function(must_agree macros program)
    execute_process(COMMAND ${program} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
    if(NOT result EQUAL 0 OR NOT output STREQUAL answers)
        message(SEND_ERROR "${macros} (${result}):\n${output}\nwithout:\n${answers}")
    endif()
endfunction()
must_agree(together ${together})
if(DEFINED ENV{ABUT_LONG})
    foreach(macro IN LISTS harmless)
        execute_process(
            COMMAND ${compiler} -std=c++20 -O1 -ffp-contract=off -D ${macro} -I ${include} ${consumer} -o ${folder}/glm_macro ${libraries} -pthread
            ERROR_VARIABLE said RESULT_VARIABLE result)
        if(result EQUAL 0)
            must_agree(${macro} ${folder}/glm_macro)
        else()
            message(SEND_ERROR "${macro} (${result}):\n${said}")
        endif()
    endforeach()
endif()
