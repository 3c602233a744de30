#include "cairn/io/trajectory_reader.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    cairn::Diagnostics diagnostics;
    const std::vector<cairn::Time> frames(100);
    const auto poses = cairn::read_trajectory(input, "fuzz", {.frame_stamps = frames}, diagnostics);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!cairn::is_finite(poses[i].pose)) throw std::logic_error("a pose that is not finite");
      if (i > 0 && poses[i].stamp <= poses[i - 1].stamp) throw std::logic_error("stamps not in order");
    }
  });
}
