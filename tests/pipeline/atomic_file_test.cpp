#include "pipeline/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "pipeline/error.h"

namespace edgewise {
namespace {

class AtomicFile : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = std::filesystem::temp_directory_path() / "edgewise_atomic_XXXXXX";
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::ptrdiff_t fileCount() const {
        return std::distance(std::filesystem::directory_iterator(folder_),
                             std::filesystem::directory_iterator());
    }

    std::filesystem::path folder_;
};

TEST_F(AtomicFile, ReplacesAndLeavesNothingElse) {
    writeAtomically(folder_ / "a", "first");
    writeAtomically(folder_ / "a", "second");
    EXPECT_EQ(read("a"), "second");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFile, AFailedWriteLeavesTheOldFileAlone) {
    writeAtomically(folder_ / "a", "old");
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tiny{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &tiny);
    EXPECT_THROW(writeAtomically(folder_ / "a", std::string(100000, 'x')), FailureError);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
    EXPECT_EQ(read("a"), "old");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFile, RefusesWhatIsNoFileName) {
    EXPECT_THROW(writeAtomically(folder_, "x"), InputError);
    EXPECT_THROW(writeAtomically(folder_ / "none" / "a", "x"), InputError);
    EXPECT_THROW(writeAtomically("", "x"), InputError);
    EXPECT_EQ(fileCount(), 0);
}

TEST_F(AtomicFile, ADeviceStaysADevice) {
    writeAtomically("/dev/null", "x");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace edgewise
