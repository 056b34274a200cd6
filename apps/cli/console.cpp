// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <asperity/core/error.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

namespace asperity::cli {

void prepare_standard_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    // open() gives the lowest free number. Standard output is opened for reading, so that writing
    // to it fails as it would on a closed stream.
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) != -1) continue;
        const int mode = stream == STDERR_FILENO ? O_WRONLY : O_RDONLY;
        if (open("/dev/null", mode) != stream) return;
    }
}

static std::string printable(std::string_view text) {
    std::string clean(text);
    for (std::size_t k = 0; k < clean.size(); ++k) {
        const auto byte = static_cast<unsigned char>(clean[k]);
        const auto next = static_cast<unsigned char>(k + 1 < clean.size() ? clean[k + 1] : ' ');
        // U+0080 to U+009F are such characters, too
        const bool wide = byte == 0xc2 && next >= 0x80 && next < 0xa0;
        if (wide) clean.erase(k, 1);
        if (wide || byte == 0x7f || (byte < 0x20 && byte != '\n' && byte != '\t')) clean[k] = '?';
    }
    return clean;
}

void write_out(std::string_view raw) {
    write_bytes(printable(raw));
}

void write_bytes(std::string_view bytes) {
    const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    if (written == bytes.size() && std::fflush(stdout) == 0) return;
    if (errno == EPIPE) throw BrokenPipe{};
    throw Error(ErrorCode::InputOutput, std::strerror(errno), "standard output");
}

void write_err(std::string_view text) {
    write_control(printable(text));
}

void write_control(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

bool err_is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

void Talk::operator()(std::string_view text) const {
    if (quiet_) return;
    if (json_) {
        write_err(text);
    } else {
        write_out(text);
    }
}

}  // namespace asperity::cli
