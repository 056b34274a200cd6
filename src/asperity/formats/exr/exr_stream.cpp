// SPDX-License-Identifier: Apache-2.0
#include <Iex.h>
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/exr/exr_stream.h>
#include <fmt/format.h>

#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>

namespace asperity::io {

namespace {

/// A file for OpenEXR to write to. OpenEXR writes its tables of offsets while it closes a file and
/// keeps silent about what goes wrong then; this stream remembers.
class ExrStream : public Imf::OStream {
  public:
    explicit ExrStream(AtomicFile& file) : Imf::OStream(file.path().c_str()), file_(file) {}

    void write(const char bytes[], int count) override {
        noting([&] {
            waiting_.append(bytes, static_cast<std::size_t>(count));
            if (waiting_.size() >= kMostWaiting) flush();
        });
    }
    std::uint64_t tellp() override { return file_.position() + waiting_.size(); }
    void seekp(std::uint64_t position) override {
        noting([&] {
            flush();
            file_.seek(position);
        });
    }

    /// Writes what waits, and throws the first error of all.
    void finish() {
        if (!error_) flush();
        if (error_) throw Error(*error_);
    }

  private:
    static constexpr std::size_t kMostWaiting = 1 << 16;

    void flush() {
        const std::string bytes = std::exchange(waiting_, {});
        file_.write(bytes);
    }
    template <class Work>
    void noting(Work work) {
        try {
            if (!error_) work();
        } catch (const Error& error) {
            error_ = error;
        }
        if (error_) throw Iex::IoExc(error_->message());
    }

    AtomicFile& file_;
    std::string waiting_;  ///< OpenEXR writes number by number
    std::optional<Error> error_;
};

}  // namespace

void write_exr(const std::string& path, const std::function<void(Imf::OStream&)>& write,
               const Run* until) {
    AtomicFile file(path, until);
    ExrStream stream(file);
    std::string reason;
    try {
        write(stream);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "no memory to write the EXR", path);
    } catch (const std::exception& error) {  // OpenEXR throws Iex::BaseExc
        reason = error.what();
    }
    stream.finish();
    if (!reason.empty())
        throw Error(ErrorCode::InputOutput, fmt::format("cannot write the EXR ({})", reason), path);
    file.commit();
}

}  // namespace asperity::io
