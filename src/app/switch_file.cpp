#include "switch_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "kestrel/io/task_options.hpp"
#include "kestrel/io/yaml_section.hpp"
#include "kestrel/link/key_file.hpp"

namespace kestrel::app {
namespace {

/// Runs an action; what it finds wrong becomes an error of the key.
template <class Action>
auto checked(const Section& section, const std::string& key, const Action& action) {
  try {
    return action();
  } catch (const FileError&) {
    throw;
  } catch (const std::exception& error) {  // invalid_argument, or a file that is refused
    section.fail(key, error.what());
  }
}

int within(const Section& section, const std::string& key, int otherwise, int least, int most) {
  const int value = section.whole(key, otherwise);
  if (value < least || value > most) {
    section.fail(key, "must be " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value;
}

SwitchLink read_link(const Section& section) {
  SwitchLink link;
  link.name = section.text("name");
  link.role = section.choice<LinkRole>("role", {{"flight", LinkRole::Flight},
                                                {"vision", LinkRole::Vision},
                                                {"ground", LinkRole::Ground},
                                                {"script", LinkRole::Script},
                                                {"telemetry", LinkRole::Telemetry}});
  link.priority = within(section, "priority", link.priority, 0, 1000);
  link.flow.frames_per_s = section.number("frames_per_s", link.flow.frames_per_s);
  link.flow.burst = section.number("burst", link.flow.burst);
  link.may.arm = section.flag("allow_arming", link.may.arm);
  link.may.manual_control = section.flag("allow_sticks", link.may.manual_control);
  link.may.aid_estimator = section.flag("allow_estimator_aid", link.may.aid_estimator);
  if (section.has("key")) {
    link.key = checked(section, "key", [&] { return mavlink::load_key(section.path("key")); });
  }
  return link;
}

SwitchPlace read_place(const Section& section, LinkRole role) {
  SwitchPlace at;
  at.place = checked(section, "url", [&] { return parse_link_place(section.text("url")); });
  // There is one vehicle: whoever else speaks on its link is none.
  at.port.max_peers = role == LinkRole::Flight ? 1 : at.port.max_peers;
  at.port.max_peers = std::size_t(within(section, "max_peers", int(at.port.max_peers), 1, 16));
  at.port.stream.queue_frames =
      std::size_t(within(section, "queue_frames", int(at.port.stream.queue_frames), 2, 4096));
  at.port.stream.silent_s = section.number("unanswered_s", at.port.stream.silent_s);
  at.port.forget_s = section.number("forget_s", at.port.forget_s);
  checked(section, "", [&] { at.port.check(); });
  return at;
}

void read_links(const Section& root, SwitchLoopOptions& options) {
  for (const SectionItem& item : root.items("links")) {
    if (!item.keys) root.fail("links", "has a word where a link is wanted; give {name: ..., ...}");
    options.core.links.push_back(read_link(*item.keys));
    options.places.push_back(read_place(*item.keys, options.core.links.back().role));
  }
}

Recipient read_ids(const Section& root, const std::string& key, Recipient ids) {
  const auto section = root.child_if(key);
  if (!section) return ids;
  ids.system_id = std::uint8_t(within(*section, "system_id", ids.system_id, 1, 255));
  ids.component_id = std::uint8_t(within(*section, "component_id", ids.component_id, 1, 255));
  return ids;
}

SwitchOptions read_rules(const Section& root, SwitchOptions o) {
  o.vehicle = read_ids(root, "vehicle", o.vehicle);
  o.self = read_ids(root, "self", o.self);
  o.setpoint_ids = root.choice<SetpointIds>(
      "setpoint_ids", {{"switch", SetpointIds::Switch}, {"owner", SetpointIds::Owner}},
      o.setpoint_ids);
  o.envelope = read_command_limits(root);
  o.rate_hz = root.number("rate_hz", o.rate_hz);
  o.deadman_s = root.number("deadman_s", o.deadman_s);
  o.time_to_live_s = root.number("time_to_live_s", o.time_to_live_s);
  o.heartbeat_period_s = root.number("heartbeat_period_s", o.heartbeat_period_s);
  o.missed_heartbeats = root.whole("missed_heartbeats", o.missed_heartbeats);
  return o;
}

void read_log(const Section& root, SwitchTask& task) {
  const auto section = root.child_if("log");
  if (!section) return;
  task.log = section->path("file");
  task.log_options.max_bytes = std::uintmax_t(within(*section, "max_kb", 10000, 1, 1000000)) * 1000;
  task.log_options.files = within(*section, "files", task.log_options.files, 1, 100);
}

void read_signing_times(const Section& root, SwitchTask& task) {
  const auto& links = task.loop.core.links;
  const bool is_signed = std::any_of(links.begin(), links.end(),
                                     [](const SwitchLink& link) { return link.key.has_value(); });
  if (root.has("signing_times")) task.signing_times = root.path("signing_times");
  if (is_signed && task.signing_times.empty()) {
    root.fail("signing_times",
              "is missing; a link has a key: name a file that keeps the last signing time, so that "
              "none is used twice after a crash");
  }
}

}  // namespace

SwitchTask read_switch_task(const std::filesystem::path& file) {
  const Section root = Section::load(file);
  SwitchTask task;
  read_links(root, task.loop);
  task.loop.core = read_rules(root, task.loop.core);
  if (root.has("status")) task.loop.status = root.path("status");
  read_log(root, task);
  read_signing_times(root, task);
  task.real_time_priority = within(root, "real_time_priority", 0, 0, 99);
  root.done();
  checked(root, "", [&] { task.loop.check(); });
  return task;
}

}  // namespace kestrel::app
