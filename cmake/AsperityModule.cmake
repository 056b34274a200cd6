# SPDX-License-Identifier: Apache-2.0
# One static library per folder of src/asperity, one test binary beside it.

add_library(asperity_flags INTERFACE)
target_compile_features(asperity_flags INTERFACE cxx_std_20)
target_compile_options(asperity_flags INTERFACE
    # Results must not depend on whether the compiler fuses a multiplication with an addition.
    -ffp-contract=off
    -Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Clang takes double{x} for an accident, too
    target_compile_options(asperity_flags INTERFACE -Wdouble-promotion)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms about std::string in optimised builds, GCC bug 105651.
    target_compile_options(asperity_flags INTERFACE -Wno-restrict)
endif()
target_compile_definitions(asperity_flags INTERFACE _GLIBCXX_ASSERTIONS)
if(ASPERITY_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # It tells sources from headers by what it was called with.
    target_compile_options(asperity_flags INTERFACE -Wno-subobject-linkage)
endif()
if(ASPERITY_WARNINGS_AS_ERRORS)
    target_compile_options(asperity_flags INTERFACE -Werror)
endif()
if(ASPERITY_SANITIZE)
    target_compile_options(asperity_flags INTERFACE
        -fsanitize=${ASPERITY_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(asperity_flags INTERFACE -fsanitize=${ASPERITY_SANITIZE})
endif()

# Tests of a sanitized build carry the word in their names, to be told from the others.
set(ASPERITY_TEST_SUFFIX "")
set(ASPERITY_TEST_OPTIONS "")
set(ASPERITY_TEST_COST 5) # seconds, roughly: the long ones begin first
set(ASPERITY_TEST_SLOWNESS 1)
if(ASPERITY_SANITIZE)
    set(ASPERITY_TEST_SUFFIX _sanitized)
    if(ASPERITY_SANITIZE MATCHES thread)
        set(ASPERITY_TEST_SUFFIX _threads_sanitized)
    endif()
    set(ASPERITY_TEST_OPTIONS -O0)
    set(ASPERITY_TEST_COST 20)
    set(ASPERITY_TEST_SLOWNESS 4)
endif()

# asperity_precompile(GROUP target ...): reads cmake/precompiled/GROUP.h once for all targets of the
# group, which must be compiled with the same options. Only where whole builds start from nothing again
# and again (tools/test): a source that forgets an include would go unnoticed.
function(asperity_precompile group)
    if(NOT ASPERITY_PRECOMPILE)
        return()
    endif()
    foreach(target IN LISTS ARGN)
        get_target_property(type ${target} TYPE) # libraries are -fPIC, programs are -fPIE
        get_property(first GLOBAL PROPERTY ASPERITY_PRECOMPILED_${group}_${type})
        if(first)
            target_precompile_headers(${target} REUSE_FROM ${first})
        else()
            target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${group}.h)
            set_property(GLOBAL PROPERTY ASPERITY_PRECOMPILED_${group}_${type} ${target})
        endif()
        if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
            # It takes what it has read beforehand for code of ours, and these are false alarms about
            # the insides of std::string, bug 105651.
            target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
        endif()
    endforeach()
endfunction()

# Only in the build: all of a header-only library is in ours once that is compiled.
set(ASPERITY_HEADER_ONLY Eigen3::Eigen nlohmann_json::nlohmann_json)

# asperity_module(NAME SOURCES ... [TESTS ...] [TEST_COST seconds] [LIBS ...] [PRIVATE_LIBS ...])
# Makes the target asperity_NAME, which programs elsewhere know as asperity::NAME, the component of the
# same name, and, from TESTS, the test binary asperity_NAME_test (TEST_COST: see asperity_test). A module is left out when a library
# it needs was not asked for (ASPERITY_COMPONENTS) or when a module it needs was left out.
function(asperity_module name)
    cmake_parse_arguments(M "" "TEST_COST" "SOURCES;TESTS;LIBS;PRIVATE_LIBS" ${ARGN})
    foreach(lib IN LISTS M_LIBS M_PRIVATE_LIBS)
        if(lib MATCHES "^asperity_|::|^embree$" AND NOT TARGET ${lib})
            message(STATUS "asperity_${name} is left out: it needs ${lib}")
            return()
        endif()
    endforeach()
    set(private ${M_PRIVATE_LIBS})
    foreach(lib IN LISTS ASPERITY_HEADER_ONLY)
        list(TRANSFORM private REPLACE "^${lib}$" "$<BUILD_INTERFACE:${lib}>")
    endforeach()
    add_library(asperity_${name} STATIC ${M_SOURCES})
    add_library(asperity::${name} ALIAS asperity_${name})
    target_include_directories(asperity_${name} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
    target_link_libraries(asperity_${name} PUBLIC ${M_LIBS}
        PRIVATE $<BUILD_INTERFACE:asperity_flags> ${private})
    target_compile_features(asperity_${name} PUBLIC cxx_std_20)
    set_target_properties(asperity_${name} PROPERTIES EXPORT_NAME ${name})
    set_property(GLOBAL APPEND PROPERTY ASPERITY_MODULES ${name})
    # The library keeps all of GCC's warnings where they count
    if(NOT ASPERITY_WARNINGS_AS_ERRORS OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        asperity_precompile(library asperity_${name})
    endif()
    if(ASPERITY_BUILD_TESTS AND M_TESTS)
        asperity_test(asperity_${name}_test LABEL unit COST ${M_TEST_COST} SOURCES ${M_TESTS}
            LIBS asperity_${name})
    endif()
endfunction()

# asperity_rows(TARGET ...): each file is a row, a format or a verb, with the same names inside; none can be
# compiled together with another one (ASPERITY_UNITY).
function(asperity_rows)
    foreach(target IN LISTS ARGN)
        if(TARGET ${target})
            set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
        endif()
    endforeach()
endfunction()

# asperity_vectors(NAME KERNELS file ...): these files of the module are kernels written with
# Highway, for AVX-512, AVX2, SSE4 and, for all other processors, plain C++; with GCC before 12.3
# Highway would take a narrower kind of the latter, for a compiler bug that a test of ours would show
# (Measure.EveryInstructionSet...). The sanitizers leave the kernels out: instrumented, the vector
# functions take GCC many minutes to compile. Valgrind looks after them, CONTRIBUTING.md.
function(asperity_vectors name)
    cmake_parse_arguments(V "" "" "KERNELS" ${ARGN})
    if(NOT TARGET asperity_${name})
        return()
    endif()
    target_link_libraries(asperity_${name} PRIVATE hwy)
    target_compile_definitions(asperity_${name} PRIVATE
        HWY_BROKEN_EMU128=0 "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_AVX3_DL)")
    set_source_files_properties(${V_KERNELS} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
        SKIP_UNITY_BUILD_INCLUSION ON)
    if(ASPERITY_SANITIZE)
        set_source_files_properties(${V_KERNELS} PROPERTIES COMPILE_OPTIONS "-fno-sanitize=all;-O2")
    endif()
endfunction()

# asperity_matrices(FILES ...): these files of the folder are little but templates of matrices, small ones.
# Instrumented, clang takes most of a minute to optimise each: with sanitizers they are left as they stand.
function(asperity_matrices)
    if(ASPERITY_SANITIZE)
        set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0
            SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
endfunction()

# asperity_test_options(TARGET GROUP COST): how a test is compiled, and its variable `test_cost`. What is
# computed is the library's: what counts for most is that they compile quickly. A test of some COST, the
# seconds that it runs for where nothing is sanitized, is worth optimising there, too: of an inline
# function that test and library share, the linker takes the test's copy for both.
function(asperity_test_options name group cost)
    set(options ${ASPERITY_TEST_OPTIONS})
    set(test_cost ${ASPERITY_TEST_COST})
    if(cost)
        math(EXPR test_cost "${cost} * ${ASPERITY_TEST_SLOWNESS}")
        if(ASPERITY_SANITIZE)
            set(options "")
            set(group long_${group})
        endif()
    endif()
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1> ${options})
    if(group MATCHES tests)
        asperity_precompile(${group} ${name})
    endif()
    set(test_cost ${test_cost} PARENT_SCOPE)
endfunction()

# asperity_test(NAME LABEL label [COST seconds] SOURCES ... LIBS ...): a GoogleTest binary and its ctest
# entry. All tests of a label are built by the target <label>_tests.
function(asperity_test name)
    cmake_parse_arguments(T "" "LABEL;COST" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} ${T_SOURCES})
    target_link_libraries(${name} PRIVATE ${T_LIBS} asperity_flags GTest::gtest_main)
    asperity_test_options(${name} tests "${T_COST}")
    add_test(NAME ${name}${ASPERITY_TEST_SUFFIX} COMMAND ${name})
    set_tests_properties(${name}${ASPERITY_TEST_SUFFIX} PROPERTIES LABELS ${T_LABEL} COST ${test_cost})
    if(NOT TARGET ${T_LABEL}_tests)
        add_custom_target(${T_LABEL}_tests)
    endif()
    add_dependencies(${T_LABEL}_tests ${name})
endfunction()
