// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/atomic_file.h>

#include <asperity/formats/read_file.h>
#include <asperity/formats/test_files.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

namespace asperity::io {
namespace {

using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

TEST(AtomicFile, WritesAllAndLeavesNothingElse) {
    const TemporaryFolder folder;
    AtomicFile file(folder / "a.txt");
    file.write("one, ");
    file.write("two");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
    file.commit();
    EXPECT_EQ(get(folder / "a.txt"), "one, two");
    EXPECT_EQ(folder.files(), 1);
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
    const TemporaryFolder folder;
    put(folder / "a.txt", "old");
    {
        AtomicFile file(folder / "a.txt");
        file.write("new");
        EXPECT_EQ(folder.files(), 2);
    }
    EXPECT_EQ(get(folder / "a.txt"), "old");
    EXPECT_EQ(folder.files(), 1);
}

TEST(AtomicFile, GoesBackToFillInATable) {
    const TemporaryFolder folder;
    AtomicFile file(folder / "a.txt");
    file.write("??, two");
    EXPECT_EQ(file.position(), 7u);
    file.seek(0);
    file.write("10");
    EXPECT_EQ(file.position(), 2u);
    file.commit();
    EXPECT_EQ(get(folder / "a.txt"), "10, two");
}

TEST(AtomicFile, KeepsPermissionsAndFollowsLinks) {
    const TemporaryFolder folder;
    put(folder / "real.txt", "old");
    ASSERT_EQ(::chmod((folder / "real.txt").c_str(), 0640), 0);
    std::filesystem::create_symlink(folder / "real.txt", folder / "link.txt");
    AtomicFile file(folder / "link.txt");
    file.write("new");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
    EXPECT_EQ(get(folder / "real.txt"), "new");
    struct ::stat status {};
    ASSERT_EQ(::stat((folder / "real.txt").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST(AtomicFile, SweepsWhatKilledProgramsLeft) {
    const TemporaryFolder folder;
    put(folder / ".a.txt.tmp-1-0", "half a fi");
    put(folder / ".b.txt.tmp-1-0", "of another");
    AtomicFile first(folder / "a.txt");
    first.write("first");
    EXPECT_FALSE(std::filesystem::exists(folder / ".a.txt.tmp-1-0"));
    // One that is being written stays
    AtomicFile second(folder / "a.txt");
    second.write("second");
    first.commit();
    EXPECT_EQ(get(folder / "a.txt"), "first");
    second.commit();
    EXPECT_EQ(get(folder / "a.txt"), "second");
    EXPECT_EQ(folder.files(), 2);
}

TEST(AtomicFile, AcceptsTheLongestName) {
    const TemporaryFolder folder;
    const std::string path = folder / std::string(255, 'x');
    AtomicFile file(path);
    file.commit();
    EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(AtomicFile, AFailedRenameRemovesTheTemporaryFile) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    {
        AtomicFile file(path);
        // Someone makes a folder of that name meanwhile.
        std::filesystem::create_directory(path);
        expect_error(ErrorCode::InputOutput, "a.txt: cannot put in place", [&] { file.commit(); });
    }
    EXPECT_EQ(folder.files(), 1);
}

// A limit on the size of files makes write() come back short and then fail, as a full disk does.
TEST(AtomicFile, AFailedWriteKeepsTheOldFile) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    put(path, "old");
    struct ::rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct ::rlimit small = {1000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    expect_error(ErrorCode::InputOutput, "a.txt: cannot write: File too large", [&] {
        AtomicFile file(path);
        file.write(std::string(1500, 'x'));
        file.commit();
    });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(get(path), "old");
    EXPECT_EQ(folder.files(), 1);
}

TEST(AtomicFile, RefusesWhatCannotBeWritten) {
    const TemporaryFolder folder;
    expect_error(ErrorCode::InputOutput, "it is a folder", [&] { AtomicFile file(folder.path()); });
    expect_error(ErrorCode::InputOutput, "none/a.txt: cannot create: No such file or directory",
                 [&] { AtomicFile file(folder / "none/a.txt"); });
    expect_error(ErrorCode::InputOutput, "name is empty", [] { AtomicFile file(""); });
}

TEST(AtomicFile, WritesDevicesDirectly) {
    if (!test::has_full_device()) GTEST_SKIP() << "no /dev/full here";
    expect_error(ErrorCode::InputOutput, "/dev/full: cannot write: No space left on device", [] {
        AtomicFile file("/dev/full");
        file.write("x");
        file.commit();
    });
    AtomicFile file("/dev/null");
    file.write("x");
    file.commit();
}

TEST(ReadFile, ReadsWholeFilesAndParts) {
    const TemporaryFolder folder;
    put(folder / "a.txt", "0123456789");
    EXPECT_EQ(read_text_file(folder / "a.txt", 10), "0123456789");
    EXPECT_EQ(read_file(folder / "a.txt", 10).size(), 10u);
    const InputFile file(folder / "a.txt");
    std::string part(3, ' ');
    file.read(7, std::as_writable_bytes(std::span(part)));
    EXPECT_EQ(part, "789");
    expect_error(ErrorCode::InputOutput, "a.txt: ends early, at byte 10",
                 [&] { file.read(8, std::as_writable_bytes(std::span(part))); });
}

TEST(ReadFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    put(folder / "a.txt", "0123456789");
    ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    expect_error(ErrorCode::InvalidInput, "a.txt: 10 bytes are more than the 9 allowed",
                 [&] { read_text_file(folder / "a.txt", 9); });
    expect_error(ErrorCode::InputOutput, "none: cannot open: No such file or directory",
                 [&] { InputFile(folder / "none"); });
    expect_error(ErrorCode::InputOutput, "it is a folder", [&] { InputFile(folder.path()); });
    expect_error(ErrorCode::InputOutput, "fifo: cannot read: it is not a regular file",
                 [&] { InputFile(folder / "fifo"); });
}

}  // namespace
}  // namespace asperity::io
