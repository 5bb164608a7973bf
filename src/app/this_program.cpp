#include "this_program.hpp"

#include <ctime>
#include <fstream>
#include <iterator>

#include <opencv2/core/utility.hpp>

#include "kestrel/eval/bench_store.hpp"

namespace kestrel::app {

std::string this_program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return "program " + digest(bytes) + ", OpenCV " + cv::getVersionString();
}

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace kestrel::app
