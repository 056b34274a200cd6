# SPDX-License-Identifier: Apache-2.0
# SOURCE, BUILD: the project and a complete build of it; CONSUMERS: projects that use Asperity; WORK: a folder to fill.
set(PREFIX ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})

# run(COMMAND...): runs it, keeps what it says in `output`, fails with it when it fails.
function(run)
    execute_process(COMMAND ${ARGN}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nended with ${status}\n${output}\n${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# expect(TEXT REGEX): fails unless the text matches.
function(expect text regex)
    if(NOT text MATCHES "${regex}")
        message(FATAL_ERROR "expected '${regex}', got:\n${text}")
    endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX})

# A library is known by its headers: those of the list, no kernel and no helper of tests.
file(GLOB_RECURSE installed RELATIVE ${PREFIX}/include ${PREFIX}/include/*)
file(STRINGS ${SOURCE}/cmake/AsperityHeaders.txt listed REGEX "^asperity/")
list(SORT installed)
list(SORT listed)
if(NOT installed STREQUAL listed)
    message(FATAL_ERROR "installed headers:\n${installed}\nlisted headers:\n${listed}")
endif()
foreach(header IN LISTS listed)
    if(header MATCHES "test|-inl\\.h$|engines/wide|kernels")
        message(FATAL_ERROR "${header} is private")
    endif()
    if(NOT header STREQUAL "asperity/asperity.h")
        file(STRINGS ${SOURCE}/src/asperity/asperity.h line REGEX "#include <${header}>")
        if(NOT line)
            message(FATAL_ERROR "asperity/asperity.h does not bring ${header}")
        endif()
    endif()
endforeach()

# The program runs from where it was put.
run(${PREFIX}/bin/asperity --version)
expect("${output}" "${VERSION}")

# use(PROJECT): a stranger's project finds the library, builds and runs.
function(use project)
    run(${CMAKE_COMMAND} -S ${CONSUMERS}/${project} -B ${WORK}/${project} -G ${GENERATOR}
        -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${PREFIX})
    run(${CMAKE_COMMAND} --build ${WORK}/${project})
    run(${WORK}/${project}/${project})
    expect("${output}" "^asperity ${VERSION}\nalbedo 1.000000\n$")
endfunction()
use(consumer)
use(measurer)

# The same by pkg-config, and what a measurement links is short.
file(GLOB pkgconfig ${PREFIX}/lib*/pkgconfig ${PREFIX}/lib/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${pkgconfig})
run(pkg-config --cflags --libs asperity-measure)
set(flags "${output}")
if(flags MATCHES "embree|OpenEXR|png|Imath|Qt")
    message(FATAL_ERROR "a measurement links ${flags}")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${COMPILER} -std=c++20 ${CONSUMERS}/consumer/consumer.cpp -o ${WORK}/by_pkg_config ${flags})
run(${WORK}/by_pkg_config)
expect("${output}" "albedo 1.000000")
run(pkg-config --libs asperity)
expect("${output}" "embree3.*png|png.*embree3")

# The library itself configures where those libraries cannot be found, for who measures.
set(hidden "")
foreach(package IN ITEMS embree OpenEXR PNG Qt6 CLI11)
    list(APPEND hidden -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/bare -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
    -D ASPERITY_COMPONENTS=measure -D ASPERITY_BUILD_TESTS=OFF ${hidden})
expect("${output}" "asperity_render is left out: it needs embree")

# What was installed goes again.
file(GLOB_RECURSE before ${PREFIX}/*)
run(${CMAKE_COMMAND} -D MANIFEST=${BUILD}/install_manifest.txt
    -P ${SOURCE}/cmake/AsperityUninstall.cmake)
file(GLOB_RECURSE after ${PREFIX}/*)
if(NOT before OR after)
    message(FATAL_ERROR "left behind by uninstall: ${after}")
endif()
