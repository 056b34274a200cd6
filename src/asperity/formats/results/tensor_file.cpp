// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/tensor_file.h>

#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace asperity::io {

static_assert(std::endian::native == std::endian::little, "the container is little-endian");

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "tensor_file\0"sv;
constexpr std::string_view kVersion = "\x01\x00"sv;
constexpr std::uint64_t kHeaderBytes = 12 + 2 + 4;
constexpr std::uint64_t kAlignment = 8;
constexpr std::uint8_t kPacked = 128;  ///< beside the type
constexpr std::uint8_t kSorted = 64;   ///< likewise, of packed fields

// No table that keeps the limits is longer.
constexpr std::uint64_t kMaxTableBytes =
    kHeaderBytes +
    std::uint64_t{kMaxTensorFields} * (2 + kMaxTensorName + 2 + 1 + 8 + 8 * kMaxTensorDimensions);

std::uint64_t aligned(std::uint64_t offset) {
    return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

// product(shape) * size_of(type); nothing when it does not fit 64 bits.
std::optional<std::uint64_t> data_bytes(TensorType type, std::span<const std::uint64_t> shape) {
    if (std::find(shape.begin(), shape.end(), 0u) != shape.end()) return 0;
    std::uint64_t bytes = size_of(type);
    for (const std::uint64_t extent : shape)
        if (__builtin_mul_overflow(bytes, extent, &bytes)) return std::nullopt;
    return bytes;
}

template <typename Number>
void append(std::string& text, Number number) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    text.append(bytes.data(), bytes.size());
}

// Reads the table from front to back; every step asks first whether the bytes are there.
class TableReader {
  public:
    TableReader(const InputFile& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    std::uint64_t place() const { return place_; }

    template <typename Number>
    Number number(const std::string& what) {
        Number value;
        std::memcpy(&value, text(sizeof(Number), what).data(), sizeof(Number));
        return value;
    }

    std::string_view text(std::uint64_t length, const std::string& what) {
        if (length > bytes_.size() - place_)
            fail(place_, fmt::format("the file ends inside {}", what));
        const auto part =
            bytes_.substr(static_cast<std::size_t>(place_), static_cast<std::size_t>(length));
        place_ += length;
        return part;
    }

    [[noreturn]] void fail(std::uint64_t offset, const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, fmt::format("offset {}: {}", offset, why),
                    file_.path());
    }

  private:
    const InputFile& file_;
    std::string_view bytes_;
    std::uint64_t place_ = 0;
};

void check_place(const TableReader& table, const TensorField& field, const std::string& what,
                 std::uint64_t file_size, std::uint64_t place) {
    if (field.stored > file_size)
        table.fail(place, fmt::format("{} claims {} bytes, the file has {}", what, field.stored,
                                      file_size));
    if (field.offset > file_size - field.stored)
        table.fail(place, fmt::format("{} claims {} bytes from byte {} on, the file has {}", what,
                                      field.stored, field.offset, file_size));
}

void read_shape(TableReader& table, TensorField& field, const std::string& what,
                std::uint64_t file_size) {
    const std::uint64_t place = table.place();
    const auto dimensions = table.number<std::uint16_t>(what);
    if (dimensions > kMaxTensorDimensions)
        table.fail(place, fmt::format("{} claims {} dimensions, at most {} are allowed", what,
                                      dimensions, kMaxTensorDimensions));
    const std::uint64_t type_place = table.place();
    const auto stored_type = table.number<std::uint8_t>(what);
    field.packed = (stored_type & kPacked) != 0;
    field.sorted = field.packed && (stored_type & kSorted) != 0;
    const int type = stored_type & ~(kPacked | (field.sorted ? kSorted : 0));
    if (type < 1 || type > static_cast<int>(TensorType::F64))
        table.fail(type_place, fmt::format("{} has the unknown type {}", what, stored_type));
    field.type = static_cast<TensorType>(type);

    const std::uint64_t offset_place = table.place();
    field.offset = table.number<std::uint64_t>(what);
    for (int k = 0; k < dimensions; ++k) field.shape.push_back(table.number<std::uint64_t>(what));

    const auto bytes = data_bytes(field.type, field.shape);
    if (!bytes) table.fail(offset_place, what + " claims more than 2^64 bytes");
    field.bytes = *bytes;
    field.stored = field.packed ? sizeof(std::uint64_t) : *bytes;
    if (field.packed && *bytes / kMostPacked > file_size)
        table.fail(offset_place, fmt::format("{} claims {} bytes, packed into a file of {}", what,
                                             *bytes, file_size));
    check_place(table, field, what, file_size, offset_place);
}

