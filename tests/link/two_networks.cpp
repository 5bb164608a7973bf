#include "link/two_networks.hpp"

#include <atomic>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include "kestrel/link/socket.hpp"

#include "cli/program.hpp"

namespace kestrel::test {
namespace {

Outcome outcome_of(const std::vector<std::string>& words) {
  return Program(Command{words}, std::filesystem::current_path()).wait(20);
}

void require(const std::vector<std::string>& words) {
  const Outcome outcome = outcome_of(words);
  if (outcome.exit_code == 0) return;
  std::string line;
  for (const std::string& word : words) line += word + ' ';
  throw std::runtime_error(line + "failed: " + outcome.err);
}

}  // namespace

std::string TwoNetworks::why_not() {
  if (outcome_of({"ip", "-Version"}).exit_code != 0) return "no command ip (package iproute2)";
  if (outcome_of({"nft", "--version"}).exit_code != 0) return "no command nft (package nftables)";
  try {
    const TwoNetworks tried;
    tried.rule(Side::Far, "udp dport 9 drop");
  } catch (const std::exception& error) {
    return std::string("network namespaces are not permitted here: ") + error.what();
  }
  return "";
}

TwoNetworks::TwoNetworks() {
  static std::atomic<int> count{0};
  stem_ = "kt" + std::to_string(getpid()) + "n" + std::to_string(++count);
  require({"ip", "netns", "add", name(Side::Near)});
  try {
    require({"ip", "netns", "add", name(Side::Far)});
    require({"ip", "link", "add", "cable", "netns", name(Side::Near), "type", "veth", "peer",
             "name", "cable", "netns", name(Side::Far)});
    set_up(Side::Near);
    set_up(Side::Far);
    wait_until_it_carries();
  } catch (const std::exception&) {
    outcome_of({"ip", "netns", "del", name(Side::Near)});
    outcome_of({"ip", "netns", "del", name(Side::Far)});
    throw;
  }
}

TwoNetworks::~TwoNetworks() {
  try {
    outcome_of({"ip", "netns", "del", name(Side::Near)});
    outcome_of({"ip", "netns", "del", name(Side::Far)});
  } catch (const std::exception&) {
    // `ip netns` lists what is left
  }
}

Address TwoNetworks::ipv4(Side side, std::uint16_t port) {
  return {side == Side::Near ? "10.77.0.1" : "10.77.0.2", port};
}

Address TwoNetworks::ipv6(Side side, std::uint16_t port) {
  return {side == Side::Near ? "fd77::1" : "fd77::2", port};
}

std::vector<std::string> TwoNetworks::inside(Side side,
                                             const std::vector<std::string>& words) const {
  std::vector<std::string> all = {"ip", "netns", "exec", name(side)};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

void TwoNetworks::stand(Side side, const std::function<void()>& action) const {
  std::exception_ptr thrown;
  std::thread there([&] {
    try {
      const std::string file = "/run/netns/" + name(side);
      const int handle = open(file.c_str(), O_RDONLY | O_CLOEXEC);
      const int entered = setns(handle, CLONE_NEWNET);
      const int error = errno;
      if (handle >= 0) close(handle);
      if (entered != 0) throw std::system_error(error, std::generic_category(), file);
      action();
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  there.join();
  if (thrown) std::rethrow_exception(thrown);
}

void TwoNetworks::rule(Side side, const std::string& rule) const {
  run_inside(side, {"nft", "add table inet kestrel"});
  run_inside(side, {"nft", "add chain inet kestrel in { type filter hook input priority 0 ; }"});
  run_inside(side, {"nft", "add rule inet kestrel in " + rule});
}

void TwoNetworks::clear_rules(Side side) const { run_inside(side, {"nft", "flush ruleset"}); }

void TwoNetworks::unplug() const { run_inside(Side::Far, {"ip", "link", "set", "cable", "down"}); }

void TwoNetworks::plug() const {
  run_inside(Side::Far, {"ip", "link", "set", "cable", "up"});
  // IPv6 addresses go with the link.
  run_inside(Side::Far, {"ip", "address", "replace", ipv6(Side::Far, 0).host + "/64", "dev",
                         "cable", "nodad"});
  wait_until_it_carries();
}

void TwoNetworks::wait_until_it_carries() const {
  for (const Address& at : {ipv4(Side::Far, 0), ipv6(Side::Far, 0)}) {
    std::optional<UdpSocket> far;
    std::optional<UdpSocket> near;
    stand(Side::Far, [&] { far.emplace(UdpSocket::bound_to(at)); });
    stand(Side::Near, [&] { near.emplace(UdpSocket::connected_to(far->local())); });
    const std::uint8_t byte = 0;
    bool carries = false;
    for (int i = 0; i < 200 && !carries; ++i) {  // neighbours ask for each other once a second
      near->send({&byte, 1});
      carries = far->receive(0.05).has_value();
    }
    if (!carries) throw std::runtime_error("the cable carries nothing to " + at.host);
  }
}

std::string TwoNetworks::name(Side side) const {
  return stem_ + (side == Side::Near ? "near" : "far");
}

void TwoNetworks::run_inside(Side side, const std::vector<std::string>& words) const {
  require(inside(side, words));
}

void TwoNetworks::set_up(Side side) const {
  run_inside(side, {"ip", "link", "set", "lo", "up"});
  run_inside(side, {"ip", "address", "add", ipv4(side, 0).host + "/30", "dev", "cable"});
  run_inside(side, {"ip", "address", "add", ipv6(side, 0).host + "/64", "dev", "cable", "nodad"});
  run_inside(side, {"ip", "link", "set", "cable", "up"});
}

}  // namespace kestrel::test
