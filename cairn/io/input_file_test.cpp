#include "cairn/io/input_file.hpp"

#include "cairn/core/errors.hpp"
#include "test_data.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// printf 'hello\n' | gzip -n
const std::string kHelloGzip(
    "\x1f\x8b\x08\0\0\0\0\0\0\x03\xcb\x48\xcd\xc9\xc9\xe7\x02\0\x20\x30\x3a\x36\x06\0\0\0", 26);

class InputFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("cairn_input_file_" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  fs::path write(const std::string& bytes, const char* name = "a.log") {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string content(const fs::path& path, std::size_t max_bytes = kMaxInputBytes) {
    const auto stream = open_input(path, max_bytes);
    return {std::istreambuf_iterator<char>(*stream), {}};
  }
  static std::string error_of(const fs::path& path, std::size_t max_bytes = kMaxInputBytes) {
    try {
      content(path, max_bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

TEST_F(InputFile, GivesTheContent) {
  const std::string bytes = "a\r\nb\n" + std::string(1, '\0') + std::string(3000000, 'x');
  EXPECT_EQ(content(write(bytes)), bytes);
}

TEST_F(InputFile, UnpacksWhateverTheName) { EXPECT_EQ(content(write(kHelloGzip, "plain.txt")), "hello\n"); }

TEST_F(InputFile, MissingFile) { EXPECT_THAT(error_of(folder_ / "none"), HasSubstr("none: no such file")); }

TEST_F(InputFile, Directory) { EXPECT_THAT(error_of(folder_), HasSubstr("is a directory")); }

TEST_F(InputFile, NoPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const fs::path path = write("text");
  fs::permissions(path, fs::perms::none);
  EXPECT_THAT(error_of(path), HasSubstr("Permission denied"));
}

TEST_F(InputFile, Empty) {
  EXPECT_THAT(error_of(write("")), HasSubstr("is empty"));
  const std::string packed_nothing("\x1f\x8b\x08\0\0\0\0\0\0\x03\x03\0\0\0\0\0\0\0\0\0", 20);
  EXPECT_THAT(error_of(write(packed_nothing)), HasSubstr("is empty"));
}

TEST_F(InputFile, CutShortOrFollowedByGarbageNamesTheByte) {
  EXPECT_THAT(error_of(write(kHelloGzip.substr(0, 20))),
              AllOf(HasSubstr("a.log (byte 20)"), HasSubstr("cut short")));
  EXPECT_THAT(error_of(write(kHelloGzip + "more")), HasSubstr("a.log (byte 26)"));
}

TEST_F(InputFile, LimitHoldsForPlainAndPacked) {
  const fs::path plain = write("123456", "plain");
  EXPECT_EQ(content(plain, 6), "123456");
  EXPECT_THAT(error_of(plain, 5), HasSubstr("more than 5 bytes"));
  EXPECT_THAT(error_of(write(kHelloGzip, "packed"), 5), HasSubstr("more than 5 bytes"));
}

TEST_F(InputFile, EndlessDeviceStopsAtTheLimit) {
  if (!fs::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero";
  EXPECT_THAT(error_of("/dev/zero", 5000000), HasSubstr("more than 5000000 bytes"));
}

TEST_F(InputFile, RealBzip2) {
  CAIRN_SKIP_WITHOUT("radish_raw/aces.clf.bz2");
  const auto stream = open_input(test::data_file("radish_raw/aces.clf.bz2"));
  std::string line;
  ASSERT_TRUE(std::getline(*stream, line));
  EXPECT_TRUE(line.starts_with("#") || line.starts_with("PARAM") || line.starts_with("ODOM")) << line;
}

}  // namespace
}  // namespace cairn
