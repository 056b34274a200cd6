// SPDX-License-Identifier: Apache-2.0
#include <Iex.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/exr/exr_stream.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

namespace asperity::io {

namespace {

/// A file for OpenEXR to write to. OpenEXR writes its tables of offsets while it closes a file and
/// keeps silent about what goes wrong then; this stream remembers.
class ExrStream : public Imf::OStream {
  public:
    explicit ExrStream(const std::string& path)
        : Imf::OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb"), &std::fclose) {
        note(file_ != nullptr);
    }

    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (file_) note(std::fwrite(bytes, 1, size, file_.get()) == size);
        if (error_ != 0) throw Iex::ErrnoExc(std::strerror(error_));
    }
    std::uint64_t tellp() override {
        return file_ ? static_cast<std::uint64_t>(std::ftell(file_.get())) : 0;
    }
    void seekp(std::uint64_t position) override {
        if (file_) note(std::fseek(file_.get(), static_cast<long>(position), SEEK_SET) == 0);
        if (error_ != 0) throw Iex::ErrnoExc(std::strerror(error_));
    }

    /// Closes the file. The first error of all, as errno, or 0.
    int close() {
        if (file_) note(std::fclose(file_.release()) == 0);
        return error_;
    }

  private:
    void note(bool fine) {
        if (!fine && error_ == 0) error_ = errno != 0 ? errno : EIO;
    }

    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    int error_ = 0;
};

}  // namespace

void write_exr(const std::string& path, const std::function<void(Imf::OStream&)>& write) {
    AtomicFile file(path);
    ExrStream stream(file.temporary_path());
    std::string reason;
    try {
        write(stream);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "no memory to write the EXR", path);
    } catch (const std::exception& error) {  // OpenEXR throws Iex::BaseExc
        reason = error.what();
    }
    const int failure = stream.close();
    if (failure != 0) reason = std::strerror(failure);
    if (!reason.empty())
        throw Error(ErrorCode::InputOutput, fmt::format("cannot write the EXR ({})", reason), path);
    file.commit();
}

}  // namespace asperity::io
