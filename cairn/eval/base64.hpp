#pragma once

#include <string>
#include <string_view>

namespace cairn {

/// RFC 4648, section 4: the standard alphabet, padded, without line breaks.
std::string to_base64(std::string_view bytes);

}  // namespace cairn
