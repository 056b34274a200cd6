// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/tensor_file.h>

#include <asperity/formats/test_files.h>

#include <array>
#include <cstring>

namespace asperity::io {
namespace {

using namespace std::string_literals;
using test::error_of;
using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

constexpr std::array<std::uint16_t, 3> kA = {1, 2, 0x0304};
constexpr std::array<float, 2> kB = {1.0f, -2.0f};

// Two small fields written by hand, byte by byte, from docs/formats.md.
std::string golden() {
    return "tensor_file\0"s + "\x01\x00"s +
           "\x02\x00\x00\x00"s  // bytes 0 .. 17
                                // Field "a": u16 [3]; its data begin at the first multiple of 8
                                // behind the table.
           + "\x01\x00"s + "a" + "\x01\x00"s + "\x03"s + "\x48\0\0\0\0\0\0\0"s  // 18 .. 31
           + "\x03\0\0\0\0\0\0\0"s                                              // 32 .. 39
           // Field "bb": f32 [2, 1].
           + "\x02\x00"s + "bb" + "\x02\x00"s + "\x0a"s + "\x50\0\0\0\0\0\0\0"s  // 40 .. 54
           + "\x02\0\0\0\0\0\0\0"s + "\x01\0\0\0\0\0\0\0"s                       // 55 .. 70
           + std::string(1, '\0')                                                // 71
           + "\x01\x00\x02\x00\x04\x03"s + "\0\0"s                               // 72 .. 79
           + "\x00\x00\x80\x3f\x00\x00\x00\xc0"s;                                // 80 .. 87
}

std::vector<TensorBlock> blocks() {
    // "bb" in two parts.
    return {{"a", TensorType::U16, {3}, {std::as_bytes(std::span(kA))}},
            {"bb",
             TensorType::F32,
             {2, 1},
             {std::as_bytes(std::span(kB).first(1)), std::as_bytes(std::span(kB).last(1))}}};
}

// The container with the bytes at `place` replaced.
std::string golden_with(std::size_t place, const std::string& bytes) {
    return golden().replace(place, bytes.size(), bytes);
}

void expect_refused(const std::string& bytes, const std::string& part) {
    const TemporaryFolder folder;
    put(folder / "t.bin", bytes);
    expect_error(ErrorCode::InvalidInput, "t.bin: offset " + part,
                 [&] { TensorFile(folder / "t.bin").require_own_layout(); });
}

TEST(TensorFile, WritesTheDocumentedBytes) {
    const TemporaryFolder folder;
    write_tensor_file(folder / "t.bin", blocks());
    EXPECT_EQ(get(folder / "t.bin"), golden());
}

TEST(TensorFile, ReadsTheDocumentedBytes) {
    const TemporaryFolder folder;
    put(folder / "t.bin", golden());
    EXPECT_TRUE(looks_like_tensor_file(folder / "t.bin"));
    const TensorFile file(folder / "t.bin");
    file.require_own_layout();
    ASSERT_EQ(file.fields().size(), 2u);
    EXPECT_EQ(file.find("c"), nullptr);
    const TensorField& b = file.require("bb", TensorType::F32, 2);
    EXPECT_EQ(b.shape, (std::vector<std::uint64_t>{2, 1}));
    std::array<float, 1> second{};
    file.read(b, 4, std::as_writable_bytes(std::span(second)));
    EXPECT_EQ(second[0], -2.0f);
    expect_error(ErrorCode::InvalidInput, "offset 80: field 'bb' has 8 bytes",
                 [&] { file.read(b, 5, std::as_writable_bytes(std::span(second))); });
    expect_error(ErrorCode::InvalidInput, "field 'c' is missing",
                 [&] { file.require("c", TensorType::F32, 2); });
    expect_error(ErrorCode::InvalidInput, "offset 18: field 'a' has another type",
                 [&] { file.require("a", TensorType::U16, 2); });
}

TEST(TensorFile, EmptyArraysAndNoFields) {
    const TemporaryFolder folder;
    const std::vector<TensorBlock> empty = {{"none", TensorType::F64, {0, 7}, {}},
                                            {"scalar", TensorType::U16, {}, {}}};
    expect_error(ErrorCode::Usage, "field 'scalar' does not fill its shape",
                 [&] { write_tensor_file(folder / "t.bin", empty); });
    EXPECT_EQ(folder.files(), 0);
    write_tensor_file(folder / "t.bin", std::span(empty).first(1));
    EXPECT_EQ(TensorFile(folder / "t.bin").require("none", TensorType::F64, 2).bytes, 0u);
    write_tensor_file(folder / "t.bin", {});
    EXPECT_TRUE(TensorFile(folder / "t.bin").fields().empty());
}

TEST(TensorFile, RefusesWithOffsetAndReason) {
    expect_refused("", "0: the file ends inside its magic");
    expect_refused("t", "0: the file ends inside its magic");
    expect_refused("not_a_file_at_all_really", "0: not a tensor file");
    expect_refused(golden_with(12, "\x02"), "12: unknown version");
    expect_refused(golden_with(14, "\x00\x00\x00\x80"s), "14: 2147483648 fields claimed");
    expect_refused(golden_with(14, "\xff\xff\xff\xff"), "14: 4294967295 fields claimed");
    expect_refused(golden_with(14, "\x03"), "71: field 2 claims a name of 256 bytes");
    expect_refused(golden_with(18, "\xff\xff"), "18: field 0 claims a name of 65535 bytes");
    expect_refused(golden_with(20, "\xff"), "20: field 0 has a name that is no plain text");
    expect_refused(golden_with(21, "\xff\xff"), "21: field 'a' claims 65535 dimensions");
    expect_refused(golden_with(23, "\x0c"), "23: field 'a' has the unknown type 12");
    expect_refused(golden_with(23, "\x00"s), "23: field 'a' has the unknown type 0");
    expect_refused(golden_with(24, "\x08"), "18: field 'a' claims data at byte 8, inside");
    expect_refused(golden_with(24, "\x53"), "24: field 'a' claims 6 bytes from byte 83 on, the");
    expect_refused(golden_with(24, std::string(8, '\xff')), "24: field 'a' claims 6 bytes from");
    expect_refused(golden_with(32, "\x00\x00\x20"s),
                   "24: field 'a' claims 4194304 bytes, the file has 88");
    expect_refused(golden_with(32, std::string(8, '\xff')), "24: field 'a' claims more than 2^64");
    // 2^63 * 2 * 4 bytes: the product wraps to zero in 64 bits.
    expect_refused(golden_with(55, "\0\0\0\0\0\0\0\x80\x02"s), "47: field 'bb' claims more than");
    expect_refused(golden_with(71, "x"), "71: bytes between two fields are not zero");
    expect_refused(golden() + "x", "88: 1 bytes follow the last field");
    expect_refused(golden_with(24, "\x50"), "18: field 'a' begins at byte 80, not at 72");
    const std::string entry = golden().substr(18, 22);
    expect_refused(golden().substr(0, 40) + entry + golden().substr(62),
                   "40: field 'a' appears twice");
}

TEST(TensorFile, RefusesEveryCut) {
    const TemporaryFolder folder;
    put(folder / "t.bin", golden());
    test::with_each_cut(folder / "t.bin", [&](std::uintmax_t length) {
        const auto error = error_of([&] { TensorFile(folder / "t.bin").require_own_layout(); });
        ASSERT_TRUE(error) << length;
        EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
    });
}

TEST(TensorFile, DamagedTablesNeverCrash) {
    const TemporaryFolder folder;
    put(folder / "t.bin", golden());
    test::with_each_byte_damaged(folder / "t.bin", 71, [&](std::size_t) {
        const auto error = error_of([&] {
            const TensorFile file(folder / "t.bin");
            for (const TensorField& field : file.fields()) {
                std::vector<std::byte> bytes(static_cast<std::size_t>(field.bytes));
                file.read(field, 0, bytes);
            }
        });
        EXPECT_TRUE(!error || error->code() == ErrorCode::InvalidInput) << error->what();
    });
}

TEST(TensorFile, RefusesFoldersAndMissingFiles) {
    const TemporaryFolder folder;
    EXPECT_FALSE(looks_like_tensor_file(folder.path()));
    EXPECT_FALSE(looks_like_tensor_file(folder / "none"));
    expect_error(ErrorCode::InputOutput, "folder", [&] { TensorFile{folder.path()}; });
    expect_error(ErrorCode::InputOutput, "none: cannot open", [&] { TensorFile{folder / "none"}; });
}

}  // namespace
}  // namespace asperity::io
