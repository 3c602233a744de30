#include "apps/cairn/data_path.hpp"

#include "cairn/core/errors.hpp"

#include <cstdlib>

namespace cairn::app {
namespace {

constexpr const char* kDataVariable = "$CAIRN_DATA";

}  // namespace

std::string expand_data(const std::string& key, const std::string& path) {
  const std::string variable = kDataVariable;
  if (path.compare(0, variable.size(), variable) != 0) return path;
  const char* const data = std::getenv(variable.c_str() + 1);
  if (data == nullptr) {
    throw ConfigurationError(key, "needs the environment variable CAIRN_DATA",
                             "set it to the folder of the recordings");
  }
  return data + path.substr(variable.size());
}

}  // namespace cairn::app
