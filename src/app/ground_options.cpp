#include "ground_options.hpp"

#include <CLI/CLI.hpp>

#include "kestrel/ground/request_guard.hpp"

namespace kestrel::app {
namespace {

void add_tls_options(CLI::App& verb, GroundArguments& ground, CLI::Option* port) {
  auto* certificate =
      verb.add_option("--ground-cert", ground.certificate,
                      "Serve it over TLS with this certificate, PEM, its chain behind it")
          ->needs(port);
  auto* key = verb.add_option("--ground-key", ground.key,
                              "The certificate's private key, PEM, a file of mode 0600")
                  ->needs(certificate);
  certificate->needs(key);
  verb.add_option_function<std::string>(
          "--ground-tls", [&ground](const std::string&) { ground.self_signed = true; },
          "self-signed: serve it over TLS with a certificate made for this run, whose SHA-256 "
          "fingerprint is printed once (default: without --ground-cert plain HTTP)")
      ->check(CLI::IsMember({"self-signed"}))
      ->needs(port)
      ->excludes(certificate);
  verb.add_flag("--ground-plain", ground.plain,
                "Allow plain HTTP beyond this machine: who listens on the way reads the token "
                "(default: refused)")
      ->needs(port);
}

}  // namespace

void add_ground_link(CLI::App& verb, GroundArguments& ground) {
  auto* link = verb.add_option(
      "--ground-link", ground.link,
      "A link of the operator's own to a switch, udp://HOST:PORT, of role ground there: a hand at "
      "the page's sticks flies by it, before the law and all others (default: by the way of the "
      "law's commands)");
  link->needs(verb.get_option("--ground"));
  verb.add_option("--ground-link-key", ground.link_key,
                  "Key file of that link, as 'kestrel key FILE' makes it: frames are signed, both "
                  "ways (default: unsigned)")
      ->needs(verb.get_option("--ground"));
}

void add_ground_options(CLI::App& verb, GroundArguments& ground, const std::string& what) {
  auto* port = verb.add_option_function<std::uint16_t>(
      "--ground", [&ground](std::uint16_t number) { ground.port = number; }, what);
  verb.add_option("--ground-bind", ground.host,
                  "Address to serve it at, a number (default 127.0.0.1: this machine only)")
      ->needs(port);
  verb.add_option("--ground-token", ground.token,
                  "File of mode 0600 with the token that a viewer must show, as 'kestrel key FILE' "
                  "makes it (default: a new token is printed once)")
      ->needs(port);
  add_tls_options(verb, ground, port);
  verb.parse_complete_callback([&ground] {
    const bool is_open = !is_loopback(ground.host) && !ground.plain && !ground.self_signed &&
                         ground.certificate.empty();
    if (!is_open) return;
    throw CLI::ValidationError(
        "--ground-bind", ground.host +
                             " is beyond this machine: serve TLS (--ground-tls self-signed, or "
                             "--ground-cert and --ground-key), or allow that the token is read on "
                             "the way with --ground-plain");
  });
}

}  // namespace kestrel::app
