#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "kestrel/link/key_file.hpp"
#include "kestrel/link/link_place.hpp"
#include "kestrel/link/status_server.hpp"

#include "cli/program.hpp"
#include "support/temp_folder.hpp"

namespace kestrel::test {

/// `kestrel switch` before flight control at an address: links eyes (vision), hand (ground, UDP)
/// and script (of priority 70, between the two).
class SwitchProcess {
 public:
  enum class Hand { Plain, Signed };  // its link with a key, or without

  explicit SwitchProcess(const std::string& flight_url, Hand hand = Hand::Plain) {
    const bool has_key = hand == Hand::Signed;
    if (has_key) mavlink::write_key(key_file(), mavlink::random_key());
    std::ofstream(folder_ / "switch.yaml")
        << "links:\n"
        << "  - {name: autopilot, role: flight, url: '" << flight_url << "'}\n"
        << "  - {name: eyes, role: vision, url: 'udp-listen://127.0.0.1:0'}\n"
        << "  - {name: hand, role: ground, url: 'udp-listen://127.0.0.1:0'"
        << (has_key ? ", key: hand.key" : "") << "}\n"
        << "  - {name: script, role: script, priority: 70, url: 'udp-listen://127.0.0.1:0'}\n"
        << (has_key ? "signing_times: times\n" : "") << "status: status\n";
    program_ = std::make_unique<Program>(std::vector<std::string>{"switch", "switch.yaml"},
                                         folder_.path());
  }

  std::filesystem::path key_file() const { return folder_ / "hand.key"; }

  /// Null when the switch does not answer (yet).
  nlohmann::json status() const {
    try {
      return nlohmann::json::parse(ask_status(folder_ / "status", 5));
    } catch (const std::runtime_error&) {
      return {};
    }
  }
  /// "owned", "taken over", "stopped", ...; empty when it does not answer.
  std::string control() const {
    const nlohmann::json now = status();
    return now.is_null() ? std::string() : now["control"].get<std::string>();
  }
  /// Where a sender reaches that link.
  std::string url(const std::string& link) const {
    const nlohmann::json now = status();
    for (const nlohmann::json& each : now["links"]) {
      if (each["name"] != link) continue;
      return to_string(
          LinkPlace{LinkKind::UdpClient, parse_link_place(each["url"].get<std::string>()).address});
    }
    throw std::runtime_error("no link " + link);
  }

 private:
  TempFolder folder_;
  std::unique_ptr<Program> program_;
};

}  // namespace kestrel::test
