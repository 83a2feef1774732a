# cmake --install: headers and shaders, printers for debuggers, libraries, the tool, and the package that find_package(abut) finds.
# Each library is a component with an export of its own, so that a game which wants abut::abut needs no Assimp.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/abut)
set(components core bake draw c)
if(ABUT_IO)
    list(APPEND components io)
endif()
if(ABUT_RECAST)
    list(APPEND components recast)
endif()

# All that is handed out, without tests and examples.
add_custom_target(abut_product)

foreach(component IN LISTS components)
    add_dependencies(abut_product abut_${component})
    install(TARGETS abut_${component} EXPORT abut_${component}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(EXPORT abut_${component} NAMESPACE abut:: DESTINATION ${package_dir})
endforeach()

# Private headers are installed only where a public one includes them.
set(fronts abut/abut.hpp abut/bake.hpp abut/draw.hpp abut/c/abut.h)
if(ABUT_IO)
    list(APPEND fronts abut/io.hpp)
endif()
if(ABUT_RECAST)
    list(APPEND fronts abut/recast.hpp)
endif()
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
    set(fronts \"${fronts}\")
    set(destination \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")")
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/install_headers.cmake)
install(FILES ${PROJECT_SOURCE_DIR}/abut/c/abut_api.json DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/abut/c)
install(FILES ${PROJECT_SOURCE_DIR}/abut/field/abut_field.glsl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/abut/field)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/debug/abut_gdb.py ${PROJECT_SOURCE_DIR}/packaging/debug/abut.natvis
    DESTINATION ${CMAKE_INSTALL_DATADIR}/abut)

get_property(ABUT_IO_PACKAGES GLOBAL PROPERTY ABUT_IO_PACKAGES)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/abutConfig.cmake.in ${PROJECT_BINARY_DIR}/abutConfig.cmake
    INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/abutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/abutConfig.cmake ${PROJECT_BINARY_DIR}/abutConfigVersion.cmake
    ${PROJECT_SOURCE_DIR}/cmake/FindRecast.cmake
    DESTINATION ${package_dir})

if(NOT MSVC)
    include(abut_pkg_config)
endif()

if(ABUT_TOOL)
    add_dependencies(abut_product abut_tool scenes)
    if(ABUT_LIBRARY_TYPE STREQUAL "SHARED")
        file(RELATIVE_PATH to_libraries /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR})
        set_target_properties(abut_tool PROPERTIES INSTALL_RPATH $<$<PLATFORM_ID:Linux>:$ORIGIN/${to_libraries}>)
    endif()
    install(TARGETS abut_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    # The tool itself writes its man page and completions, where it can run.
    if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
        set(help ${PROJECT_BINARY_DIR}/help)
        add_custom_command(OUTPUT ${help}/abut.1 ${help}/abut ${help}/_abut ${help}/abut.fish
            COMMAND ${CMAKE_COMMAND} -E make_directory ${help}
            COMMAND abut_tool help --man > ${help}/abut.1
            COMMAND abut_tool help --completions bash > ${help}/abut
            COMMAND abut_tool help --completions zsh > ${help}/_abut
            COMMAND abut_tool help --completions fish > ${help}/abut.fish
            DEPENDS abut_tool COMMENT "Writing the man page and completions")
        add_custom_target(abut_help ALL DEPENDS ${help}/abut.1)
        add_dependencies(abut_product abut_help)
        install(FILES ${help}/abut.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
        install(FILES ${help}/abut DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
        install(FILES ${help}/_abut DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
        install(FILES ${help}/abut.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
    endif()
endif()
