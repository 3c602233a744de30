#include "cairn/eval/page.hpp"

#include "cairn/core/errors.hpp"

namespace cairn {

std::string fill_page(std::string_view page, std::string_view json) {
  constexpr std::string_view kMark = "<!--CAIRN:RUN-->";
  const std::size_t mark = page.find(kMark);
  CAIRN_ASSERT(mark != std::string_view::npos);
  std::string text(page.substr(0, mark));
  text.reserve(page.size() + json.size());
  // Inside a script element only "</script" and "<!--" mean something to HTML: without any '<' there is
  // neither.
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  text += page.substr(mark + kMark.size());
  return text;
}

}  // namespace cairn