/// Packed data say themselves how many bytes they are.
void read_packed_size(const InputFile& file, const TableReader& table, TensorField& field) {
    std::uint64_t size = 0;
    file.read(field.offset, std::as_writable_bytes(std::span(&size, 1)));
    const std::string what = fmt::format("field '{}'", field.name);
    if (size > file.size())
        table.fail(field.offset, fmt::format("{} claims {} packed bytes, the file has {}", what,
                                             size, file.size()));
    if (field.bytes / kMostPacked > size)
        table.fail(field.offset,
                   fmt::format("{} claims {} bytes, packed into {}", what, field.bytes, size));
    field.stored = sizeof size + size;
    check_place(table, field, what, file.size(), field.offset);
}

TensorField read_entry(TableReader& table, std::uint32_t number, std::uint64_t file_size) {
    const std::string what = fmt::format("field {}", number);
    TensorField field;
    field.entry = table.place();
    const auto length = table.number<std::uint16_t>(what);
    if (length == 0 || length > kMaxTensorName)
        table.fail(field.entry, fmt::format("{} claims a name of {} bytes, 1 to {} are allowed",
                                            what, length, kMaxTensorName));
    const std::uint64_t name_place = table.place();
    field.name = table.text(length, what);
    for (const char c : field.name)
        if (c < ' ' || c > '~') table.fail(name_place, what + " has a name that is no plain text");
    read_shape(table, field, fmt::format("field '{}'", field.name), file_size);
    return field;
}

std::vector<TensorField> read_table(TableReader& table, std::uint64_t file_size) {
    if (table.text(kMagic.size(), "its magic") != kMagic)
        table.fail(0, "not a tensor file (wrong magic)");
    if (table.text(kVersion.size(), "its version") != kVersion)
        table.fail(kMagic.size(), "unknown version of the tensor file");
    const std::uint64_t count_place = table.place();
    const auto count = table.number<std::uint32_t>("the number of fields");
    if (count > kMaxTensorFields)
        table.fail(count_place, fmt::format("{} fields claimed, at most {} are allowed", count,
                                            kMaxTensorFields));
    std::vector<TensorField> fields;
    for (std::uint32_t k = 0; k < count; ++k) {
        TensorField field = read_entry(table, k, file_size);
        for (const TensorField& other : fields)
            if (other.name == field.name)
                table.fail(field.entry, fmt::format("field '{}' appears twice", field.name));
        fields.push_back(std::move(field));
    }
    for (const TensorField& field : fields)
        if (field.offset < table.place())
            table.fail(field.entry,
                       fmt::format("field '{}' claims data at byte {}, inside the table",
                                   field.name, field.offset));
    return fields;
}

void check_block(const std::string& path, const TensorBlock& block) {
    const auto refuse = [&](const char* why) {
        throw Error(ErrorCode::Usage, fmt::format("field '{}' {}", block.name, why), path);
    };
    if (block.name.empty() || block.name.size() > kMaxTensorName) refuse("has no fitting name");
    if (block.shape.size() > kMaxTensorDimensions) refuse("has too many dimensions");
    std::uint64_t bytes = 0;
    for (const auto part : block.parts) bytes += part.size();
    if (data_bytes(block.type, block.shape) != bytes) refuse("does not fill its shape");
}

std::uint64_t table_bytes(std::span<const TensorBlock> blocks) {
    std::uint64_t bytes = kHeaderBytes;
    for (const TensorBlock& block : blocks)
        bytes += 2 + block.name.size() + 2 + 1 + 8 + 8 * block.shape.size();
    return bytes;
}

/// Bytes of a block in the file.
std::uint64_t stored_bytes(const TensorBlock& block) {
    return block.packed.empty() ? *data_bytes(block.type, block.shape)
                                : sizeof(std::uint64_t) + block.packed.size();
}

std::uint8_t stored_type(const TensorBlock& block) {
    const auto type = static_cast<std::uint8_t>(block.type);
    if (block.packed.empty()) return type;
    return static_cast<std::uint8_t>(type | kPacked | (block.sorted ? kSorted : 0));
}

std::string padding(std::uint64_t offset) {
    return std::string(static_cast<std::size_t>(aligned(offset) - offset), '\0');
}

}  // namespace

