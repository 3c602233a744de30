#pragma once

#include "cairn/io/log.hpp"

#include <filesystem>
#include <istream>
#include <string>

namespace cairn {

/// Reads a log of any known format, packed (gzip, bzip2, Zstandard) or not: CARMEN text, Wean Hall text, MRPT
/// text, ROS 1 bag, ROS 2 bag (.db3, .mcap), recording of Cairn (.mcap). The reader is chosen by what the
/// file holds, not by its name.
/// @throws InputError if the file cannot be opened (see input_file.hpp), is of no known format (the message
///   says how it begins), or its reader refuses it (carmen_log.hpp, wean_log.hpp, mrpt_text_log.hpp,
///   rosbag1.hpp, mcap_log.hpp, rosbag2_db3.hpp)
Log read_log(const std::filesystem::path& path);

/// The same from a stream that can seek. `name` is that of the file, for messages.
Log read_log(std::istream& input, const std::string& name);

}  // namespace cairn
