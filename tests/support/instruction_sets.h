#pragma once
#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace orbc::testing {

/// The instruction sets that this machine can play, the best first: Highway's targets, the plain one last.
inline std::vector<std::int64_t> instruction_sets() {
  std::vector<std::int64_t> sets;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (target != HWY_STATIC_TARGET) sets.push_back(target);
  sets.push_back(HWY_STATIC_TARGET);
  return sets;
}

/// As long as it lives, kernels run as on a processor that knows this set and the worse ones, none better.
class OnInstructionSet {
 public:
  explicit OnInstructionSet(std::int64_t set) {
    hwy::SetSupportedTargetsForTest(set | HWY_STATIC_TARGET | (real() & ~(set - 1)));
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnInstructionSet(const OnInstructionSet&) = delete;
  OnInstructionSet& operator=(const OnInstructionSet&) = delete;
  ~OnInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

 private:
  static std::int64_t real() {
    hwy::SetSupportedTargetsForTest(0);
    return hwy::SupportedTargets();
  }
};

inline std::string name_of(std::int64_t set) { return hwy::TargetName(set); }

/// What `make` makes with each instruction set, the best first.
template <class F>
auto with_each_instruction_set(F make) {
  std::vector<decltype(make())> made;
  for (const std::int64_t set : instruction_sets()) {
    const OnInstructionSet on(set);
    made.push_back(make());
  }
  return made;
}

}  // namespace orbc::testing
