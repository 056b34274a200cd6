// SPDX-License-Identifier: Apache-2.0
// Files of every reader with bytes damaged, cut, with stretches doubled, removed and exchanged:
// each must be refused by an Error that names the place, or give what the reader promises, in time
// that goes with its size. The same bytes every time.
//
// ASPERITY_DAMAGE=N makes N times as many of those that are drawn at random. Sanitized there are a
// quarter as many, as each takes several times as long.
#include "readers.h"

#include <asperity/core/random.h>
#include <asperity/formats/test_files.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace asperity::test {
namespace {

// Of the processor; sanitizers make readers several times slower.
constexpr double kSeconds = 0.5, kSecondsAMegabyte = 20;

std::uint64_t times() {
    const char* const more = std::getenv("ASPERITY_DAMAGE");
    return more == nullptr ? 1 : std::max<std::uint64_t>(std::strtoull(more, nullptr, 10), 1);
}

/// How many files of this size each test may make: as many as wanted, but 16 MB of them together.
std::uint64_t affordable(std::uint64_t wanted, std::size_t bytes) {
    constexpr std::uint64_t kBytes = 16 << 20;
    const std::uint64_t most = std::min(wanted, times() * (kBytes / (bytes + 1) + 2));
    return std::max<std::uint64_t>(most / ASPERITY_DAMAGE_PART, 1);
}

class DamagedFiles : public testing::TestWithParam<Reader> {
  protected:
    const io::test::TemporaryFolder folder_{};
    const std::string path_ = folder_ / GetParam().file_name;

    /// Has the reader read these bytes.
    void expect_survives(const std::string& bytes, const char* damage, std::uint64_t which) {
        io::test::put(path_, bytes);
        const std::clock_t start = std::clock();
        const std::string fault = fault_of(GetParam(), path_);
        const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        const double megabytes = static_cast<double>(bytes.size()) / (1 << 20);
        ++tried_;
        if (fault.empty() && spent < kSeconds + kSecondsAMegabyte * megabytes) return;
        const std::string kept = testing::TempDir() + GetParam().name + ".damaged";
        io::test::put(kept, bytes);
        FAIL() << damage << ' ' << which << " after " << spent << " s: " << fault
               << "\nthe file is kept as " << kept;
    }

    /// Calls damage(seed, k) `count` times, shared out over the seeds.
    template <typename Damage>
    void for_each_seed(std::uint64_t count, Damage damage) {
        const std::vector<std::string>& seeds = GetParam().seeds;
        count = affordable(count, seeds.front().size());
        for (std::uint64_t k = 0; k < count && !HasFatalFailure(); ++k)
            damage(seeds[k % seeds.size()], k);
    }

    void TearDown() override { RecordProperty("tried", static_cast<int>(tried_)); }

