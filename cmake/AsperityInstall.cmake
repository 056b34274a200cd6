# SPDX-License-Identifier: Apache-2.0
# cmake --install gives the public headers, a library a module, what find_package(Asperity COMPONENTS ...)
# needs, and a .pc file for each component. The programs install themselves from apps.
#
# A component is a module of src/asperity or a group of them. Which modules and packages each needs is
# read from what its target links.
#
# For cmake --install --component the lot is called development, the program asperity cli.
include(CMakePackageConfigHelpers)

set(ASPERITY_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Asperity)
file(RELATIVE_PATH ASPERITY_PC_PREFIX /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
set(ASPERITY_GROUP_measure gonio measured results)
get_property(ASPERITY_MODULES GLOBAL PROPERTY ASPERITY_MODULES)

# asperity_needs(MODULE): sets `needs` (modules), `packages` (for find_dependency), `requires` and
# `libs` (for pkg-config).
function(asperity_needs module)
    set(needs "")
    set(packages "")
    set(requires "")
    set(libs "-lasperity_${module}")
    get_target_property(links asperity_${module} LINK_LIBRARIES)
    foreach(link IN LISTS links)
        if(link MATCHES "^asperity_(.*)$")
            list(APPEND needs ${CMAKE_MATCH_1})
        elseif(link STREQUAL Threads::Threads)
            list(APPEND packages "Threads")
            list(APPEND libs "-pthread")
        elseif(link STREQUAL TBB::tbb)
            list(APPEND packages "TBB")
            list(APPEND requires tbb)
        elseif(link STREQUAL fmt::fmt)
            list(APPEND packages "fmt")
            list(APPEND requires fmt)
        elseif(link STREQUAL OpenEXR::OpenEXR)
            list(APPEND packages "OpenEXR 3.1")
            list(APPEND requires OpenEXR)
        elseif(link STREQUAL PNG::PNG)
            list(APPEND packages "PNG")
            list(APPEND requires libpng)
        elseif(link STREQUAL pugixml::pugixml)
            list(APPEND packages "pugixml")
            list(APPEND requires pugixml)
        elseif(link STREQUAL TIFF::TIFF)
            list(APPEND packages "TIFF")
            list(APPEND requires libtiff-4)
        elseif(link STREQUAL ZLIB::ZLIB)
            list(APPEND packages "ZLIB")
            list(APPEND requires zlib)
        elseif(link STREQUAL embree)
            list(APPEND packages "embree 3.13")
            string(APPEND libs " -lembree3")
        elseif(link MATCHES "^(cairo|hwy|xxhash|zip|zstd)$")
            string(APPEND libs " -l${link}")
        elseif(NOT link MATCHES "^\\$<BUILD_INTERFACE:")
            message(FATAL_ERROR "asperity_${module} links ${link}: add its row to asperity_needs")
        endif()
    endforeach()
    foreach(name IN ITEMS needs packages requires libs)
        set(${name} "${${name}}" PARENT_SCOPE)
    endforeach()
endfunction()

# asperity_pkg_config(NAME MODULES REQUIRES LIBS): installs NAME.pc.
function(asperity_pkg_config name modules requires libs)
    list(TRANSFORM modules PREPEND asperity-)
    list(JOIN modules " " modules)
    list(JOIN requires " " requires)
    configure_file(cmake/asperity.pc.in ${name}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()

set(ASPERITY_TABLE "")
foreach(module IN LISTS ASPERITY_MODULES)
    asperity_needs(${module})
    string(APPEND ASPERITY_TABLE "set(_asperity_needs_${module} \"${needs}\")\n"
        "set(_asperity_packages_${module} \"${packages}\")\n")
    asperity_pkg_config(asperity-${module} "${needs}" "${requires}" "${libs}")
    install(TARGETS asperity_${module} EXPORT asperity_${module} COMPONENT development)
    install(EXPORT asperity_${module} NAMESPACE asperity:: FILE AsperityTargets-${module}.cmake
        DESTINATION ${ASPERITY_PACKAGE_DIR} COMPONENT development)
endforeach()
asperity_pkg_config(asperity-measure "${ASPERITY_GROUP_measure}" "" "")
asperity_pkg_config(asperity "${ASPERITY_MODULES}" "" "")

# Headers go by their list, not by target: a package without components still has them all.
install(TARGETS asperity
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

configure_package_config_file(cmake/AsperityConfig.cmake.in AsperityConfig.cmake
    INSTALL_DESTINATION ${ASPERITY_PACKAGE_DIR}
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(AsperityConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${CMAKE_CURRENT_BINARY_DIR}/AsperityConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/AsperityConfigVersion.cmake
    DESTINATION ${ASPERITY_PACKAGE_DIR} COMPONENT development)

# ninja uninstall takes away what the last install from this build wrote.
add_custom_target(uninstall
    COMMAND ${CMAKE_COMMAND} -D MANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
        -P ${PROJECT_SOURCE_DIR}/cmake/AsperityUninstall.cmake
    USES_TERMINAL)
