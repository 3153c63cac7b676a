#include "unit/bus/hostile/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocated_bytes = 0;

}  // namespace

// Counts what a decoder asks for, so that a length that it believes shows even where memory is plenty. In a
// file of its own: inlined, the compiler takes new and free() for a mismatch.
void* operator new(std::size_t size) {
  allocated_bytes += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

std::size_t skein::bus::testing::AllocatedBytes() { return allocated_bytes; }
