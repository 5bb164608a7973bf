// evaluate_peers: `kestrel evaluate` with the trackers of others among its methods.
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>

#include "bench/peers.hpp"
#include "evaluate.hpp"
#include "interrupt.hpp"

namespace kestrel::test {
namespace {

std::vector<BenchMethod> peers() {
  std::vector<BenchMethod> all = opencv_peers();
  for (BenchMethod& method : visp_peers()) all.push_back(std::move(method));
  return all;
}

/// As the program itself does: OpenCV's peers, too, take and return the same megabytes in every
/// frame, and would be timed with the system's clearing of them.
void keep_freed_memory() {
  constexpr int kKept = 1 << 29;
  mallopt(M_MMAP_THRESHOLD, kKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
}

int run(int argc, char** argv) {
  const std::vector<BenchMethod> more = peers();
  std::vector<std::string> names;
  for (const BenchMethod& method : more) names.push_back(method.name);
  const auto arguments = std::make_shared<app::EvaluateArguments>();
  arguments->output = "runs/evaluate_peers";
  CLI::App app("kestrel evaluate, with other trackers among its methods", "evaluate_peers");
  app::add_evaluate_options(app, arguments, names);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  app::catch_interrupts();
  keep_freed_memory();
  return app::evaluate(*arguments, more);
}

}  // namespace
}  // namespace kestrel::test

int main(int argc, char** argv) {
  try {
    return kestrel::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "evaluate_peers: {}\n", error.what());
    return 1;
  }
}
