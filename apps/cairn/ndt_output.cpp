#include "apps/cairn/ndt_output.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/ndt_file.hpp"

#include <fstream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {

void write_ndt_map(const std::string& path, const NdtMap& map) {
  std::ofstream file(path, std::ios::binary);
  if (file) write_ndt(file, map);
  file.close();
  if (!file) throw InputError(path, "cannot be written", "check the folder, its permissions and space");
  spdlog::info("{}: {} normal distributions in cells of {} m", path, map.cells().size(),
               map.geometry().cell_size_m);
}

std::string describe(const NdtMap& map, bool as_json) {
  const NdtGeometry& g = map.geometry();
  const Pose2& T = g.T_map_ndt;
  double occupancy = 0.0;
  for (const NdtCell& c : map.cells()) occupancy += c.occupancy;
  if (!map.cells().empty()) occupancy /= static_cast<double>(map.cells().size());
  if (as_json) {
    const nlohmann::ordered_json json = {{"cell_size_m", g.cell_size_m},
                                         {"columns", g.columns},
                                         {"rows", g.rows},
                                         {"origin", {{"x_m", T.x}, {"y_m", T.y}, {"yaw_rad", T.theta}}},
                                         {"distributions", map.cells().size()},
                                         {"mean_occupancy", occupancy}};
    return json.dump(2) + "\n";
  }
  return fmt::format("size      {} x {} cells of {} m, in 4 layers\n", g.columns, g.rows, g.cell_size_m) +
         fmt::format("origin    x {:.3f} m, y {:.3f} m, yaw {:.4f} rad\n", T.x, T.y, T.theta) +
         fmt::format("walls     {} normal distributions, mean occupancy {:.3f}\n", map.cells().size(),
                     occupancy);
}

}  // namespace cairn::app
