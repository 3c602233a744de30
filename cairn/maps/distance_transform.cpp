#include "cairn/maps/distance_transform.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_transform_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace cairn {
namespace {

constexpr std::size_t kLargestVector = 64;  // bytes
constexpr std::size_t kRowsPerBand =
    128;  // with a thousand columns, a band stays in the nearest cache but one

// The lowest percentage that counts as occupied; 127 if none does.
std::int8_t occupied_from(const OccupancyGrid::Thresholds& thresholds) {
  std::int8_t percent = 0;
  while (percent <= 100 && !(percent / 100.0 > thresholds.occupied)) ++percent;
  return percent <= 100 ? percent : std::int8_t{127};
}

// The blocks of a row whose window holds an occupied cell within reach; elsewhere everything is far.
class NearBlocks {
 public:
  NearBlocks(std::size_t columns, std::size_t radius)
      : reach_(1 + radius / kBlock), near_(columns / kBlock + 1) {}
  static constexpr std::size_t kBlock = 128;

  void find(const std::uint8_t* distances, std::uint8_t cap, std::size_t columns) {
    std::fill(near_.begin(), near_.end(), false);
    for (std::size_t begin = 0; begin < columns; begin += kBlock) {
      std::uint8_t nearest = cap;
      for (std::size_t x = begin; x < std::min(begin + kBlock, columns); ++x)
        nearest = std::min(nearest, distances[x]);
      near_[begin / kBlock] = nearest < cap;
    }
  }

  bool any_around(std::size_t block) const {
    const std::size_t first = block > reach_ ? block - reach_ : 0;
    const std::size_t last = std::min(block + reach_ + 1, near_.size());
    for (std::size_t b = first; b < last; ++b) {
      if (near_[b]) return true;
    }
    return false;
  }

 private:
  std::size_t reach_;
  std::vector<char> near_;
};

// One row after the other, in buffers with room for whole vectors and for the window beyond both ends.
class RowPass {
 public:
  RowPass(std::size_t width, std::uint16_t far, std::uint8_t cap)
      : width_(width),
        far_(far),
        cap_(cap),
        blocks_(width, cap),
        distances_(width + kLargestVector, cap),
        squares_(kMargin + width + kMargin, far),
        out_(width + kLargestVector) {}

  void transform(const std::uint8_t* distances, std::uint16_t* out) {
    blocks_.find(distances, cap_, width_);
    std::memcpy(distances_.data(), distances, width_);
    square_row(distances_.data(), cap_, far_, squares_.data() + kMargin, width_);
    for (std::size_t begin = 0; begin < width_; begin += NearBlocks::kBlock) {
      const std::size_t columns = std::min(NearBlocks::kBlock, width_ - begin);
      if (blocks_.any_around(begin / NearBlocks::kBlock)) {
        least_in_windows(squares_.data() + kMargin + begin, far_, cap_ - 1, out_.data() + begin, columns);
      } else {
        std::fill_n(out_.begin() + static_cast<std::ptrdiff_t>(begin), columns, far_);
      }
    }
    std::memcpy(out, out_.data(), width_ * sizeof *out);
  }

 private:
  static constexpr std::size_t kMargin = kMostTruncationCells + kLargestVector;
  std::size_t width_;
  std::uint16_t far_;
  std::uint8_t cap_;
  NearBlocks blocks_;
  std::vector<std::uint8_t> distances_;
  std::vector<std::uint16_t> squares_;
  std::vector<std::uint16_t> out_;
};

// Consecutive rows, with those within reach on both sides: nothing farther away counts in them.
class Band {
 public:
  Band(const OccupancyGrid& grid, std::size_t begin, std::size_t end, std::uint8_t cap)
      : width_(static_cast<std::size_t>(grid.geometry().width)), first_(begin > cap ? begin - cap : 0) {
    const std::size_t last = std::min(end + cap, static_cast<std::size_t>(grid.geometry().height));
    along_columns_ = std::make_unique_for_overwrite<std::uint8_t[]>((last - first_) * width_);
    distances_in_columns({grid.cells().data() + first_ * width_, along_columns_.get(), width_, last - first_},
                         occupied_from(grid.thresholds()), cap);
  }

  const std::uint8_t* row(std::size_t y) const { return along_columns_.get() + (y - first_) * width_; }

 private:
  std::size_t width_, first_;
  std::unique_ptr<std::uint8_t[]> along_columns_;
};

}  // namespace

LargeVector<std::uint16_t> truncated_squared_distances(const OccupancyGrid& grid, std::uint16_t far,
                                                       const Executor& executor) {
  CAIRN_ASSERT(far >= 1 && far <= kMostTruncationCells * kMostTruncationCells);
  const GridGeometry& g = grid.geometry();
  // The smallest whole number of cells whose square is not below `far`.
  auto cap = static_cast<int>(std::sqrt(static_cast<double>(far)));
  while (cap * cap < far) ++cap;
  const auto width = static_cast<std::size_t>(g.width);
  LargeVector<std::uint16_t> squared(g.size());
  executor.for_each_chunk(static_cast<std::size_t>(g.height), kRowsPerBand,
                          [&](std::size_t begin, std::size_t end) {
                            const Band band(grid, begin, end, static_cast<std::uint8_t>(cap));
                            RowPass pass(width, far, static_cast<std::uint8_t>(cap));
                            for (std::size_t row = begin; row < end; ++row)
                              pass.transform(band.row(row), squared.data() + row * width);
                          });
  return squared;
}

}  // namespace cairn
