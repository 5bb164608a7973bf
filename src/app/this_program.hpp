#pragma once

#include <string>

namespace kestrel::app {

/// What every result depends on besides its inputs: this program and its OpenCV, as a digest.
std::string this_program();

/// Processor time of the calling thread, s: what others do meanwhile hardly counts.
double thread_cpu_s();

}  // namespace kestrel::app
