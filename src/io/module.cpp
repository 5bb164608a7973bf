#include "kestrel/io/module.hpp"

#include <stdexcept>

#include <dlfcn.h>

namespace kestrel {
namespace {

[[noreturn]] void fail(const std::string& file) {
  const char* why = dlerror();
  throw std::runtime_error(file + ": this part of the program cannot be loaded (" +
                           (why == nullptr ? "no cause given" : why) +
                           "); keep it beside the program, and build it there again");
}

}  // namespace

const void* module_table(const std::string& name) {
  const std::string file = "kestrel_" + name + ".so";
  // A bare name: looked for where the program says ($ORIGIN, its own folder). The system counts who
  // opened it, so opening it again is cheap and nothing has to be remembered here.
  void* const loaded = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) fail(file);
  const void* const table = dlsym(loaded, "kKestrelModule");
  if (table == nullptr) fail(file);
  return table;
}

}  // namespace kestrel
