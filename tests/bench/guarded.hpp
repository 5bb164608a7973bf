#pragma once

#include <exception>
#include <iostream>

namespace kestrel::test {

/// What the main() of a measuring program returns: run's answer, or 1 when it throws, which is
/// said.
inline int guarded(int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}

}  // namespace kestrel::test
