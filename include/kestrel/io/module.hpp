#pragma once

#include <string>

namespace kestrel {

/// The address of the table `kKestrelModule` in kestrel_<name>.so, a part of the program that lies
/// beside it and is loaded when it is first asked for, because what it needs is large and most runs
/// do without. It stays loaded until the program ends. Throws std::runtime_error that names the
/// file, the cause and the remedy.
const void* module_table(const std::string& name);

/// The table as the type that the module's own header gives it.
template <class Table>
const Table& module_functions(const std::string& name) {
  return *static_cast<const Table*>(module_table(name));
}

}  // namespace kestrel
