#include "cairn/io/mcap_log.hpp"

#include "cairn/io/exact_log.hpp"
#include "cairn/io/mcap_reader.hpp"
#include "cairn/io/plausible_units.hpp"
#include "cairn/io/ros2_log.hpp"

namespace cairn {

Log read_mcap_log(std::istream& input, const std::string& name) {
  ros2::Ros2Log ros(name);
  ExactLog exact(name, ExactLog::Values::kChecked);
  mcap::Handlers handlers;
  handlers.on_channel = [&](const mcap::Schema&, const mcap::Channel& channel) {
    exact.add_channel(channel);
  };
  handlers.on_message = [&](const mcap::MessageView& m) {
    if (exact.add_message(m) || exact.is_twin(m.channel)) return;
    ros.add({m.schema.name, m.channel.topic, mcap::from_mcap(m.message.log_time), m.message.data, m.offset},
            m.channel.message_encoding);
  };
  Diagnostics damage;
  mcap::read(input, name, handlers, damage);
  const bool ours = exact.has_streams();
  Log log = ours ? std::move(exact).finish() : std::move(ros).finish();
  log.format = ours ? "cairn_mcap" : "mcap";
  log.diagnostics.add(damage);
  warn_of_implausible_units(log, name);
  return log;
}

}  // namespace cairn
