#include "cairn/io/option_suggestion.hpp"

#include <algorithm>
#include <numeric>

namespace cairn {
namespace {

constexpr std::size_t kLongest = 60;

// Levenshtein: insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The candidate whose last part is nearest to the key, if it is near at all; else nothing.
std::string nearest(const std::string& key, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = key.size() / 3 + 2;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(key, last_part(candidate));
    if (distance >= least) continue;
    least = distance;
    best = candidate;
  }
  return best;
}

}  // namespace

std::string suggest(const std::string& key, const std::vector<std::string>& known,
                    const std::vector<std::string>& paths) {
  if (key.size() <= kLongest) {
    for (const auto* candidates : {&known, &paths}) {
      const std::string best = nearest(key, *candidates);
      if (!best.empty()) return "did you mean '" + best + "'?";
    }
  }
  if (known.empty()) return "remove it";
  std::string all = "known here: ";
  for (const std::string& name : known) all += (&name == &known.front() ? "" : ", ") + name;
  return all;
}

std::string printable(const std::string& text) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string result;
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      result += c;
    } else {
      result += {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return result + (text.size() > kLongest ? "..." : "");
}

std::string quoted(const std::string& text) { return "'" + printable(text) + "'"; }

}  // namespace cairn