  private:
    std::uint64_t tried_ = 0;
};

// The reader that the seeds are for takes them: damage to what is refused anyway shows little.
TEST_P(DamagedFiles, SeedsAreRead) {
    for (const std::string& seed : GetParam().seeds) {
        io::test::put(path_, seed);
        if (seed.empty()) continue;
        EXPECT_NO_THROW(GetParam().read(path_));
    }
}

TEST_P(DamagedFiles, BytesInTurn) {
    for (const std::string& seed : GetParam().seeds) {
        const std::size_t places = std::min<std::size_t>(seed.size(), 2048);
        const std::size_t step =
            std::max<std::size_t>(4 * places / affordable(1024, seed.size()), 1);
        for (std::size_t place = 0; place < places && !HasFatalFailure(); place += step) {
            for (const char byte : {'\x00', '\xff', '\x7f', '\x80'})
                expect_survives(std::string(seed).replace(place, 1, 1, byte), "byte", place);
        }
    }
}

TEST_P(DamagedFiles, CutAtManyLengths) {
    for (const std::string& seed : GetParam().seeds) {
        const std::size_t step =
            std::max<std::size_t>(seed.size() / affordable(512, seed.size()), 1);
        for (std::size_t length = 0; length < seed.size() && !HasFatalFailure(); length += step)
            expect_survives(seed.substr(0, length), "length", length);
    }
}

// Counts that are too large, NaNs and infinities among the numbers, as binary and as text.
TEST_P(DamagedFiles, LargeNumbersEverywhere) {
    using namespace std::string_literals;
    const std::vector<std::string> numbers = {"\xff\xff\xff\xff"s,
                                              "\xff\xff\xff\x7f"s,
                                              "\0\0\x80\x7f"s,
                                              "\0\0\xc0\x7f"s,
                                              "\x7f\xff\xff\xff"s,
                                              "4294967296"s,
                                              "-1"s,
                                              "nan"s,
                                              "1e999"s,
                                              "99999999999999999999"s};
    for_each_seed(300 * times(), [&](const std::string& seed, std::uint64_t k) {
        const auto bits = CounterRandom(1, 7).bits(k);
        const std::string& number = numbers[bits[0] % numbers.size()];
        std::string bytes = seed;
        const std::size_t place = bits[1] % (bytes.size() + 1);
        bytes.replace(place, bits[2] % 2 == 0 ? number.size() : bits[3] % 8, number);
        expect_survives(bytes, "number", k);
    });
}

// As a text editor or a broken transfer would: stretches doubled, removed, moved, noise.
TEST_P(DamagedFiles, StretchesOutOfPlace) {
    for_each_seed(400 * times(), [&](const std::string& seed, std::uint64_t k) {
        if (seed.empty()) return;
        const auto bits = CounterRandom(2, 7).bits(k);
        std::string bytes = seed;
        const std::size_t place = bits[0] % bytes.size(), other = bits[2] % bytes.size();
        const std::string stretch = bytes.substr(place, 1 + bits[1] % (1 + bytes.size() / 10));
        switch (bits[3] % 4) {
            case 0:
                bytes.insert(other, stretch);
                break;
            case 1:
                bytes.erase(place, stretch.size());
                break;
            case 2:
                bytes.replace(other, stretch.size(), stretch);
                break;
            default:
                for (std::size_t i = place; i < place + stretch.size(); ++i)
                    bytes[i] = static_cast<char>(
                        CounterRandom(3, static_cast<std::uint32_t>(i)).bits(k)[0]);
        }
        expect_survives(bytes, "stretch", k);
    });
}

// Words of the format where they should not be, several at once.
TEST_P(DamagedFiles, WordsOutOfPlace) {
    const std::vector<std::string>& words = GetParam().words;
    if (words.empty()) return;
    for_each_seed(300 * times(), [&](const std::string& seed, std::uint64_t k) {
        std::string bytes = seed;
        for (std::uint32_t i = 0; i < 1 + k % 4; ++i) {
            const auto bits = CounterRandom(4, i).bits(k);
            const std::string& word = words[bits[0] % words.size()];
            bytes.replace(bits[1] % (bytes.size() + 1), bits[2] % 2 * word.size(), word);
        }
        expect_survives(bytes, "word", k);
    });
}

// The smallest inputs of faults that were found once: tests/fuzz/regressions/READER/.
TEST_P(DamagedFiles, PastFaultsStayMended) {
    const std::filesystem::path folder =
        std::filesystem::path(ASPERITY_REGRESSIONS) / GetParam().name;
    if (!std::filesystem::exists(folder)) return;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        SCOPED_TRACE(entry.path().filename());
        expect_survives(io::test::get(entry.path().string()), "regression", 0);
    }
}

std::string name_of(const testing::TestParamInfo<Reader>& info) {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Readers, DamagedFiles, testing::ValuesIn(readers()), name_of);

}  // namespace

/// As GoogleTest shall name it.
void PrintTo(const Reader& reader, std::ostream* out) {
    *out << reader.name;
}

}  // namespace asperity::test
