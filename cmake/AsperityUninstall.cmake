# SPDX-License-Identifier: Apache-2.0
# MANIFEST: the list of files that cmake --install wrote; they go, folders stay.
if(NOT EXISTS "${MANIFEST}")
    message(FATAL_ERROR "${MANIFEST} is missing: nothing was installed from this build")
endif()
file(STRINGS "${MANIFEST}" files)
foreach(file IN LISTS files)
    file(REMOVE "$ENV{DESTDIR}${file}")
    if(EXISTS "$ENV{DESTDIR}${file}")
        message(FATAL_ERROR "cannot remove $ENV{DESTDIR}${file}")
    endif()
endforeach()
list(LENGTH files count)
message(STATUS "${count} files removed")
