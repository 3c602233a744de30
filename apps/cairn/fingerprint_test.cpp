#include "apps/cairn/fingerprint.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn::app {
namespace {

std::string of(std::initializer_list<const char*> texts) {
  Fingerprint fingerprint;
  for (const char* text : texts) fingerprint.add(text);
  return fingerprint.text();
}

TEST(Fingerprint, IsThatOfFnv1a) {
  // Nothing: the offset basis.
  EXPECT_EQ(of({}), "cbf29ce484222325");
  EXPECT_EQ(of({"a"}).size(), 16U);
}

TEST(Fingerprint, TellsTextsApart) {
  EXPECT_EQ(of({"ab", "c"}), of({"ab", "c"}));
  EXPECT_NE(of({"ab", "c"}), of({"a", "bc"}));
  EXPECT_NE(of({"ab"}), of({"ab", ""}));
}

TEST(Fingerprint, TellsFilesApartByTheirEnds) {
  const auto path =
      std::filesystem::temp_directory_path() / ("cairn_fingerprint_" + std::to_string(getpid()));
  const auto of_file = [&](const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
    Fingerprint fingerprint;
    fingerprint.add_file(path.string());
    return fingerprint.text();
  };
  const std::string large(3'000'000, 'x');
  const std::string plain = of_file(large);
  EXPECT_EQ(of_file(large), plain);
  EXPECT_NE(of_file("y" + large.substr(1)), plain);
  EXPECT_NE(of_file(large.substr(1) + "y"), plain);
  EXPECT_NE(of_file(large + "x"), plain);
  EXPECT_NE(of_file("a"), of_file("b"));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace cairn::app
