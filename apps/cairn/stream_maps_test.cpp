#include "apps/cairn/stream_maps.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/map_yaml.hpp"
#include "small_room.hpp"

#include <filesystem>

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

TEST(StreamMaps, ReadsEachFileOnceUnderItsName) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "stream_map.yaml";
  write_map(file, test::small_room());
  LocalizerOptions options;
  options.streams["low"] = {};
  options.streams["high"].map = std::filesystem::relative(file);
  options.streams["rear"].map = options.streams["high"].map;
  make_stream_maps_absolute(options);
  EXPECT_EQ(options.streams["low"].map, "");
  Diagnostics diagnostics;
  const StreamMaps maps = read_stream_maps(options, diagnostics);
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps.begin()->first, file);
  EXPECT_EQ(maps.begin()->second->geometry().width, 80);
}

TEST(StreamMaps, AMissingFileIsNamed) {
  LocalizerOptions options;
  options.streams["high"].map = "/nowhere/high.yaml";
  Diagnostics diagnostics;
  EXPECT_THROW(read_stream_maps(options, diagnostics), InputError);
}

}  // namespace
}  // namespace cairn::app
