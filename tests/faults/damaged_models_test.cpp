// SPDX-License-Identifier: Apache-2.0
// Model files with every byte damaged, cut at every length, with stretches doubled, removed and
// exchanged: each must be refused by an Error or give a clean model.
#include <asperity/core/random.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/test_files.h>
#include <asperity/render/mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace asperity::io {
namespace {

/// How many damaged files were tried, and how they fared.
struct Tally {
    int refused = 0, read = 0;
};

class DamagedModels : public testing::TestWithParam<test::TestFile> {
  protected:
    DamagedModels() : path_(folder_ / GetParam().name) { test::put(path_, GetParam().bytes); }

    /// Reads the file as it stands; fails the test unless it is refused well or clean.
    void try_file() {
        ModelReadSettings settings;
        settings.limits.triangles = 100000;
        try {
            expect_clean(read_model(path_, settings).model);
            ++tally_.read;
        } catch (const Error& error) {
            ++tally_.refused;
            // A .gltf may be damaged so that it names a file that is not there.
            if (error.code() != ErrorCode::InputOutput) {
                EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
                EXPECT_EQ(error.where().find(path_), 0u) << error.what();
            }
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }

    static void expect_clean(const Model& model) {
        EXPECT_NO_THROW(check(model));
        EXPECT_GT(statistics(model).instanced_triangles, 0u);
        const Bounds box = bounds(model);
        EXPECT_LE(std::max({box.high.x, box.high.y, box.high.z}), 1.0001);
        EXPECT_GE(std::min({box.low.x, box.low.y, box.low.z}), -1.0001);
        for (const TriangleMesh& mesh : model.meshes) {
            for (const Vec3f n : mesh.normals) EXPECT_NEAR(length(to_double(n)), 1, 1e-5);
        }
    }

    const test::TemporaryFolder folder_;
    const std::string path_;
    Tally tally_;
};

TEST_P(DamagedModels, EveryByteInTurn) {
    test::with_each_byte_damaged(path_, 2000, [&](std::size_t) { try_file(); });
    EXPECT_GE(tally_.refused + tally_.read, 100);
    EXPECT_GT(tally_.refused, 0);
}

TEST_P(DamagedModels, CutAtEveryLength) {
    test::with_each_cut(path_, [&](std::uintmax_t) { try_file(); });
    EXPECT_GE(tally_.refused + tally_.read, 100);
    EXPECT_GT(tally_.refused, 0);
}

// Counts that are too large, NaNs and infinities among the numbers: four bytes at every place.
TEST_P(DamagedModels, LargeNumbersEverywhere) {
    const std::string& good = GetParam().bytes;
    for (const std::uint32_t word : {0xffffffffu, 0x7fffffffu, 0x7f800000u, 0x7fc00000u}) {
        for (std::size_t place = 0; place + 4 <= good.size(); place += 3) {
            test::put(path_, std::string(good).replace(place, 4, test::raw(word)));
            try_file();
        }
    }
    EXPECT_GT(tally_.refused, 0);
}

// As a text editor or a broken transfer would: stretches doubled, removed, moved, digits inserted.
TEST_P(DamagedModels, StretchesOutOfPlace) {
    const std::string& good = GetParam().bytes;
    const CounterRandom random(20, 26);
    for (std::uint64_t i = 0; i < 400; ++i) {
        const auto bits = random.bits(i);
        std::string bytes = good;
        const std::size_t place = bits[0] % bytes.size();
        const std::string stretch = bytes.substr(place, 1 + bits[1] % 40);
        const std::size_t other = bits[2] % bytes.size();
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
                bytes.insert(place, "99999999999");
        }
        test::put(path_, bytes);
        try_file();
    }
    EXPECT_EQ(tally_.refused + tally_.read, 400);
    EXPECT_GT(tally_.refused, 0);
}

std::string name_of(const testing::TestParamInfo<test::TestFile>& info) {
    std::string name = info.param.name;
    for (char& c : name) c = c == '.' ? '_' : c;
    return name == "a_3ds" ? "threeds" : name;
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedModels, testing::ValuesIn(test::model_test_files()),
                         name_of);

}  // namespace
}  // namespace asperity::io