std::uint64_t size_of(TensorType type) {
    constexpr std::array<std::uint64_t, 12> kSizes = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

void write_tensor_file(const std::string& path, std::span<const TensorBlock> blocks,
                       const Run* until) {
    for (const TensorBlock& block : blocks) check_block(path, block);
    if (blocks.size() > kMaxTensorFields)
        throw Error(ErrorCode::Usage, fmt::format("{} fields are too many", blocks.size()), path);

    // The table, with the place of every block.
    std::string table = std::string(kMagic) + std::string(kVersion);
    append(table, static_cast<std::uint32_t>(blocks.size()));
    std::uint64_t end = table_bytes(blocks);
    for (const TensorBlock& block : blocks) {
        append(table, static_cast<std::uint16_t>(block.name.size()));
        table += block.name;
        append(table, static_cast<std::uint16_t>(block.shape.size()));
        append(table, stored_type(block));
        append(table, aligned(end));
        for (const std::uint64_t extent : block.shape) append(table, extent);
        end = aligned(end) + stored_bytes(block);
    }

    // The table and the blocks, each after its padding.
    AtomicFile file(path, until);
    file.write(table);
    end = table.size();
    for (const TensorBlock& block : blocks) {
        file.write(padding(end));
        if (block.packed.empty()) {
            for (const auto part : block.parts) file.write(part);
        } else {
            const std::uint64_t size = block.packed.size();
            file.write(std::as_bytes(std::span(&size, 1)));
            file.write(block.packed);
        }
        end = aligned(end) + stored_bytes(block);
    }
    file.commit();
}

bool looks_like_tensor_file(const std::string& path) {
    try {
        const InputFile file(path);
        std::string start(kMagic.size() + kVersion.size(), ' ');
        file.read(0, std::as_writable_bytes(std::span(start)));
        return start == std::string(kMagic) + std::string(kVersion);
    } catch (const Error&) {
        return false;
    }
}

TensorFile::TensorFile(const std::string& path) : file_(path) {
    std::string start(static_cast<std::size_t>(std::min(file_.size(), kMaxTableBytes)), '\0');
    file_.read(0, std::as_writable_bytes(std::span(start)));
    TableReader table(file_, start);
    fields_ = read_table(table, file_.size());
    table_end_ = table.place();
    for (TensorField& field : fields_)
        if (field.packed) read_packed_size(file_, table, field);
}

const TensorField* TensorFile::find(std::string_view name) const {
    for (const TensorField& field : fields_)
        if (field.name == name) return &field;
    return nullptr;
}

const TensorField& TensorFile::require(std::string_view name, TensorType type,
                                       std::size_t dimensions) const {
    const TensorField* field = find(name);
    if (field == nullptr) fail(kHeaderBytes, fmt::format("field '{}' is missing", name));
    if (field->type != type || field->shape.size() != dimensions)
        fail(field->entry, fmt::format("field '{}' has another type or number of dimensions than "
                                       "expected",
                                       name));
    return *field;
}

void TensorFile::read(const TensorField& field, std::uint64_t begin,
                      std::span<std::byte> bytes) const {
    if (begin > field.bytes || bytes.size() > field.bytes - begin)
        fail(field.offset, fmt::format("field '{}' has {} bytes, {} from {} on were asked for",
                                       field.name, field.bytes, bytes.size(), begin));
    if (!field.packed) {
        file_.read(field.offset + begin, bytes);
        return;
    }
    unpacking(field, [&](const PackedData& data) { data.read(begin, bytes); });
}

void TensorFile::read_parts(const TensorField& field,
                            std::span<const std::span<std::byte>> parts) const {
    std::uint64_t begin = 0;
    for (const auto part : parts) begin += part.size();
    if (begin != field.bytes)
        fail(field.offset, fmt::format("field '{}' has {} bytes, {} were asked for", field.name,
                                       field.bytes, begin));
    if (field.packed) {
        unpacking(field, [&](const PackedData& data) { data.read_parts(parts); });
        return;
    }
    begin = field.offset;
    for (const auto part : parts) {
        file_.read(begin, part);
        begin += part.size();
    }
}

template <class Read>
void TensorFile::unpacking(const TensorField& field, Read read) const {
    try {
        if (unpacked_ != &field) {
            unpacked_ = nullptr;
            std::vector<std::byte> frames(
                static_cast<std::size_t>(field.stored - sizeof(std::uint64_t)));
            file_.read(field.offset + sizeof(std::uint64_t), frames);
            frames_.emplace(std::move(frames), field.bytes,
                            field.sorted ? static_cast<std::size_t>(size_of(field.type)) : 1);
            unpacked_ = &field;
        }
        read(*frames_);
    } catch (const std::runtime_error& error) {
        fail(field.offset, fmt::format("field '{}' is damaged: {}", field.name, error.what()));
    }
}

void TensorFile::require_own_layout() const {
    std::uint64_t end = table_end_;
    for (const TensorField& field : fields_) {
        if (field.offset != aligned(end))
            fail(field.entry, fmt::format("field '{}' begins at byte {}, not at {}", field.name,
                                          field.offset, aligned(end)));
        std::string gap(static_cast<std::size_t>(aligned(end) - end), 'x');
        file_.read(end, std::as_writable_bytes(std::span(gap)));
        if (gap != padding(end)) fail(end, "bytes between two fields are not zero");
        end = field.offset + field.stored;
    }
    if (end != file_.size())
        fail(end, fmt::format("{} bytes follow the last field", file_.size() - end));
}

void TensorFile::fail(std::uint64_t offset, const std::string& why) const {
    throw Error(ErrorCode::InvalidInput, fmt::format("offset {}: {}", offset, why), path());
}

}  // namespace asperity::io
