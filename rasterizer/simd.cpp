#include "rasterizer/simd.h"

#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace rastercheck::rasterizer {
namespace {

/// Highway's targets are bits of this, the best ones the lowest; the highest is no target.
constexpr int kTargetBits = 63;

std::string name_of(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// What this processor has. It is asked once: on virtual machines the question takes long.
std::int64_t supported_targets() {
  static const std::int64_t supported = HWY_SUPPORTED_TARGETS;
  return supported;
}

/// The target of a name that can run here; 0 where there is none.
std::int64_t find_target(std::string_view name) {
  const std::int64_t usable = HWY_TARGETS & supported_targets();
  for (int bit = 0; bit < kTargetBits; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    if ((usable & target) != 0 && name_of(target) == name) return target;
  }
  return 0;
}

/// Of these the kernels take the best. Where they are compiled for one only they call it directly,
/// and there is nothing to choose.
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
