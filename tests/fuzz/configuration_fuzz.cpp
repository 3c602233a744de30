#include "cairn/io/configuration.hpp"
#include "fuzz_target.hpp"

#include <map>

namespace {

struct StreamOptions {
  bool use = true;
  double mount_x_m = 0.0;
  bool operator==(const StreamOptions&) const = default;
};

// One option of every kind, as a localizer has them.
struct Options {
  std::string recipe = "kld_mcl";
  std::string odometry_stream;
  double sigma_hit_m = 0.06;
  int particles = 2000;
  double epsilon = 0.1;
  std::map<std::string, StreamOptions> streams;
  bool operator==(const Options&) const = default;

  void visit(cairn::OptionVisitor& v) {
    v.choice({"recipe", "words"}, recipe, {"mcl", "kld_mcl"});
    v.text({"odometry_stream", "words"}, odometry_stream);
    v.number({"sigma_hit_m", "words", {"sigma_hit"}}, sigma_hit_m, {1e-3, 10.0});
    v.section({"filter", "words"}, [this](cairn::OptionVisitor& filter) {
      filter.integer({"particles", "words", {"max_particles"}}, particles, {1, 10'000'000});
      filter.section({"kld", "words"}, [this](cairn::OptionVisitor& kld) {
        kld.number({"epsilon", "words", {"pf_err"}}, epsilon, {1e-4, 1.0});
      });
    });
    std::vector<std::string> present;
    for (const auto& [name, unused] : streams) present.push_back(name);
    v.table({"streams", "words"}, present, [this](const std::string& key, cairn::OptionVisitor& stream) {
      stream.flag({"use", "words"}, streams[key].use);
      stream.number({"mount_x_m", "words"}, streams[key].mount_x_m, {-1e4, 1e4});
    });
  }
};

cairn::VisitOptions visitor_of(Options& options) {
  return [&options](cairn::OptionVisitor& v) { options.visit(v); };
}

// YAML's longest key on one line; a stream of a longer name cannot be written so that it reads back.
constexpr std::size_t kLongestKey = 200;

bool has_long_name(const Options& options) {
  for (const auto& [name, unused] : options.streams) {
    if (name.size() > kLongestKey) return true;
  }
  return false;
}

void check_round_trip(Options options) {
  if (has_long_name(options)) return;
  std::istringstream written(cairn::write_configuration(visitor_of(options)));
  Options back;
  cairn::Diagnostics diagnostics;
  cairn::read_configuration(written, "written", visitor_of(back), diagnostics);
  if (!(back == options)) throw std::logic_error("what was written reads back as something else");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    Options options;
    cairn::Diagnostics diagnostics;
    cairn::read_configuration(input, "fuzz", visitor_of(options), diagnostics);
    check_round_trip(options);
  });
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    std::string line;
    std::getline(input, line);
    Options options;
    cairn::apply_settings({line}, visitor_of(options));
  });
}
