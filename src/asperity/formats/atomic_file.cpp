// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/atomic_file.h>

#include <asperity/core/error.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace asperity::io {
namespace {

// Longest part of the target's name kept in the temporary one: names end at 255 bytes.
constexpr std::size_t kKeptName = 200;
constexpr int kNameTries = 100;
/// So many bytes are sent to the disk at a time.
constexpr std::int64_t kStartBytes = 1 << 20;

std::string folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

// How the temporary names for a target begin.
std::string temporary_stem(const std::string& target) {
    return fmt::format(".{}.tmp-",
                       std::filesystem::path(target).filename().string().substr(0, kKeptName));
}

// A name of its own for every process and call; O_EXCL settles the rest.
std::string temporary_name(const std::string& target) {
    static std::atomic<unsigned> counter{0};
    return fmt::format("{}/{}{}-{}", folder_of(target), temporary_stem(target), ::getpid(),
                       counter.fetch_add(1));
}

int open_retrying(const char* path, int flags, mode_t mode = 0) {
    int descriptor = -1;
    do {
        descriptor = ::open(path, flags | O_CLOEXEC, mode);
    } while (descriptor < 0 && errno == EINTR);
    return descriptor;
}

// Removes what killed programs have left of writing `target`: temporary files that nobody has
// locked.
void sweep(const std::string& target) {
    const std::string stem = temporary_stem(target);
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder_of(target), error), end; !error && at != end;
         at.increment(error)) {
        if (at->path().filename().string().rfind(stem, 0) != 0) continue;
        const int left = open_retrying(at->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
        if (left < 0) continue;
        struct ::stat status {};
        if (::fstat(left, &status) == 0 && S_ISREG(status.st_mode) &&
            ::flock(left, LOCK_EX | LOCK_NB) == 0)
            ::unlink(at->path().c_str());
        ::close(left);
    }
}

bool sync_descriptor(int descriptor) {
    int result = 0;
    do {
        result = ::fsync(descriptor);
    } while (result != 0 && errno == EINTR);
    // Devices, pipes and some network folders have nothing to sync, and say so.
    return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

}  // namespace

void check_stop(const Run* until) {
    if (until && until->stop_requested())
        throw Error(ErrorCode::Stopped, "stopped, nothing is written");
}

AtomicFile::AtomicFile(std::string path, const Run* until)
    : path_(std::move(path)), target_(path_), until_(until) {
    if (path_.empty()) throw Error(ErrorCode::InputOutput, "the file name is empty");
    struct ::stat status {};
    const bool exists = ::stat(path_.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) fail("cannot write");
    if (exists && S_ISDIR(status.st_mode))
        throw Error(ErrorCode::InputOutput, "cannot write: it is a folder", path_);

    direct_ = exists && !S_ISREG(status.st_mode);
    if (direct_) {
        temporary_ = path_;
        descriptor_ = open_retrying(path_.c_str(), O_WRONLY);
        if (descriptor_ < 0) fail("cannot open for writing");
        return;
    }
    if (exists) {
        // Renaming needs only the folder's permission; the file's own is respected all the same.
        if (::access(path_.c_str(), W_OK) != 0) fail("cannot write");
        std::error_code ignored;
        const auto resolved = std::filesystem::canonical(path_, ignored);
        if (!ignored) target_ = resolved.string();
    }
    open_temporary();
    if (exists && ::fchmod(descriptor_, status.st_mode & 07777) != 0) {
        const int error = errno;
        close_and_remove();
        errno = error;
        fail("cannot keep the permissions");
    }
}

AtomicFile::~AtomicFile() {
    close_and_remove();
}

void AtomicFile::open_temporary() {
    sweep(target_);
    for (int k = 0; k < kNameTries; ++k) {
        temporary_ = temporary_name(target_);
        descriptor_ = open_retrying(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (descriptor_ < 0 && errno != EEXIST) break;
        if (descriptor_ < 0) continue;
        // Locked, it is in use; one that was swept before is made anew
        ::flock(descriptor_, LOCK_EX | LOCK_NB);
        struct ::stat status {};
        if (::fstat(descriptor_, &status) == 0 && status.st_nlink > 0) return;
        ::close(std::exchange(descriptor_, -1));
    }
    fail("cannot create");
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        check_stop(until_);
        const std::size_t piece =
            until_ ? std::min(bytes.size(), static_cast<std::size_t>(kStartBytes)) : bytes.size();
        const ssize_t written = ::write(descriptor_, bytes.data(), piece);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = EIO;
        if (written <= 0) fail("cannot write");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        position_ += written;
    }
    if (!direct_ && position_ - started_ >= kStartBytes) start_writing_back();
}

/// Lets the disk begin with what is there, so that commit() has less to wait for. A hint: what goes
/// wrong shows when the file is synced.
void AtomicFile::start_writing_back() {
#ifdef SYNC_FILE_RANGE_WRITE
    ::sync_file_range(descriptor_, started_, position_ - started_, SYNC_FILE_RANGE_WRITE);
#endif
    started_ = position_;
}

void AtomicFile::seek(std::uint64_t position) {
    const auto wanted = static_cast<::off_t>(position);
    if (::lseek(descriptor_, wanted, SEEK_SET) != wanted) fail("cannot write");
    position_ = wanted;
}

void AtomicFile::commit() {
    if (!sync_descriptor(descriptor_)) fail("cannot write to the disk");
    // The descriptor is gone after close(), whatever it returns.
    if (::close(std::exchange(descriptor_, -1)) != 0) fail("cannot close");
    if (direct_) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot put in place");
    temporary_.clear();

    // The new name lasts only once the folder is on the disk too. A folder that may be written but
    // not read cannot be synced.
    const int folder = open_retrying(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY);
    if (folder < 0 && errno == EACCES) return;
    const bool synced = folder >= 0 && sync_descriptor(folder);
    const int error = errno;
    if (folder >= 0) ::close(folder);
    errno = error;
    if (!synced) fail("written, but cannot sync its folder");
}

void AtomicFile::fail(const char* what) const {
    const int error = errno;
    throw Error(ErrorCode::InputOutput,
                fmt::format("{}: {}", what, std::system_category().message(error)), path_);
}

void AtomicFile::close_and_remove() noexcept {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    if (!direct_ && !temporary_.empty()) ::unlink(temporary_.c_str());
    temporary_.clear();
}

void remove_file(const std::string& path) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    sweep(path);
}

}  // namespace asperity::io
