#pragma once

#include <atomic>
#include <cstddef>

// malloc is replaced in the program by one that counts: operator new, Eigen and cv::Mat all end
// there. For one file of a program of its own, and not with sanitizers, whose malloc is not to be
// replaced.
namespace kestrel::test {

inline std::atomic<int> allocations{0};

}  // namespace kestrel::test

extern "C" {

void* __libc_malloc(std::size_t size);                       // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t count, std::size_t size);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t align, std::size_t size);  // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) noexcept {
  ++kestrel::test::allocations;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  ++kestrel::test::allocations;
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  ++kestrel::test::allocations;
  return __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t align, std::size_t size) noexcept {
  ++kestrel::test::allocations;
  return __libc_memalign(align, size);
}

int posix_memalign(void** memory, std::size_t align, std::size_t size) noexcept {
  ++kestrel::test::allocations;
  *memory = __libc_memalign(align, size);
  return *memory == nullptr ? 12 : 0;  // ENOMEM
}

}  // extern "C"
