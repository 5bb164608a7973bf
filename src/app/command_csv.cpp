#include "command_csv.hpp"

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"

namespace kestrel::app {

std::string command_columns() {
  return "stamp_s,system_id,component_id,sequence,forward_m_s,right_m_s,down_m_s,yaw_rate_rad_s";
}

std::string command_line(const ReceivedCommand& c) {
  return fmt::format("{},{},{},{},{},{},{},{}", number(c.time_boot_ms / 1000.0),
                     c.envelope.system_id, c.envelope.component_id, c.envelope.sequence,
                     number(c.command.forward_m_s), number(c.command.right_m_s),
                     number(c.command.down_m_s), number(c.command.yaw_rate_rad_s));
}

Summary receiver_summary(const ReceiverCounts& counts) {
  Summary summary;
  summary.add("datagrams", std::int64_t(counts.datagrams));
  summary.add("commands", std::int64_t(counts.commands));
  summary.add("heartbeats", std::int64_t(counts.heartbeats));
  summary.add("lost", std::int64_t(counts.lost));
  summary.add("late", std::int64_t(counts.late));
  summary.add("duplicates", std::int64_t(counts.duplicates));
  summary.add("not finite", std::int64_t(counts.not_finite));
  summary.add("unsupported", std::int64_t(counts.unsupported));
  summary.add("misaddressed", std::int64_t(counts.misaddressed));
  summary.add("malformed", std::int64_t(counts.malformed()));
  return summary;
}

void add_counts(Summary& summary, const AutopilotCounts& counts) {
  summary.add("setpoints", std::int64_t(counts.setpoints));
  summary.add("obeyed", std::int64_t(counts.obeyed));
  summary.add("ignored", std::int64_t(counts.ignored));
  summary.add("refused", std::int64_t(counts.refused));
  summary.add("not finite", std::int64_t(counts.not_finite));
  summary.add("malformed", std::int64_t(counts.malformed));
}

}  // namespace kestrel::app
