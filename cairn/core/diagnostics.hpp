#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cairn {

/// Things that were wrong but did not stop the work, counted by kind, with the first few in full.
/// Readers fill one; `metrics.json` and `cairn log info` show it.
class Diagnostics {
 public:
  struct Example {
    std::string kind;
    std::string text;  ///< "where: what"
  };

  /// Counts one occurrence of `kind` ("malformed line", "time reversal", ...) and keeps the first examples.
  void warn(const std::string& kind, const std::string& where, const std::string& what);

  /// Counts `n` further occurrences without an example. Damaged files announce any number: counts stop at the
  /// largest one.
  void count(const std::string& kind, std::uint64_t n = 1);

  /// Adds what another one has counted.
  void add(const Diagnostics& other);

  bool empty() const { return counts_.empty(); }
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }
  const std::vector<Example>& examples() const { return examples_; }

 private:
  static constexpr std::int64_t kExamplesPerKind = 3;
  std::map<std::string, std::int64_t> counts_;
  std::vector<Example> examples_;
};

}  // namespace cairn
