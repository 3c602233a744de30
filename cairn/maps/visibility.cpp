#include "cairn/maps/visibility.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cairn {
namespace {

constexpr double kNearest_m = 1e-6;

// Direction seen from a sector: its axis along x, the directions left of it along y.
inline Point2 into_sector(int sector, const Point2& d) {
  switch (sector) {
    case 0:
      return d;
    case 1:
      return {d.y, -d.x};
    case 2:
      return {-d.x, -d.y};
    default:
      return {-d.y, d.x};
  }
}
inline Point2 out_of_sector(int sector, const Point2& d) { return into_sector((4 - sector) % 4, d); }

// Cuts [t0, t1], fractions of the way from a value fa to fb, to where it is not negative.
inline void keep_positive(double fa, double fb, double& t0, double& t1) {
  if (fa < 0.0) t0 = fb <= 0.0 ? 2.0 : std::max(t0, fa / (fa - fb));
  if (fb < 0.0) t1 = fa <= 0.0 ? -1.0 : std::min(t1, fa / (fa - fb));
}

}  // namespace

double turn_of(const Point2& d) {
  if (d.x >= std::abs(d.y) && d.x > 0.0) return 1.0 + d.y / d.x;
  if (d.y >= std::abs(d.x) && d.y > 0.0) return 3.0 - d.x / d.y;
  if (-d.x >= std::abs(d.y) && d.x < 0.0) return 5.0 + d.y / d.x;
  return std::min(7.0 - d.x / d.y, std::nextafter(8.0, 0.0));
}

VisibilityRenderer::VisibilityRenderer(const WallGrid& grid)
    : grid_(grid), seen_in_(grid.map().walls().size(), 0) {}

const std::vector<VisiblePiece>& VisibilityRenderer::render(const Point2& viewpoint, double reach_m) {
  pieces_.clear();
  if (!std::isfinite(viewpoint.x + viewpoint.y) || !(reach_m > kNearest_m)) return pieces_;
  viewpoint_ = viewpoint;
  least_w_ = 1.0 / reach_m;
  for (int sector = 0; sector < 4; ++sector) {
    sweep(sector, reach_m);
    envelope_.clear();
    for (std::uint32_t i = 0; i < lines_.size(); ++i) insert(i);
    put_pieces(sector);
  }
  return pieces_;
}

// Looks at the columns of cells away from the viewpoint, until all of the sector is closed.
void VisibilityRenderer::sweep(int sector, double reach_m) {
  lines_.clear();
  if (++pass_ == 0) {
    std::fill(seen_in_.begin(), seen_in_.end(), 0);
    pass_ = 1;
  }
  open_ = ~std::uint64_t{0};
  for (int b = 0; b < kBuckets; ++b) buckets_[static_cast<std::size_t>(b)] = {0.0, -2.0, 0.0, 2.0, 0.0};
  const bool along_x = sector % 2 == 0, forward = sector < 2;
  const int count = along_x ? grid_.columns() : grid_.rows();
  const double cell = grid_.cell_m();
  const double at = along_x ? viewpoint_.x - grid_.origin().x : viewpoint_.y - grid_.origin().y;
  const double ahead = forward ? at : count * cell - at;  // from the border behind the viewpoint
  for (int i = static_cast<int>(std::clamp(ahead / cell, 0.0, static_cast<double>(count))); i < count; ++i) {
    const double near = std::max(0.0, i * cell - ahead), far = (i + 1) * cell - ahead;
    if (near > reach_m) break;
    for (std::uint64_t left = open_; left != 0; left &= left - 1) {
      const int b = std::countr_zero(left);
      if (buckets_[static_cast<std::size_t>(b)].closed_w * near >= 1.0) open_ &= ~(std::uint64_t{1} << b);
    }
    if (open_ == 0) break;
    visit_column(sector, forward ? i : count - 1 - i, near, far);
  }
}

