#pragma once
#include <cstdint>
#include <new>

namespace orbc::cli {

/// What an allocation throws that would exceed the limit: only where the program, not the machine, has too little memory.
class MemoryLimitReached : public std::bad_alloc {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "the limit of memory is reached"; }
};

/// Bounds the memory of the program from now on: allocations that would exceed it throw MemoryLimitReached. Counted are what `new` hands
/// out and, where the system tells it (Linux), the resident pages: those of the program itself, of its stacks and of libraries in C.
/// Programs that orbc starts have memory of their own.
/// In: bytes > 0. The last 4 MiB of them are kept for small allocations, which clean up after a refusal.
void limit_memory(std::uint64_t bytes);

}  // namespace orbc::cli
