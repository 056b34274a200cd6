// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>

#include <exception>
#include <new>
#include <string>
#include <utility>

namespace asperity::io {

/// Calls `call`; whatever OpenEXR throws in it becomes our error of one line.
template <typename Call>
void translating_exr(const std::string& path, ErrorCode code, Call&& call) {
    try {
        std::forward<Call>(call)();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    } catch (const std::exception& error) {
        std::string why = error.what();
        for (char& c : why)
            if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
        throw Error(code, "OpenEXR: " + std::string(trimmed(why)), path);
    }
}

}  // namespace asperity::io
