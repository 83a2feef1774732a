# How the library is compiled for WebAssembly: what answers questions for speed, and what makes, stores and reads data for size.
set(core ${CMAKE_CURRENT_LIST_DIR}/../../abut)
target_compile_options(abut_core PRIVATE -O2)
target_compile_options(abut_c PRIVATE -O2)
target_compile_options(abut_bake PRIVATE -Oz)

file(GLOB_RECURSE rare CONFIGURE_DEPENDS
    ${core}/broad_phase/simple/*.cpp
    ${core}/convex/hull/*.cpp
    ${core}/motion/*.cpp
    ${core}/shape/file/*.cpp
    ${core}/shape/mesh/check_triangles.cpp ${core}/shape/mesh/clean_up.cpp ${core}/shape/mesh/orient.cpp ${core}/shape/mesh/weld.cpp
    ${core}/shape/solid_bsp/b*.cpp ${core}/shape/solid_bsp/cells.cpp
    ${core}/query/certify.cpp ${core}/query/minkowski_sum.cpp ${core}/query/polytope.cpp
    ${core}/field/check.cpp ${core}/field/file.cpp ${core}/field/quantise.cpp ${core}/field/texture.cpp
    ${core}/walk/file.cpp ${core}/walk/survey.cpp ${core}/walk/build/*.cpp ${core}/walk/path/*.cpp
    ${core}/world/file.cpp ${core}/world/history.cpp ${core}/world/re*.cpp ${core}/world/snapshot.cpp)
# This one is compiled by Highway.
list(FILTER rare EXCLUDE REGEX "highest_plane")
set_source_files_properties(${rare} TARGET_DIRECTORY abut_core PROPERTIES COMPILE_OPTIONS -Oz)
set_source_files_properties(${core}/c/bake.cpp ${core}/c/field.cpp ${core}/c/walk_mesh.cpp TARGET_DIRECTORY abut_c
    PROPERTIES COMPILE_OPTIONS -Oz)

# Sources without vectors of doubles take Highway's vectors for WebAssembly, which has none of doubles before version 1.1.
set(vectors
    broad_phase/bvh/descent.cpp broad_phase/bvh/pairs.cpp broad_phase/bvh/queries.cpp broad_phase/bvh/split.cpp
    broad_phase/detail/box_overlaps.cpp broad_phase/grid/fill.cpp broad_phase/grid/pairs.cpp broad_phase/grid/queries.cpp
    convex/gjk/gjk_fast.cpp field/look_up/batch.cpp query/detail/raycast/mesh.cpp shape/mesh/box_queries.cpp shape/mesh/rays.cpp)
list(TRANSFORM vectors PREPEND ${core}/)
set_source_files_properties(${vectors} TARGET_DIRECTORY abut_core PROPERTIES COMPILE_DEFINITIONS HWY_BROKEN_TARGETS=HWY_WASM_EMU256)
