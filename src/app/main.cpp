#include <exception>

#include <fmt/format.h>
#include <malloc.h>

#include "arguments.hpp"
#include "interrupt.hpp"
#include "verbs.hpp"

namespace {

/// OpenCV takes and returns the same megabytes in every frame: the allocator is told to keep them,
/// else the system maps and clears them anew each time (a fifth of a frame's time).
void keep_freed_memory() {
  constexpr int kKept = 1 << 29;
  mallopt(M_MMAP_THRESHOLD, kKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kestrel::app;  // NOLINT(google-build-using-namespace): this is the program
  const auto asked = parse_command_line(argc, argv);
  if (const int* code = std::get_if<int>(&asked)) return *code;
  catch_interrupts();
  keep_freed_memory();
  try {
    return std::visit([](const auto& arguments) { return run(arguments); },
                      std::get<Arguments>(asked));
  } catch (const std::exception& error) {
    fmt::print(stderr, "kestrel: {}\n", error.what());
    return 1;
  }
}
