#include "rasterizer/simd.h"

#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace rastercheck::rasterizer {
namespace {

/// Highway gives each target one bit of a number. Better targets have lower bits, and the highest
/// bit is not a target.
constexpr int kTargetBits = 63;

std::string name_of(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// The targets of this processor. Queried only once, because on virtual machines this is slow.
std::int64_t supported_targets() {
  static const std::int64_t supported = HWY_SUPPORTED_TARGETS;
  return supported;
}

/// The target with this name, if it can run here; otherwise 0.
std::int64_t find_target(std::string_view name) {
  const std::int64_t usable = HWY_TARGETS & supported_targets();
  for (int bit = 0; bit < kTargetBits; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    if ((usable & target) != 0 && name_of(target) == name) return target;
  }
  return 0;
}

/// Makes the kernels use the best of these targets. Does nothing if the kernels are compiled for
/// one target only, because they are then called directly.
void choose([[maybe_unused]] std::int64_t targets) {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) != 0
  hwy::GetChosenTarget().Update(targets);
#endif
}

std::mutex& choice() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

std::vector<SimdTarget> simd_targets() {
  std::vector<SimdTarget> targets;
  for (int bit = 0; bit < kTargetBits; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    std::string name = name_of(target);
    if (name == "unknown") continue;
    const bool is_compiled = (HWY_TARGETS & target) != 0;
    const bool is_supported = is_compiled && (supported_targets() & target) != 0;
    targets.push_back({std::move(name), is_compiled, is_supported});
  }
  return targets;
}

OnSimdTarget::OnSimdTarget(std::string_view name) {
  const std::int64_t target = name.empty() ? 0 : find_target(name);
  if (target == 0) return;
  lock_ = std::unique_lock(choice());
  choose(target);
}

OnSimdTarget::~OnSimdTarget() noexcept(false) {
  if (lock_.owns_lock()) choose(supported_targets());
}

}  // namespace rastercheck::rasterizer
