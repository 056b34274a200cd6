// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/core/printable.h>
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace asperity::io {

static_assert(std::endian::native == std::endian::little, "the readers swap big-endian numbers");

/// Bytes of a file with every access checked: Error(InvalidInput, path) beyond the end.
class BinaryView {
  public:
    BinaryView(std::span<const std::byte> bytes, const std::string& path)
        : bytes_(bytes), path_(path) {}

    std::size_t size() const { return bytes_.size(); }
    const std::string& path() const { return path_; }

    /// Throws unless `count` items of `bytes` bytes stand at `at`. No overflow.
    void need(std::uint64_t at, std::uint64_t count, std::uint64_t bytes = 1) const {
        if (at <= size() && (count == 0 || (size() - at) / bytes >= count)) return;
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("{} x {} bytes are needed from byte {} on, the file ends at {}",
                                count, bytes, at, size()),
                    path_);
    }

    template <typename Number>
    Number little(std::uint64_t at) const {
        need(at, 1, sizeof(Number));
        Number value;
        std::memcpy(&value, bytes_.data() + at, sizeof value);
        return value;
    }

    template <typename Number>
    Number big(std::uint64_t at) const {
        need(at, 1, sizeof(Number));
        std::byte swapped[sizeof(Number)];
        for (std::size_t k = 0; k < sizeof(Number); ++k)
            swapped[k] = bytes_[static_cast<std::size_t>(at) + sizeof(Number) - 1 - k];
        Number value;
        std::memcpy(&value, swapped, sizeof value);
        return value;
    }

    /// `length` bytes up to the first NUL, without blanks at both ends.
    std::string text(std::uint64_t at, std::uint64_t length) const {
        need(at, length);
        const std::string_view all(reinterpret_cast<const char*>(bytes_.data()) + at,
                                   static_cast<std::size_t>(length));
        return std::string(trimmed(all.substr(0, all.find('\0'))));
    }

    std::span<const std::byte> part(std::uint64_t at, std::uint64_t length) const {
        need(at, length);
        return bytes_.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(length));
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(ErrorCode::InvalidInput, printable(why), path_);
    }

  private:
    std::span<const std::byte> bytes_;
    std::string path_;
};

/// Kinds of numbers that files of heights are made of.
enum class NumberType { U8, I8, U16, I16, U32, I32, I64, F32, F64 };

inline std::uint64_t size_of(NumberType type) {
    switch (type) {
        case NumberType::U8:
        case NumberType::I8:
            return 1;
        case NumberType::U16:
        case NumberType::I16:
            return 2;
        case NumberType::U32:
        case NumberType::I32:
        case NumberType::F32:
            return 4;
        case NumberType::I64:
        case NumberType::F64:
            return 8;
    }
    return 8;
}

/// The number at `at` as a double, little-endian unless `big`.
inline double number_at(const BinaryView& view, NumberType type, std::uint64_t at,
                        bool big = false) {
    const auto get = [&]<typename Number>(Number) {
        return static_cast<double>(big ? view.big<Number>(at) : view.little<Number>(at));
    };
    switch (type) {
        case NumberType::U8:
            return get(std::uint8_t{});
        case NumberType::I8:
            return get(std::int8_t{});
        case NumberType::U16:
            return get(std::uint16_t{});
        case NumberType::I16:
            return get(std::int16_t{});
        case NumberType::U32:
            return get(std::uint32_t{});
        case NumberType::I32:
            return get(std::int32_t{});
        case NumberType::I64:
            return get(std::int64_t{});
        case NumberType::F32:
            return get(float{});
        case NumberType::F64:
            return get(double{});
    }
    return 0;
}

}  // namespace asperity::io
