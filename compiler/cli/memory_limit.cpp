// Every `new` of the program is counted. Threads keep a balance of their own and settle it every 256 KiB, so that they do not wait for each
// other; large allocations are settled, and compared with the limit, at once. Memory that has been asked for but not been touched is
// counted, not resident; memory of libraries in C is resident, not counted: so both sums are compared.
#include "compiler/cli/memory_limit.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ORBC_COUNTS_MEMORY 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define ORBC_COUNTS_MEMORY 0
#endif
#endif
#ifndef ORBC_COUNTS_MEMORY
#define ORBC_COUNTS_MEMORY 1
#endif

namespace orbc::cli {
namespace {

constexpr std::int64_t kSettleBytes = 256 << 10;
constexpr std::size_t kLargeBytes = 64 << 10;  // smaller allocations may use the reserve: what cleans up after a refusal needs some
constexpr std::int64_t kReserve = 4 << 20;
constexpr std::int64_t kAskEvery = 1 << 20;  // bytes after which a thread asks the system, which takes some microseconds
constexpr int kMmapThreshold = 1 << 20;      // larger blocks go back to the system when they are freed

std::atomic<std::int64_t> limit{0};          // of resident pages; 0: none
std::atomic<std::int64_t> counted_limit{0};  // of what `new` hands out: the limit without the pages that it does not
std::atomic<std::int64_t> counted{0};
thread_local std::int64_t balance = 0, unasked = 0;

/// The resident pages of the program, in bytes; 0 where the system does not tell.
std::int64_t resident_bytes() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[128] = {};
  const ssize_t length = ::read(file, text, sizeof text - 1);
  ::close(file);
  long long total = 0, resident = 0;
  if (length <= 0 || std::sscanf(text, "%lld %lld", &total, &resident) != 2) return 0;
  return resident * ::sysconf(_SC_PAGESIZE);
}

[[maybe_unused]] bool fits(std::size_t size) {
  if (limit.load(std::memory_order_relaxed) == 0) return true;
  if (size >= (std::size_t{1} << 62)) return false;
  const auto more = static_cast<std::int64_t>(size);
  const std::int64_t reserve = size < kLargeBytes ? kReserve : 0;
  if (counted.load(std::memory_order_relaxed) + balance + more > counted_limit.load(std::memory_order_relaxed) + reserve) return false;
  unasked += more;
  if (unasked < kAskEvery) return true;
  unasked = 0;
  const std::int64_t most = limit.load(std::memory_order_relaxed) - kReserve + reserve;
  if (resident_bytes() + more <= most) return true;
  ::malloc_trim(0);  // freed memory that the allocator has kept
  return resident_bytes() + more <= most;
}

[[maybe_unused]] void add(std::int64_t bytes) {
  balance += bytes;
  if (balance < kSettleBytes && balance > -kSettleBytes) return;
  counted.fetch_add(balance, std::memory_order_relaxed);
  balance = 0;
}

}  // namespace

void limit_memory(std::uint64_t bytes) {
  ::mallopt(M_MMAP_THRESHOLD, kMmapThreshold);
  const auto most = static_cast<std::int64_t>(bytes);
  const std::int64_t other = std::max<std::int64_t>(resident_bytes() - counted.load() - balance, 0);
  counted_limit.store(most - other - kReserve);
  limit.store(most);
}

namespace {

[[maybe_unused]] void* allocate(std::size_t size, std::size_t alignment) {
  if (!fits(size)) throw MemoryLimitReached();
  if (size == 0) size = 1;
  void* memory = nullptr;
  if (alignment <= alignof(std::max_align_t)) memory = std::malloc(size);
  else if (::posix_memalign(&memory, alignment, size) != 0) memory = nullptr;
  if (!memory) throw std::bad_alloc();
  add(static_cast<std::int64_t>(::malloc_usable_size(memory)));
  return memory;
}

[[maybe_unused]] void release(void* memory) noexcept {
  if (!memory) return;
  add(-static_cast<std::int64_t>(::malloc_usable_size(memory)));
  std::free(memory);
}

}  // namespace
}  // namespace orbc::cli

#if ORBC_COUNTS_MEMORY
// All other forms of the standard library call these.
void* operator new(std::size_t size) { return orbc::cli::allocate(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) { return orbc::cli::allocate(size, static_cast<std::size_t>(alignment)); }
void operator delete(void* memory) noexcept { orbc::cli::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { orbc::cli::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { orbc::cli::release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { orbc::cli::release(memory); }
#endif
