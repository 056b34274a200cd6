// SPDX-License-Identifier: Apache-2.0
// The tensor container of docs/formats.md: named arrays in one file, which NumPy readers of RGL and
// Mitsuba measurements open. All numbers little-endian:
//
//     "tensor_file\0"  u8 1  u8 0  u32 fields
//     per field: u16 length, name, u16 dimensions, u8 type, u64 offset of the data, u64 shape[...]
//     per field: the data, row-major, beginning at a multiple of 8 bytes
//
// Ours goes beyond that in one thing: 128 is added to the type of a field whose data are packed, a
// u64 with the number of bytes that follow, and these, zstd frames of 1 MiB of content each. 64
// more says that in each frame the first bytes of all numbers come first, then the second ones and
// so on.
#pragma once

#include <asperity/core/run.h>
#include <asperity/formats/read_file.h>
#include <asperity/formats/results/packed_data.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Type of the numbers of a field; the values are those of the file.
enum class TensorType : std::uint8_t {
    U8 = 1,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F16,
    F32,
    F64,
};

/// Bytes of one number.
std::uint64_t size_of(TensorType type);

/// A field to write. `parts` are written one after another and together hold product(shape)
/// numbers: an array that is scattered in memory need not be copied together.
struct TensorBlock {
    std::string name;
    TensorType type = TensorType::U8;
    std::vector<std::uint64_t> shape;
    std::vector<std::span<const std::byte>> parts;
    std::span<const std::byte> packed = {};  ///< what pack() makes of the parts, if it is to be so
    bool sorted = false;                     ///< ... with the width of the type
};

/// A field found in a file.
struct TensorField {
    std::string name;
    TensorType type = TensorType::U8;
    std::vector<std::uint64_t> shape;
    std::uint64_t offset = 0;  ///< of its data in the file
    std::uint64_t bytes = 0;   ///< product(shape) * size_of(type)
    std::uint64_t stored = 0;  ///< bytes from `offset` on: fewer where they are packed
    bool packed = false;
    bool sorted = false;      ///< its bytes are, in each frame
    std::uint64_t entry = 0;  ///< offset of its entry in the table
};

/// What a reader accepts at most.
inline constexpr std::uint32_t kMaxTensorFields = 4096;
inline constexpr std::uint16_t kMaxTensorName = 255;
inline constexpr std::uint16_t kMaxTensorDimensions = 16;

/// Writes a container, whole or not at all (AtomicFile, and its `until`). Throws Error(InputOutput,
/// path), and Error(Usage, path) when a name, a shape or the parts do not fit the format.
void write_tensor_file(const std::string& path, std::span<const TensorBlock> blocks,
                       const Run* until = nullptr);

/// True when the file begins with the container's magic and version; false for anything else.
bool looks_like_tensor_file(const std::string& path);

/// A container open for reading. Opening reads and checks the table alone; every claimed size has
/// then been compared with the bytes in the file. Errors name file, byte offset and reason:
/// Error(InvalidInput, path), Error(InputOutput, path).
class TensorFile {
  public:
    explicit TensorFile(const std::string& path);

    const std::string& path() const { return file_.path(); }
    const std::vector<TensorField>& fields() const { return fields_; }

    /// nullptr when there is no such field.
    const TensorField* find(std::string_view name) const;
    /// The field, which must have this type and this many dimensions.
    const TensorField& require(std::string_view name, TensorType type,
                               std::size_t dimensions) const;

    /// Fills `bytes` from byte `begin` of the field's data on. Both must lie inside the field. By
    /// one thread at a time: of a packed field all frames are kept until another one is read.
    void read(const TensorField& field, std::uint64_t begin, std::span<std::byte> bytes) const;

    /// Fills the parts, one after the other, with all of the field: of a packed one on all threads.
    void read_parts(const TensorField& field, std::span<const std::span<std::byte>> parts) const;

    /// The same as read() for the bytes as they are stored, `stored` of them.
    void read_stored(const TensorField& field, std::uint64_t begin,
                     std::span<std::byte> bytes) const {
        file_.read(field.offset + begin, bytes);
    }

    /// Refuses a file that is not laid out as write_tensor_file does it: fields in the order of the
    /// table, zero bytes between them, nothing behind the last.
    void require_own_layout() const;

    [[noreturn]] void fail(std::uint64_t offset, const std::string& why) const;

  private:
    /// Calls read(PackedData) with the field's.
    template <class Read>
    void unpacking(const TensorField& field, Read read) const;

    InputFile file_;
    std::uint64_t table_end_ = 0;
    std::vector<TensorField> fields_;
    mutable const TensorField* unpacked_ = nullptr;
    mutable std::optional<PackedData> frames_;  ///< of that field
};

}  // namespace asperity::io