// The cells of one column that lie in the open slopes.
void VisibilityRenderer::visit_column(int sector, int column, double near, double far) {
  const bool along_x = sector % 2 == 0, left_is_up = sector == 0 || sector == 3;
  const int count = along_x ? grid_.rows() : grid_.columns();
  const double at = along_x ? viewpoint_.y - grid_.origin().y : viewpoint_.x - grid_.origin().x;
  const double per_m = 1.0 / grid_.cell_m();
  for (std::uint64_t left = open_; left != 0;) {
    const int first = std::countr_zero(left);
    const int length = std::countr_one(left >> first);
    left = first + length == kBuckets ? 0 : left & (~std::uint64_t{0} << (first + length));
    const double s0 = 2.0 * first / kBuckets - 1.0, s1 = 2.0 * (first + length) / kBuckets - 1.0;
    const double low = std::min(s0 * near, s0 * far), high = std::max(s1 * near, s1 * far);
    const double from = (left_is_up ? at + low : at - high) * per_m;
    const double to = (left_is_up ? at + high : at - low) * per_m;
    if (!(to >= 0.0 && from < count)) continue;
    const int last = std::min(count - 1, static_cast<int>(to));
    for (int i = static_cast<int>(std::max(0.0, from)); i <= last; ++i) {
      visit_cell(sector, along_x ? column : i, along_x ? i : column);
    }
  }
}

void VisibilityRenderer::visit_cell(int sector, int column, int row) {
  for (const WallInCell& wall : grid_.cell(column, row)) {
    if (seen_in_[wall.wall] == pass_) continue;
    seen_in_[wall.wall] = pass_;
    take(sector, wall);
  }
}

