#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kestrel/link/address.hpp"

namespace kestrel::test {

/// Two computers on a cable, made of Linux network namespaces and a pair of virtual interfaces;
/// gone with this object. Names carry the process id, so that several may run at once.
class TwoNetworks {
 public:
  enum class Side { Near, Far };

  /// Empty when this machine lets us make them; else what is missing, in words.
  static std::string why_not();

  /// Throws std::runtime_error with what the system said.
  TwoNetworks();
  ~TwoNetworks();
  TwoNetworks(const TwoNetworks&) = delete;
  TwoNetworks& operator=(const TwoNetworks&) = delete;

  /// The side's addresses on the cable.
  static Address ipv4(Side side, std::uint16_t port);
  static Address ipv6(Side side, std::uint16_t port);

  /// A command line that runs there.
  std::vector<std::string> inside(Side side, const std::vector<std::string>& words) const;

  /// Does something on a thread that stands there: sockets that it opens stay there. What it throws
  /// is thrown on.
  void stand(Side side, const std::function<void()>& action) const;

  /// Adds a rule of nftables for what comes in there, such as "udp dport 5005 drop".
  void rule(Side side, const std::string& rule) const;
  /// Takes all rules away.
  void clear_rules(Side side) const;

  /// The cable pulled out, and put in again.
  void unplug() const;
  void plug() const;

 private:
  std::string name(Side side) const;
  void run_inside(Side side, const std::vector<std::string>& words) const;
  void set_up(Side side) const;
  void wait_until_it_carries() const;

  std::string stem_;
};

}  // namespace kestrel::test
