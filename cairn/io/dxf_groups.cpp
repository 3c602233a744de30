#include "cairn/io/dxf_groups.hpp"

#include "cairn/core/errors.hpp"

#include <charconv>
#include <cmath>

namespace cairn {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <class Number>
bool parse(std::string_view text, Number& number) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

}  // namespace

bool DxfGroups::next() {
  do {
    if (!line_.next()) return false;
    if (!parse(trimmed(line_.line()), code_)) {
      fail("is no group code", "give an ASCII DXF file (save it again as DXF R12 or later, not binary)");
    }
    if (!line_.next()) fail("the file ends within a group", "it was cut off: copy it again");
    value_ = trimmed(line_.line());
  } while (code_ == 999);
  return true;
}

double DxfGroups::number() const {
  double value = 0.0;
  if (!parse(std::string_view(value_), value) || !std::isfinite(value)) {
    fail("'" + value_ + "' is no finite number", "repair the file");
  }
  return value;
}

long long DxfGroups::integer() const {
  long long value = 0;
  if (!parse(std::string_view(value_), value)) fail("'" + value_ + "' is no integer", "repair the file");
  return value;
}

void DxfGroups::fail(const std::string& what, const std::string& remedy) const {
  throw InputError(line_.where(), what, remedy);
}

}  // namespace cairn
