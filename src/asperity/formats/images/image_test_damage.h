// SPDX-License-Identifier: Apache-2.0
// Damaged pictures, for the tests of every format.
#pragma once

#include <asperity/core/random.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/test_files.h>

#include <algorithm>
#include <string>

namespace asperity::io::test {

/// Reads what may be damaged: a picture as large as it says, or an error that names the file.
inline bool read_or_refused(const std::string& path) {
    try {
        const Image image = read_image(path);
        EXPECT_EQ(image.rgb.size(), 3 * static_cast<std::size_t>(image.width) *
                                        static_cast<std::size_t>(image.height));
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
        EXPECT_EQ(error.where().substr(0, path.size()), path);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    return false;
}

/// Every byte set to four values, every cut, and `splices` stretches of noise at random places.
inline void expect_survives_damage(const std::string& path, std::uint64_t splices) {
    const std::string good = get(path);
    ASSERT_TRUE(read_or_refused(path));
    std::size_t refused = 0, tried = 0;
    const auto look = [&](auto) {
        ++tried;
        refused += read_or_refused(path) ? 0 : 1;
    };
    with_each_byte_damaged(path, good.size(), look);
    for (std::uint64_t i = 0; i < splices; ++i) {
        std::string changed = good;
        const auto word = CounterRandom(11, 0).bits(i);
        const std::size_t place = word[0] % good.size(), count = 1 + word[1] % 8;
        for (std::size_t k = place; k < std::min(place + count, good.size()); ++k)
            changed[k] =
                static_cast<char>(CounterRandom(12, static_cast<std::uint32_t>(k)).bits(i)[0]);
        put(path, changed);
        look(i);
    }
    put(path, good);
    with_each_cut(path, look);
    EXPECT_GT(tried, 1000u);
    EXPECT_GT(refused, 100u);
}

}  // namespace asperity::io::test
