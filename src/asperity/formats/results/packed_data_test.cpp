// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/packed_data.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <stdexcept>

namespace asperity::io {
namespace {

/// Sums of energies, many of them zero: as a result holds them.
std::vector<std::byte> content(std::size_t bytes) {
    std::mt19937_64 engine(bytes);
    std::vector<std::byte> all(bytes);
    for (std::size_t k = 0; k + 8 <= bytes; k += 8)
        if (engine() % 4 == 0) {
            const std::uint64_t energy = engine() >> 20;
            std::memcpy(&all[k], &energy, sizeof energy);
        }
    return all;
}

TEST(PackedData, ComesBackWholeAndInPieces) {
    for (const std::size_t bytes :
         {std::size_t{70000}, std::size_t{1} << 20, (std::size_t{5} << 20) + 4321}) {
        const std::vector<std::byte> all = content(bytes);
        // In parts of uneven sizes, one of them empty
        const std::span whole(all);
        const std::vector<std::span<const std::byte>> parts{whole.first(bytes / 3), whole.first(0),
                                                            whole.subspan(bytes / 3, 7),
                                                            whole.subspan(bytes / 3 + 7)};
        const std::vector<std::byte> packed = pack(parts);
        ASSERT_FALSE(packed.empty());
        EXPECT_LT(packed.size(), bytes / 2);
        const PackedData data(packed, bytes);
        std::vector<std::byte> back(bytes);
        data.read(0, back);
        EXPECT_TRUE(back == all);
        for (std::size_t begin = 0; begin < bytes; begin += bytes / 5 + 1) {
            const std::size_t count = std::min(bytes - begin, bytes / 4);
            std::vector<std::byte> piece(count);
            data.read(begin, piece);
            EXPECT_TRUE(std::equal(piece.begin(), piece.end(),
                                   all.begin() + static_cast<std::ptrdiff_t>(begin)));
        }
    }
}

// Bytes sorted by their place in a number: zeros and low bytes lie side by side.
TEST(PackedData, NumbersComeBackFromSortedBytes) {
    for (const std::size_t width : {std::size_t{2}, std::size_t{4}, std::size_t{8}}) {
        const std::size_t bytes = (std::size_t{3} << 20) + 8 * 4321;
        const std::vector<std::byte> all = content(bytes);
        const std::span<const std::byte> part(all);
        const std::vector<std::byte> packed = pack(std::span(&part, 1), width);
        ASSERT_FALSE(packed.empty());
        const PackedData data(packed, bytes, width);
        std::vector<std::byte> back(bytes);
        data.read(0, back);
        EXPECT_TRUE(back == all);
        // Into places that begin and end inside of frames, one of them empty
        std::vector<std::byte> pieces(bytes);
        const std::span<std::byte> place(pieces);
        const std::size_t cut = (std::size_t{2} << 20) + 100;
        const std::vector<std::span<std::byte>> places = {
            place.first(10), place.subspan(10, 0), place.subspan(10, cut - 10), place.subspan(cut)};
        data.read_parts(places);
        EXPECT_TRUE(pieces == all);
    }
    // Numbers of two bytes, one by chance and a nine: first come all those by chance
    std::vector<std::byte> numbers;
    std::mt19937_64 engine(3);
    for (std::size_t n = 0; n < 40000; ++n) {
        numbers.push_back(static_cast<std::byte>(engine()));
        numbers.push_back(std::byte{9});
    }
    const std::span<const std::byte> part(numbers);
    std::vector<std::byte> sorted(numbers.size());
    const std::vector<std::byte> packed = pack(std::span(&part, 1), 2);
    EXPECT_LT(packed.size(), 41000u);
    PackedData(packed, numbers.size()).read(0, sorted);
    for (std::size_t n = 0; n < 40000; ++n) {
        ASSERT_EQ(sorted[n], numbers[2 * n]);
        ASSERT_EQ(sorted[40000 + n], std::byte{9});
    }
}

TEST(PackedData, WhatIsNotWorthItStaysAsItIs) {
    const auto is_packed = [](const std::vector<std::byte>& all) {
        const std::span<const std::byte> part(all);
        return !pack(std::span(&part, 1)).empty();
    };
    EXPECT_FALSE(is_packed({}));
    EXPECT_FALSE(is_packed(content(1000)));
    std::vector<std::byte> noise(1 << 20);
    std::mt19937_64 engine(1);
    for (std::byte& b : noise) b = static_cast<std::byte>(engine());
    EXPECT_FALSE(is_packed(noise));
}

// Zeros would make a small file that asks for much memory.
TEST(PackedData, NothingBecomesTooSmall) {
    for (const std::size_t bytes : {std::size_t{70000}, std::size_t{8} << 20}) {
        const std::vector<std::byte> zeros(bytes);
        const std::span<const std::byte> part(zeros);
        const std::vector<std::byte> packed = pack(std::span(&part, 1));
        EXPECT_GE(packed.size(), bytes / kMostPacked + 1);
        EXPECT_LE(packed.size(), bytes / kMostPacked + 9);
        std::vector<std::byte> back(bytes, std::byte{1});
        PackedData(packed, bytes).read(0, back);
        EXPECT_TRUE(back == zeros);
        // What fills up stands behind all else, once, and nothing behind it
        for (const std::size_t cut : {std::size_t{1}, std::size_t{40}}) {
            std::vector<std::byte> other(packed.begin(),
                                         packed.end() - static_cast<std::ptrdiff_t>(cut));
            EXPECT_THROW(PackedData(other, bytes), std::runtime_error);
        }
        std::vector<std::byte> longer = packed;
        longer.push_back(std::byte{0});
        EXPECT_THROW(PackedData(longer, bytes), std::runtime_error);
    }
}

TEST(PackedData, DamageIsFound) {
    const std::vector<std::byte> all = content(3 << 20);
    const std::span<const std::byte> part(all);
    const std::vector<std::byte> packed = pack(std::span(&part, 1));
    const auto same = [&](std::vector<std::byte> frames, std::uint64_t bytes) {
        try {
            const PackedData data(std::move(frames), bytes);
            std::vector<std::byte> back(static_cast<std::size_t>(bytes));
            data.read(0, back);
            return back == all;
        } catch (const std::runtime_error&) {
            return false;
        }
    };
    ASSERT_TRUE(same(packed, all.size()));
    EXPECT_FALSE(same(packed, all.size() - 1));
    EXPECT_FALSE(same(packed, all.size() + 1));
    std::vector<std::byte> longer = packed;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(same(longer, all.size()));
    for (std::size_t cut = 0; cut < packed.size(); cut += packed.size() / 50)
        EXPECT_FALSE(
            same({packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(cut)}, all.size()));
    // Single bits are for the checksums of a result: some say nothing to the unpacker
}

}  // namespace
}  // namespace asperity::io
