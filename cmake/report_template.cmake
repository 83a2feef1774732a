# Builds the page of `abut check --report` by npm, and writes it as C++. Without npm, or if that fails, the page is empty, and
# the tool refuses --report.
#   cmake -D npm= -D source= -D folder= -D out= -P report_template.cmake
set(page)
if(npm)
    file(COPY ${source}/package.json ${source}/package-lock.json ${source}/build.mjs ${source}/src DESTINATION ${folder})
    file(SHA256 ${folder}/package-lock.json lock)
    set(installed)
    if(EXISTS ${folder}/installed)
        file(READ ${folder}/installed installed)
    endif()
    set(result 0)
    if(NOT installed STREQUAL lock)
        execute_process(COMMAND ${npm} ci --omit=dev --no-audit --no-fund --fetch-retries=1 --fetch-timeout=60000 WORKING_DIRECTORY ${folder}
            OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
        if(result EQUAL 0)
            file(WRITE ${folder}/installed ${lock})
        endif()
    endif()
    if(result EQUAL 0)
        execute_process(COMMAND ${npm} run --silent build -- ${folder}/report.html WORKING_DIRECTORY ${folder}
            OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
    endif()
    if(result EQUAL 0)
        file(READ ${folder}/report.html page HEX)
    else()
        message(WARNING "abut check --report will not be there: npm failed in ${folder}\n${output}")
    endif()
endif()
string(REGEX REPLACE "(................................)" "\\1\n" page "${page}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," page "${page}")
file(WRITE ${out} "// Made by cmake/report_template.cmake.
#include \"tool/page/report_template.hpp\"

namespace abut::tool {
namespace {
constexpr unsigned char bytes[] = {\n${page}0};
}
const std::string_view report_template(reinterpret_cast<const char*>(bytes), sizeof bytes - 1);
}  // namespace abut::tool
")
