#pragma once

namespace kestrel::app {

/// From now on Ctrl-C and SIGTERM ask the program to finish what it has begun instead of killing
/// it; a second one kills it.
void catch_interrupts();

/// True once Ctrl-C or SIGTERM arrived.
bool interrupted();

}  // namespace kestrel::app
