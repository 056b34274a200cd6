# SPDX-License-Identifier: Apache-2.0
# cpack makes a Debian package of each component that is built: the program, the studio, the library with
# its headers, the program for clusters. What they need is found by dpkg-shlibdeps; the library is static, so
# its package needs what compiles and links against it. tools/package builds and calls it.
set(ASPERITY_PACKAGE_cli asperity)
set(ASPERITY_PACKAGE_studio asperity-studio)
set(ASPERITY_PACKAGE_mpi asperity-mpi)
set(ASPERITY_PACKAGE_development libasperity-dev)

set(CPACK_COMPONENTS_ALL development)
foreach(component IN ITEMS cli studio mpi)
    if(TARGET asperity_${component})
        list(APPEND CPACK_COMPONENTS_ALL ${component})
    endif()
endforeach()

# Policy: every package brings its licence.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${ASPERITY_PACKAGE_${component}}
        RENAME copyright COMPONENT ${component})
    string(TOUPPER ${component} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${ASPERITY_PACKAGE_${component}})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME asperity)
set(CPACK_PACKAGE_VENDOR "Asperity")
set(CPACK_PACKAGE_CONTACT "The Asperity project <asperity@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_CLI_DESCRIPTION "virtual gonioreflectometer, the program
 Shoots light at a rough surface, sorts what leaves by direction and writes the
 BRDF with error bars; compares it with models, fits them, renders pictures.")
set(CPACK_COMPONENT_STUDIO_DESCRIPTION "virtual gonioreflectometer, the desktop program
 The surface, the light and the growing lobe in a window; models in light that
 wear what was measured.")
set(CPACK_COMPONENT_MPI_DESCRIPTION "virtual gonioreflectometer for clusters
 The measurement of asperity on many machines, the same to the bit.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "virtual gonioreflectometer, library and headers
 Static libraries, headers, CMake package and pkg-config files of asperity.")
set(CPACK_DEBIAN_STUDIO_PACKAGE_RECOMMENDS asperity)
# As in tools/apt.txt: what the installed headers include and the archives link with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libtbb-dev, libfmt-dev, libopenexr-dev, libpng-dev, \
libpugixml-dev, libtiff-dev, zlib1g-dev, libzip-dev, libembree-dev, libhwy-dev, libxxhash-dev, libzstd-dev, \
libcairo2-dev")
# The type that plots are written in.
set(CPACK_DEBIAN_CLI_PACKAGE_RECOMMENDS fonts-dejavu-core)
include(CPack)
