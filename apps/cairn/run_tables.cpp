#include "apps/cairn/run_tables.hpp"

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/tum_trajectory.hpp"

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <sstream>

namespace cairn::app {
namespace {

constexpr const char* kRunAgain = "write the run again with `cairn localize --out`";

void append(std::string& text, double value) {
  constexpr double kExact = 1e15;
  char digits[32];
  // The shortest form of a whole number may have an exponent (1e+05), which a count must not.
  const bool whole = std::abs(value) < kExact && value == std::trunc(value);
  const auto end = whole ? std::to_chars(digits, digits + sizeof digits, static_cast<long long>(value))
                         : std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end.ptr);
}

void append_more(std::string& text, std::initializer_list<double> values) {
  for (const double value : values) {
    text += ',';
    append(text, value);
  }
}

void append_values(std::string& text, Time stamp, std::initializer_list<double> values) {
  text += format_time(stamp);
  append_more(text, values);
}

void append_row(std::string& text, Time stamp, std::initializer_list<double> values) {
  append_values(text, stamp, values);
  text += '\n';
}

// Walks over the rows of a table; knows the line for messages.
class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  void expect_header(std::string_view header) {
    if (!next() || row_ != header) fail("the header is not '" + std::string(header) + "'");
  }

  bool next() {
    if (rest_.empty()) return false;
    ++line_;
    const std::size_t end = rest_.find('\n');
    // Every row ends in a newline: one without it was cut off in the middle of a number, perhaps.
    if (end == std::string_view::npos) fail("the last row is cut short");
    row_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    row_ended_ = false;
    return true;
  }

  double number() {
    const std::string_view field = next_field();
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
      fail_field(field, "is not a finite number");
    }
    return value;
  }

  int count() {
    const std::string_view field = next_field();
    int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || value < 0) {
      fail_field(field, "is not a count");
    }
    return value;
  }

  TrackingState state() {
    const std::string_view field = next_field();
    for (std::size_t i = 0; i < kTrackingStateCount; ++i) {
      if (field == to_string(static_cast<TrackingState>(i))) return static_cast<TrackingState>(i);
    }
    fail_field(field, "is not a state");
  }

  Time stamp() {
    const std::string_view field = next_field();
    const auto value = parse_time(field);
    if (!value) fail_field(field, "is not a time in seconds");
    return *value;
  }

  Pose2 pose() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  void expect_end() {
    if (!row_ended_) fail("the row has too many fields");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(line_), what, kRunAgain);
  }

 private:
  std::string_view next_field() {
    if (row_ended_) fail("the row has too few fields");
    const std::size_t end = row_.find(',');
    const std::string_view field = row_.substr(0, end);
    row_ended_ = end == std::string_view::npos;
    if (!row_ended_) row_.remove_prefix(end + 1);
    return field;
  }

  [[noreturn]] void fail_field(std::string_view field, const char* what) const {
    std::string text = "'";
    text.append(field).append("' ").append(what);
    fail(text);
  }

  std::string_view rest_;
  std::string_view row_;
  std::string name_;
  bool row_ended_ = true;
  int line_ = 0;
};

template <typename Rows>
void expect_later(const TableReader& table, const Rows& rows, Time stamp) {
  if (!rows.empty() && !(rows.back().stamp < stamp)) table.fail("the stamp is not later than the one before");
}

Eigen::Matrix3d parse_covariance(TableReader& table) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      covariance(row, column) = covariance(column, row) = table.number();
    }
  }
  return covariance;
}

Judgement parse_judgement(TableReader& table) {
  Judgement j;
  j.state = table.state();
  for (double* value :
       {&j.probability, &j.explained, &j.blocked, &j.beyond, &j.fit, &j.innovation, &j.entropy, &j.drift})
    *value = table.number();
  return j;
}

Estimate parse_estimate(TableReader& table) {
  Estimate e;
  e.stamp = table.stamp();
  e.T_map_base = table.pose();
  e.covariance = parse_covariance(table);
  e.ess = table.number();
  e.particles = table.count();
  e.hypotheses = table.count();
  e.weight = table.number();
  e.quality = table.number();
  e.judgement = parse_judgement(table);
  table.expect_end();
  return e;
}

}  // namespace

std::string to_tum(const Trajectory& trajectory) {
  std::ostringstream text;
  write_tum(text, trajectory);
  return text.str();
}

