#include "cairn/sim/world_depth_camera.hpp"

#include "cairn/core/normal_batch.hpp"
#include "cairn/sim/depth_column.hpp"

#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kBlock = 16;  // columns that are turned into rows together: whole lines of the cache
constexpr std::size_t kPartRows = 4 * NormalBatch::kCapacity;
constexpr float kShadowSlack_px = 0.5F;
constexpr std::uint16_t kMissingDraw = 1;

// x with P(N(0, 1) < x) = share.
double normal_quantile(double share) {
  double low = -9.0, high = 9.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
  }
  return low;
}

/// How depths become what the camera tells, for the rows of one column after the other, from right to left.
class StructuredLight {
 public:
  StructuredLight(const WorldDepthCameraOptions& o, double focal_px, const RandomStream& random)
      : random_(random),
        steps_m_(static_cast<float>(focal_px * o.baseline_m / o.disparity_step_px)),
        sigma_steps_(static_cast<float>(o.sigma_disparity_px / o.disparity_step_px)),
        step_px_(static_cast<float>(o.disparity_step_px)),
        min_mm_(static_cast<float>(1000.0 * o.range_min_m)),
        max_mm_(static_cast<float>(1000.0 * o.range_max_m)),
        missing_below_(static_cast<float>(normal_quantile(o.missing_share))),
        has_missing_(o.missing_share > 0.0),
        has_shadows_(o.shadows),
        items_((static_cast<std::uint32_t>(o.height) + 3) / 4),
        leftmost_px_(static_cast<std::size_t>(o.height), kFarRight) {}

  /// @param depths_m  of the rows of a column; `millimetres` as many
  void tell(int column, std::span<const float> depths_m, std::uint16_t* millimetres) {
    const auto first = static_cast<std::uint32_t>(column) * items_;
    for (std::size_t begin = 0; begin < depths_m.size(); begin += kPartRows) {
      const std::size_t count = std::min(kPartRows, depths_m.size() - begin);
      const auto item = first + static_cast<std::uint32_t>(begin / 4);
      noise_.fill(random_, item, (count + 3) / 4);
      measure(depths_m.data() + begin, count, millimetres + begin);
      if (has_missing_) lose(item, count, millimetres + begin);
      if (has_shadows_) shade(static_cast<float>(column), depths_m.subspan(begin, count), begin, millimetres);
    }
  }

 private:
  static constexpr float kFarRight = 1e9F;

  // A batch has four numbers for each item: the first quarter of the rows gets the first, and so on.
  void measure(const float* depths_m, std::size_t count, std::uint16_t* millimetres) {
    const std::size_t quarter = (count + 3) / 4;
    for (std::size_t part = 0; part < 4; ++part) {
      const std::size_t begin = std::min(count, part * quarter), end = std::min(count, begin + quarter);
      const float* const noise = noise_.number[part].data();
      for (std::size_t i = begin; i < end; ++i) {
        const float steps = steps_m_ / depths_m[i] + sigma_steps_ * noise[i - begin];
        const float shifted =
            std::max(steps, 0.0F) + 0.5F;  // then cut: rounds on all lanes, as lround cannot
        const auto whole = static_cast<float>(static_cast<std::int32_t>(shifted));
        const float mm = 1000.0F * steps_m_ / std::max(whole, 0.01F) + 0.5F;
        const bool is_valid = mm >= min_mm_ && mm <= max_mm_;
        millimetres[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(is_valid ? mm : 0.0F));
      }
    }
  }

  void lose(std::uint32_t item, std::size_t count, std::uint16_t* millimetres) {
    noise_.fill(random_, item, (count + 3) / 4, kMissingDraw);
    const std::size_t quarter = (count + 3) / 4;
    for (std::size_t part = 0; part < 4; ++part) {
      const std::size_t begin = std::min(count, part * quarter), end = std::min(count, begin + quarter);
      const float* const drawn = noise_.number[part].data();
      for (std::size_t i = begin; i < end; ++i)
        millimetres[i] = drawn[i - begin] < missing_below_ ? std::uint16_t{0} : millimetres[i];
    }
  }

  // The projector sees what the camera sees `disparity` pixels further left. Where something to the right is
  // seen even further left, it stands before this and takes its light.
  void shade(float column, std::span<const float> depths_m, std::size_t begin, std::uint16_t* millimetres) {
    const float disparity_m = steps_m_ * step_px_;
    float* const leftmost = leftmost_px_.data() + begin;
    std::uint16_t* const out = millimetres + begin;
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
      const float at_projector = column - disparity_m / depths_m[i];
      out[i] = at_projector > leftmost[i] + kShadowSlack_px ? std::uint16_t{0} : out[i];
      leftmost[i] = std::min(leftmost[i], at_projector);
    }
  }

  RandomStream random_;
  float steps_m_;  // steps of disparity times depth
  float sigma_steps_;
  float step_px_;
  float min_mm_, max_mm_;
  float missing_below_;
  bool has_missing_, has_shadows_;
  std::uint32_t items_;
  std::vector<float> leftmost_px_;  // of each row, as the projector sees it, so far
  NormalBatch noise_;
};

}  // namespace

PinholeIntrinsics intrinsics_of(const WorldDepthCameraOptions& o) {
  const double focal_px = 0.5 * o.width / std::tan(0.5 * o.field_of_view_rad);
  return {focal_px, focal_px, 0.5 * (o.width - 1), 0.5 * (o.height - 1)};
}

DepthImage simulate_depth_image(const SensorView& view, const WorldDepthCameraOptions& o) {
  const WorldScene scene = view.scene();
  const RandomStream random = view.random(SimulationUse::kDepthNoise);
  const Pose2 T_map_camera = view.base_in_map() * parse_world_pose("mount", o.mount);
  const PinholeIntrinsics k = intrinsics_of(o);
  const auto width = static_cast<std::size_t>(o.width), height = static_cast<std::size_t>(o.height);
  const std::uint32_t mesh_items =
      static_cast<std::uint32_t>(width) * ((static_cast<std::uint32_t>(height) + 3) / 4);
  DepthColumn rays(o, k.fx_px, scene.ceiling_m());
  StructuredLight light(o, k.fx_px, random);
  DepthImage::Millimetres pixels(width * height);
  std::vector<std::uint16_t> block(kBlock * height);  // column by column
  for (std::size_t left = width; left > 0;) {
    const std::size_t columns = left % kBlock == 0 ? kBlock : left % kBlock;
    left -= columns;
    for (std::size_t i = columns; i-- > 0;) {
      const std::size_t column = left + i;
      const double aside = (static_cast<double>(column) - k.cx_px) / k.fx_px;  // to the right
      const double bearing = T_map_camera.theta - std::atan(aside);
      const double mesh_draw = random.uniform(mesh_items + static_cast<std::uint32_t>(column));
      const auto depths =
          rays.cast(scene, {T_map_camera.x, T_map_camera.y}, {std::cos(bearing), std::sin(bearing)},
                    1.0 / std::sqrt(1.0 + aside * aside), mesh_draw);
      light.tell(static_cast<int>(column), depths, block.data() + i * height);
    }
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t i = 0; i < columns; ++i) pixels[row * width + left + i] = block[i * height + row];
    }
  }
  return {view.stamp, o.width, o.height, k, o.height_m, 0.0, o.range_min_m, o.range_max_m, std::move(pixels)};
}

}  // namespace cairn
