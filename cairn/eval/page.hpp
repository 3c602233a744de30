#pragma once

#include <string>
#include <string_view>

namespace cairn {

/// `page` (a template that web/ builds) with `json` in place of its mark `<!--CAIRN:RUN-->`. Every `<` of the
/// data is escaped, so that nothing in it can end the script element.
/// @throws std::logic_error for a page without the mark
std::string fill_page(std::string_view page, std::string_view json);

}  // namespace cairn