Trajectory parse_tum(const std::string& text, const std::string& name) {
  if (text.empty()) return {};
  if (text.back() != '\n') throw InputError(name, "the last row is cut short", kRunAgain);
  std::istringstream input(text);
  Diagnostics diagnostics;
  Trajectory trajectory = read_tum(input, name, diagnostics);
  // An estimate may jump: a lost robot was found.
  Diagnostics damage;
  for (const auto& [kind, count] : diagnostics.counts()) {
    if (kind != "implausible units") damage.count(kind, count);
  }
  if (!damage.empty()) throw InputError(diagnostics.examples().front().text, "is damaged", kRunAgain);
  return trajectory;
}

std::string to_csv(const std::vector<Estimate>& estimates) {
  std::string text(kEstimateHeader);
  text += '\n';
  for (const Estimate& e : estimates) {
    const Pose2& p = e.T_map_base;
    const Eigen::Matrix3d& c = e.covariance;
    append_values(text, e.stamp,
                  {p.x, p.y, p.theta, c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2), e.ess,
                   static_cast<double>(e.particles), static_cast<double>(e.hypotheses), e.weight, e.quality});
    const Judgement& j = e.judgement;
    text.append(",").append(to_string(j.state));
    append_more(text,
                {j.probability, j.explained, j.blocked, j.beyond, j.fit, j.innovation, j.entropy, j.drift});
    text += '\n';
  }
  return text;
}

std::vector<Estimate> parse_estimates(std::string_view text, const std::string& name) {
  std::vector<Estimate> estimates;
  TableReader table(text, name);
  table.expect_header(kEstimateHeader);
  while (table.next()) {
    const Estimate estimate = parse_estimate(table);
    // Two sensors may speak at the same instant.
    if (!estimates.empty() && estimate.stamp < estimates.back().stamp) table.fail("the stamp runs backwards");
    estimates.push_back(estimate);
  }
  return estimates;
}

std::string to_csv(const std::vector<HypothesisSnapshot>& snapshots) {
  std::string text(kHypothesisHeader);
  text += '\n';
  for (const HypothesisSnapshot& snapshot : snapshots) {
    for (const Hypothesis& h : snapshot.hypotheses) {
      const Pose2& p = h.T_map_base;
      const Eigen::Matrix3d& c = h.covariance;
      append_row(text, snapshot.stamp,
                 {static_cast<double>(h.id), h.weight, h.age_s, p.x, p.y, p.theta, c(0, 0), c(0, 1), c(0, 2),
                  c(1, 1), c(1, 2), c(2, 2)});
    }
  }
  return text;
}

std::vector<HypothesisSnapshot> parse_hypotheses(std::string_view text, const std::string& name) {
  std::vector<HypothesisSnapshot> snapshots;
  TableReader table(text, name);
  table.expect_header(kHypothesisHeader);
  while (table.next()) {
    const Time stamp = table.stamp();
    Hypothesis h;
    h.id = static_cast<std::uint32_t>(table.count());
    h.weight = table.number();
    h.age_s = table.number();
    h.T_map_base = table.pose();
    h.covariance = parse_covariance(table);
    table.expect_end();
    if (snapshots.empty() || snapshots.back().stamp != stamp) snapshots.push_back({stamp, {}});
    snapshots.back().hypotheses.push_back(h);
  }
  return snapshots;
}

std::string to_csv(const std::vector<ParticleSnapshot>& snapshots) {
  std::string text(kParticleHeader);
  text += '\n';
  for (const ParticleSnapshot& snapshot : snapshots) {
    for (const Pose2& p : snapshot.particles) append_row(text, snapshot.stamp, {p.x, p.y, p.theta});
  }
  return text;
}

std::vector<ParticleSnapshot> parse_particles(std::string_view text, const std::string& name) {
  std::vector<ParticleSnapshot> snapshots;
  TableReader table(text, name);
  table.expect_header(kParticleHeader);
  while (table.next()) {
    const Time stamp = table.stamp();
    const Pose2 pose = table.pose();
    table.expect_end();
    if (snapshots.empty() || snapshots.back().stamp != stamp) {
      expect_later(table, snapshots, stamp);
      snapshots.push_back({stamp, {}});
    }
    snapshots.back().particles.push_back(pose);
  }
  return snapshots;
}

}  // namespace cairn::app
