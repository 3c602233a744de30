#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <bzlib.h>
#include <lz4frame.h>

/// Writes small ROS 1 bags (format 2.0) and messages into memory, for tests.
namespace cairn::test {

inline constexpr std::string_view kLaserScanMd5 = "90c7ef2dc6895d81024acba2ac42f369";
inline constexpr std::string_view kOdometryMd5 = "cd5e73d190d741a2f92e81eda573aca7";
inline constexpr std::string_view kTransformsMd5 = "94810edda583a504dfda3829e70d7eec";

/// Packed little-endian bytes.
class Bytes {
 public:
  template <class Number>
  Bytes& number(Number value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& raw(std::string_view bytes) {
    text_ += bytes;
    return *this;
  }
  Bytes& block(std::string_view bytes) { return number(static_cast<std::uint32_t>(bytes.size())).raw(bytes); }
  /// "name=value" as in record headers.
  Bytes& field(std::string_view name, std::string_view value) {
    return block(std::string(name) + "=" + std::string(value));
  }
  template <class Number>
  Bytes& field(std::string_view name, Number value) {
    return field(name, std::string_view(Bytes().number(value).text()));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct RosTime {
  std::uint32_t seconds = 0;
  std::uint32_t nanoseconds = 0;
};

inline std::string ros_header(RosTime stamp, std::string_view frame) {
  return Bytes().number(std::uint32_t{7}).number(stamp.seconds).number(stamp.nanoseconds).block(frame).text();
}

struct ScanFields {
  RosTime stamp{100, 0};
  std::string frame = "laser";
  float angle_min = -0.5f;
  float angle_increment = 0.5f;
  float range_min = 0.1f;
  float range_max = 30.0f;
  std::vector<float> ranges{1.0f, 2.0f, 3.0f};
};

inline std::string scan_message(const ScanFields& scan) {
  Bytes bytes;
  bytes.raw(ros_header(scan.stamp, scan.frame));
  const float angle_max = scan.angle_min + scan.angle_increment * static_cast<float>(scan.ranges.size() - 1);
  for (float value : {scan.angle_min, angle_max, scan.angle_increment, 0.0f, 0.1f}) bytes.number(value);
  bytes.number(scan.range_min).number(scan.range_max);
  bytes.number(static_cast<std::uint32_t>(scan.ranges.size()));
  for (float range : scan.ranges) bytes.number(range);
  return bytes.number(std::uint32_t{0}).text();
}

struct TransformFields {
  RosTime stamp{100, 0};
  std::string parent = "odom";
  std::string child = "base_link";
  std::array<double, 3> position{};
  std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};  ///< x y z w
};

inline std::array<double, 4> yaw(double radians) {
  return {0.0, 0.0, std::sin(radians / 2), std::cos(radians / 2)};
}

inline std::string transform_bytes(const TransformFields& transform) {
  Bytes bytes;
  bytes.raw(ros_header(transform.stamp, transform.parent)).block(transform.child);
  for (double value : transform.position) bytes.number(value);
  for (double value : transform.rotation) bytes.number(value);
  return bytes.text();
}

inline std::string transforms_message(const std::vector<TransformFields>& transforms) {
  Bytes bytes;
  bytes.number(static_cast<std::uint32_t>(transforms.size()));
  for (const TransformFields& transform : transforms) bytes.raw(transform_bytes(transform));
  return bytes.text();
}

/// nav_msgs/Odometry without motion and with zero covariances.
inline std::string odometry_message(const TransformFields& pose) {
  return transform_bytes(pose) + std::string((36 + 6 + 36) * sizeof(double), '\0');
}

class RosbagWriter {
 public:
  explicit RosbagWriter(std::string compression = "none", bool indexed = true)
      : compression_(std::move(compression)), indexed_(indexed) {
    bag_ = "#ROSBAG V2.0\n" + bag_header();
  }

  /// Introduces a topic within the current chunk.
  std::uint32_t connection(std::string_view topic, std::string_view type, std::string_view md5sum) {
    const auto id = static_cast<std::uint32_t>(connections_.size());
    const std::string header = Bytes().field("op", '\x07').field("conn", id).field("topic", topic).text();
    const std::string data = Bytes().field("topic", topic).field("type", type).field("md5sum", md5sum).text();
    connections_.push_back(Bytes().block(header).block(data).text());
    chunk_ += connections_.back();
    return id;
  }

  void message(std::uint32_t connection, RosTime recorded, std::string_view bytes) {
    const std::string header =
        Bytes()
            .field("op", '\x02')
            .field("conn", connection)
            .field("time", std::uint64_t{recorded.nanoseconds} << 32 | recorded.seconds)
            .text();
    chunk_ += Bytes().block(header).block(bytes).text();
    ++counts_[connection];
  }

  /// Raw record bytes into the current chunk.
  void raw(std::string_view bytes) { chunk_ += bytes; }

  void end_chunk() {
    const std::string header = Bytes()
                                   .field("op", '\x05')
                                   .field("compression", std::string_view(compression_))
                                   .field("size", static_cast<std::uint32_t>(chunk_.size()))
                                   .text();
    chunk_offsets_.push_back(bag_.size());
    bag_ += Bytes().block(header).text();
    chunk_data_offsets_.push_back(bag_.size() + sizeof(std::uint32_t));
    bag_ += Bytes().block(packed()).text();
    chunk_infos_.push_back(chunk_info());
    if (indexed_) bag_ += index_data();
    chunk_.clear();
    counts_.clear();
  }

  std::string finish() {
    if (!chunk_.empty()) end_chunk();
    if (!indexed_) return bag_;
    index_offset_ = bag_.size();
    for (const std::string& record : connections_) bag_ += record;
    for (const std::string& record : chunk_infos_) bag_ += record;
    const std::string header = bag_header();
    return bag_.replace(13, header.size(), header);
  }

  const std::vector<std::size_t>& chunk_offsets() const { return chunk_offsets_; }
  const std::vector<std::size_t>& chunk_data_offsets() const { return chunk_data_offsets_; }
  std::size_t index_offset() const { return index_offset_; }

 private:
  // Padded less than rosbag's 4096 bytes, so that tests which cut at every byte stay quick.
  std::string bag_header() const {
    const std::string header =
        Bytes()
            .field("op", '\x03')
            .field("index_pos", std::uint64_t{index_offset_})
            .field("conn_count", static_cast<std::uint32_t>(indexed_ ? connections_.size() : 0))
            .field("chunk_count", static_cast<std::uint32_t>(indexed_ ? chunk_infos_.size() : 0))
            .text();
    return Bytes().block(header).block("  padding  ").text();
  }

  std::string packed() const {
    if (compression_ == "bz2") return bz2();
    if (compression_ == "lz4") return lz4();
    return chunk_;
  }

  std::string bz2() const {
    std::string out(chunk_.size() + chunk_.size() / 50 + 700, '\0');
    auto size = static_cast<unsigned>(out.size());
    std::string in = chunk_;
    if (BZ2_bzBuffToBuffCompress(out.data(), &size, in.data(), static_cast<unsigned>(in.size()), 9, 0, 0) !=
        BZ_OK) {
      throw std::runtime_error("bz2");
    }
    return out.substr(0, size);
  }

  std::string lz4() const {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;  // as rosbag does
    std::string out(LZ4F_compressFrameBound(chunk_.size(), &preferences), '\0');
    const std::size_t size =
        LZ4F_compressFrame(out.data(), out.size(), chunk_.data(), chunk_.size(), &preferences);
    if (LZ4F_isError(size)) throw std::runtime_error("lz4");
    return out.substr(0, size);
  }

  std::string index_data() const {
    Bytes bytes;
    for (const auto& [id, count] : counts_) {
      const std::string header =
          Bytes().field("op", '\x04').field("ver", 1u).field("conn", id).field("count", count).text();
      bytes.block(header).block(std::string(12 * count, '\0'));  // times and offsets: nobody reads them
    }
    return bytes.text();
  }

  std::string chunk_info() const {
    const std::string header = Bytes()
                                   .field("op", '\x06')
                                   .field("ver", 1u)
                                   .field("chunk_pos", std::uint64_t{chunk_offsets_.back()})
                                   .field("count", static_cast<std::uint32_t>(counts_.size()))
                                   .text();
    Bytes data;
    for (const auto& [id, count] : counts_) data.number(id).number(count);
    return Bytes().block(header).block(data.text()).text();
  }

  std::string compression_;
  bool indexed_;
  std::string bag_;
  std::string chunk_;
  std::vector<std::string> connections_;
  std::vector<std::string> chunk_infos_;
  std::map<std::uint32_t, std::uint32_t> counts_;
  std::vector<std::size_t> chunk_offsets_;
  std::vector<std::size_t> chunk_data_offsets_;
  std::size_t index_offset_ = 0;
};

}  // namespace cairn::test
