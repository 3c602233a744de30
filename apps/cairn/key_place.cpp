#include "apps/cairn/key_place.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/yaml_key_place.hpp"

namespace cairn::app {

void with_key_places(const std::string& name, const std::string& text, const std::function<void()>& work) {
  try {
    work();
  } catch (const ConfigurationError& error) {
    const std::string all = error.what();
    const std::size_t begin = error.where().size() + 2;  // "where: "
    throw ConfigurationError(yaml_key_place(text, name, error.where()),
                             all.size() > begin ? all.substr(begin) : all, "");
  }
}

}  // namespace cairn::app
