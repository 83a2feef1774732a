# Recast, of the Recast Navigation library: Recast::Recast, and Recast_FOUND. Debian's package has no CMake package.
find_path(Recast_INCLUDE_DIR recastnavigation/Recast.h)
find_library(Recast_LIBRARY Recast)
mark_as_advanced(Recast_INCLUDE_DIR Recast_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Recast REQUIRED_VARS Recast_LIBRARY Recast_INCLUDE_DIR)

if(Recast_FOUND AND NOT TARGET Recast::Recast)
    add_library(Recast::Recast UNKNOWN IMPORTED)
    set_target_properties(Recast::Recast PROPERTIES
        IMPORTED_LOCATION ${Recast_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Recast_INCLUDE_DIR})
endif()
