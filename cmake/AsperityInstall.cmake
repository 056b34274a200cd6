# SPDX-License-Identifier: Apache-2.0
# cmake --install gives the headers, the libraries behind one target asperity::asperity, and what
# find_package(Asperity) needs. The program installs itself from apps/cli.
include(CMakePackageConfigHelpers)

set(ASPERITY_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Asperity)

install(DIRECTORY src/asperity DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h" PATTERN "*test_*.h" EXCLUDE PATTERN "*-inl.h" EXCLUDE)

install(TARGETS asperity EXPORT asperity_targets)
install(EXPORT asperity_targets NAMESPACE asperity:: FILE AsperityTargets.cmake
    DESTINATION ${ASPERITY_PACKAGE_DIR})

configure_package_config_file(cmake/AsperityConfig.cmake.in AsperityConfig.cmake
    INSTALL_DESTINATION ${ASPERITY_PACKAGE_DIR}
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(AsperityConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${CMAKE_CURRENT_BINARY_DIR}/AsperityConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/AsperityConfigVersion.cmake
    DESTINATION ${ASPERITY_PACKAGE_DIR})
