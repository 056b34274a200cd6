// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/tensor_file.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace asperity::io {

/// 128 bits, low word first.
using Digest = std::array<std::uint64_t, 2>;

/// XXH3-128 over all that a field says: name, type, shape and numbers.
class FieldDigest {
  public:
    /// `sorted`: of bytes that are (TensorField::sorted).
    FieldDigest(std::string_view name, TensorType type, std::span<const std::uint64_t> shape,
                bool sorted = false);
    ~FieldDigest();
    FieldDigest(const FieldDigest&) = delete;
    FieldDigest& operator=(const FieldDigest&) = delete;

    void update(std::span<const std::byte> bytes);
    Digest finish() const;

  private:
    XXH3_state_s* state_;
};

Digest digest_of(const TensorBlock& block);
/// Reads the field through a small buffer.
Digest digest_of(const TensorFile& file, const TensorField& field);

/// The same over the bytes as they are stored: another one for packed fields alone.
Digest stored_digest_of(const TensorBlock& block);
Digest stored_digest_of(const TensorFile& file, const TensorField& field);

/// 32 hexadecimal digits over a list of digests.
std::string checksum_of(std::span<const Digest> digests);

}  // namespace asperity::io
