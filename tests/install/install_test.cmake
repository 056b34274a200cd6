# SPDX-License-Identifier: Apache-2.0
# SOURCE, BUILD: the project and a complete build of it; CONSUMER: a project that uses Asperity; WORK: a folder to fill.
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

# A library is known by its headers: none of ours may be missing, nothing else may slip in.
file(GLOB_RECURSE installed RELATIVE ${PREFIX}/include ${PREFIX}/include/*)
file(GLOB_RECURSE written RELATIVE ${SOURCE}/src ${SOURCE}/src/asperity/*.h)
list(FILTER written EXCLUDE REGEX "(test_[^/]*|-inl.h)$")  # helpers of tests and of kernels
list(SORT installed)
list(SORT written)
if(NOT installed STREQUAL written)
    message(FATAL_ERROR "installed headers:\n${installed}\nheaders of src:\n${written}")
endif()

# The program runs from where it was put.
run(${PREFIX}/bin/asperity --version)
expect("${output}" "${VERSION}")

# A stranger's project finds the library, builds and runs.
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${PREFIX})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
expect("${output}" "^asperity ${VERSION}\nalbedo 1.000000\n$")
