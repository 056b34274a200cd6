// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/core/memory.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace asperity {
namespace {

/// A machine of files under a folder.
class Machine : public testing::Test {
  protected:
    Machine()
        : root_(testing::TempDir() + "asperity-memory-" +
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
        std::filesystem::remove_all(root_);
        put("/proc/meminfo",
            "MemTotal: 9000 kB\nMemFree: 1000 kB\nMemAvailable: 4000 kB\nSwapFree: 500 kB\n");
    }
    ~Machine() override { std::filesystem::remove_all(root_); }
    void put(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(std::filesystem::path(root_ + name).parent_path());
        std::ofstream(root_ + name) << text;
    }
    std::uint64_t room() const { return memory_room(root_)->bytes; }
    const std::string& root() const { return root_; }

  private:
    std::string root_;
};

TEST_F(Machine, HasWhatItSays) {
    EXPECT_EQ(room(), 4500u * 1024);
    EXPECT_STREQ(memory_room(root())->whose, "on this machine");
    put("/proc/meminfo", "MemTotal: 9000 kB\n");
    EXPECT_FALSE(memory_room(root()).has_value());
}

TEST_F(Machine, GroupsOfVersion2LeaveWhatTheyDoNotHold) {
    put("/proc/self/cgroup", "0::/slice/unit\n");
    put("/sys/fs/cgroup/slice/unit/memory.max", "max\n");
    put("/sys/fs/cgroup/slice/unit/memory.current", "700000\n");
    EXPECT_EQ(room(), 4500u * 1024);
    // The one above has a limit
    put("/sys/fs/cgroup/slice/memory.max", "3000000\n");
    put("/sys/fs/cgroup/slice/memory.current", "900000\n");
    EXPECT_EQ(room(), 2'100'000u);
    EXPECT_STREQ(memory_room(root())->whose, "under the limit of its control group");
    put("/sys/fs/cgroup/slice/memory.stat", "anon 1\ninactive_file 400000\nfile 5\n");
    EXPECT_EQ(room(), 2'500'000u);
    put("/sys/fs/cgroup/slice/unit/memory.max", "1000000\n");
    EXPECT_EQ(room(), 300'000u);
    put("/sys/fs/cgroup/slice/unit/memory.current", "1000001\n");
    EXPECT_EQ(room(), 0u);
}

TEST_F(Machine, GroupsOfVersion1AlsoAsAContainerSeesThem) {
    put("/proc/self/cgroup", "8:pids:/\n4:cpu,memory:/x\n3:memory:/engine/abc\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "2000000\n");
    put("/sys/fs/cgroup/memory/memory.usage_in_bytes", "500000\n");
    EXPECT_EQ(room(), 1'500'000u);
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    EXPECT_EQ(room(), 4500u * 1024);
}

TEST(Memory, RefusesWithBothFigures) {
    const MemoryRoom room{2'000'000'000, "on this machine"};
    EXPECT_NO_THROW(require_memory(2'000'000'000, "size", room));
    EXPECT_NO_THROW(require_memory(2'000'000'001, "size", std::nullopt));
    try {
        require_memory(13'800'000'000, "size", room);
        ADD_FAILURE() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::OutOfMemory);
        EXPECT_STREQ(error.what(),
                     "size: needs at least 13.8 GB of memory, 2.0 GB are free on this machine");
    }
}

TEST(Memory, ThisMachineHasSomeAndNotEverything) {
    EXPECT_NO_THROW(require_memory(1000, "a thousand bytes"));
    if (!memory_room()) GTEST_SKIP() << "the system does not tell";
    EXPECT_GT(memory_room()->bytes, 0u);
    EXPECT_THROW(require_memory(std::uint64_t{1} << 60, "an exabyte"), Error);
}

TEST(Memory, SizesAreReadable) {
    EXPECT_EQ(bytes_text(4'440'000'000), "4.4 GB");
    EXPECT_EQ(bytes_text(650'100'000), "650 MB");
    EXPECT_EQ(bytes_text(12'000), "12 kB");
}

}  // namespace
}  // namespace asperity