// Keeps the part of a wall that lies in the sector and within reach, as a line of nearness over slope.
void VisibilityRenderer::take(int sector, const WallInCell& wall) {
  const Point2 a = into_sector(sector, {wall.a.x - viewpoint_.x, wall.a.y - viewpoint_.y});
  const Point2 b = into_sector(sector, {wall.b.x - viewpoint_.x, wall.b.y - viewpoint_.y});
  double t0 = 0.0, t1 = 1.0;
  keep_positive(a.x - a.y, b.x - b.y, t0, t1);
  keep_positive(a.x + a.y, b.x + b.y, t0, t1);
  keep_positive(a.x - kNearest_m, b.x - kNearest_m, t0, t1);
  if (!(t0 < t1)) return;
  const auto at = [&](double t) {
    // Ends that are not cut stay as they are: two walls with a common end have a common slope there.
    return t == 0.0 ? a : (t == 1.0 ? b : Point2{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  };
  const Point2 p = at(t0), q = at(t1);
  Line line{std::clamp(p.y / p.x, -1.0, 1.0),
            std::clamp(q.y / q.x, -1.0, 1.0),
            1.0 / p.x,
            1.0 / q.x,
            wall.wall,
            0.0};
  if (line.s0 > line.s1) std::swap(line.s0, line.s1), std::swap(line.w0, line.w1);
  if (!(line.s0 < line.s1) || std::max(line.w0, line.w1) <= least_w_) return;
  line.gain = (line.w1 - line.w0) / (line.s1 - line.s0);
  if (line.w0 < least_w_) line.s0 += (least_w_ - line.w0) / line.gain, line.w0 = least_w_;
  if (line.w1 < least_w_) line.s1 = line.s0 + (least_w_ - line.w0) / line.gain, line.w1 = least_w_;
  if (!(line.s0 < line.s1) || !std::isfinite(line.gain)) return;
  lines_.push_back(line);
  close_buckets(line);
}

void VisibilityRenderer::close_buckets(const Line& line) {
  constexpr double kPerSlope = kBuckets / 2.0;
  const auto bucket_of = [](double s) {
    return std::min(kBuckets - 1, static_cast<int>((s + 1.0) * kPerSlope));
  };
  const int last = bucket_of(line.s1);
  for (int b = bucket_of(line.s0); b <= last; ++b) {
    Bucket& bucket = buckets_[static_cast<std::size_t>(b)];
    const double low = b / kPerSlope - 1.0, high = (b + 1) / kPerSlope - 1.0;
    const bool from_low = line.s0 <= low, to_high = line.s1 >= high;
    const double w = std::min(from_low ? line.at(low) : line.w0, to_high ? line.at(high) : line.w1);
    if (from_low && to_high) {
      bucket.closed_w = std::max(bucket.closed_w, w);
      continue;
    }
    if (from_low && line.s1 > bucket.left_s) bucket.left_s = line.s1, bucket.left_w = w;
    if (to_high && line.s0 < bucket.right_s) bucket.right_s = line.s0, bucket.right_w = w;
    if (bucket.left_s >= bucket.right_s) {
      bucket.closed_w = std::max(bucket.closed_w, std::min(bucket.left_w, bucket.right_w));
    }
  }
}

bool VisibilityRenderer::is_hidden(const Line& line, std::size_t first) const {
  double s = line.s0;
  for (std::size_t i = first; i < envelope_.size() && s < line.s1; ++i) {
    const Span& span = envelope_[i];
    if (span.s0 > s) return false;
    const double end = std::min(span.s1, line.s1);
    const Line& over = lines_[span.line];
    if (line.at(s) > over.at(s) || line.at(end) > over.at(end)) return false;
    s = end;
  }
  return s >= line.s1;
}

// Raises the envelope to the line where the line is above it.
void VisibilityRenderer::insert(std::uint32_t index) {
  const Line& line = lines_[index];
  const auto begins_after = std::partition_point(envelope_.begin(), envelope_.end(),
                                                 [&](const Span& span) { return span.s1 <= line.s0; });
  const auto first = static_cast<std::size_t>(begins_after - envelope_.begin());
  if (is_hidden(line, first)) return;
  replacement_.clear();
  const auto put = [&](double s0, double s1, std::uint32_t of) {
    if (!(s0 < s1)) return;
    if (!replacement_.empty() && replacement_.back().line == of && replacement_.back().s1 == s0) {
      replacement_.back().s1 = s1;
    } else {
      replacement_.push_back({s0, s1, of});
    }
  };
  double s = line.s0;
  std::size_t last = first;
  for (; last < envelope_.size() && envelope_[last].s0 < line.s1; ++last) {
    const Span span = envelope_[last];
    const double from = std::max(s, span.s0), to = std::min(span.s1, line.s1);
    put(span.s0, line.s0, span.line);
    put(s, from, index);
    const double above_from = line.at(from) - lines_[span.line].at(from);
    const double above_to = line.at(to) - lines_[span.line].at(to);
    const bool crosses = (above_from > 0.0 && above_to < 0.0) || (above_from < 0.0 && above_to > 0.0);
    const double share = crosses ? above_from / (above_from - above_to) : 1.0;
    const double cross = std::clamp(from + share * (to - from), from, to);
    const bool is_above = above_from > 0.0 || (above_from == 0.0 && above_to > 0.0);
    put(from, cross, is_above ? index : span.line);
    put(cross, to, is_above ? span.line : index);
    put(std::max(from, line.s1), span.s1, span.line);
    s = to;
  }
  put(s, line.s1, index);
  const auto begin = envelope_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = envelope_.begin() + static_cast<std::ptrdiff_t>(last);
  const std::size_t reused = std::min(last - first, replacement_.size());
  const auto rest = replacement_.begin() + static_cast<std::ptrdiff_t>(reused);
  const auto after = std::copy(replacement_.begin(), rest, begin);
  if (rest == replacement_.end()) {
    envelope_.erase(after, end);
  } else {
    envelope_.insert(end, rest, replacement_.end());
  }
}

void VisibilityRenderer::put_pieces(int sector) {
  const auto point = [&](const Line& line, double s) {
    const double x = 1.0 / line.at(s);
    const Point2 d = out_of_sector(sector, {x, s * x});
    return Point2{viewpoint_.x + d.x, viewpoint_.y + d.y};
  };
  const double axis = 2.0 * sector + 1.0;
  for (const Span& span : envelope_) {
    const double begin = axis + span.s0, end = axis + span.s1;
    if (!(begin < end)) continue;  // as narrow as a rounding error
    const Line& line = lines_[span.line];
    pieces_.push_back({begin, end, point(line, span.s0), point(line, span.s1), line.wall});
  }
}

}  // namespace cairn
