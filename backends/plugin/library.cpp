#include "backends/plugin/library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include "backends/floating_point_modes.h"
#include "cases/case.h"
#include "cases/json.h"

namespace rastercheck::backends {
namespace {

/// The most bytes of a plugin's name or version that are used.
constexpr std::size_t kLongestName = 100;

Error unavailable(const std::string& path, const std::string& reason) {
  return {"plugin:" + path, "", reason, Failure::unavailable};
}

/// Copies the members of the plugin's struct that both sides know; the rest are 0. Empty if the
/// plugin's struct is smaller than `least` bytes.
template <typename Struct>
std::optional<Struct> completed(const Struct* theirs, std::size_t least) {
  std::uint32_t size = 0;
  std::memcpy(&size, theirs, sizeof size);
  if (size < least) return std::nullopt;
  Struct ours{};
  std::memcpy(&ours, theirs, std::min<std::size_t>(size, sizeof ours));
  return ours;
}

/// Returns the plugin's text as one line; empty for a null pointer.
std::optional<std::string> line_of(const char* text) {
  if (text == nullptr) return std::nullopt;
  return cases::one_line(std::string_view(text, ::strnlen(text, kLongestName)));
}

/// A member of a contract whose value must be from 0 to `most`.
struct Limited {
  std::string_view name;
  double value = 0;
  double most = 0;
};

/// Describes an impossible value in a contract; empty if all values are possible.
std::string fault_of(const rastercheck_contract& contract) {
  constexpr double kAllLacks = 2 * RASTERCHECK_LACKS_SIDE_CLIPPING - 1;
  constexpr double kAllKeeps = 2 * RASTERCHECK_KEEPS_SIGN_OF_ZERO - 1;
  constexpr double kAllSamples = 31;
  constexpr double kAnyNumber = 3.5e38;
  const auto number = [](auto value) { return static_cast<double>(value); };
  std::vector<Limited> members{
      {"coverage", number(contract.coverage), RASTERCHECK_COVERAGE_SNAPPED},
      {"subpixel_bits", number(contract.subpixel_bits), cases::kMaxSubpixelBits},
      {"rounding", number(contract.rounding), RASTERCHECK_ROUNDING_UNSPECIFIED},
      {"position_error", number(contract.position_error), number(cases::kMaxPositionError)},
      {"clip_tolerance", number(contract.clip_tolerance), kAnyNumber},
      {"guard_band", number(contract.guard_band), kAnyNumber},
      {"tie_rule", number(contract.tie_rule), RASTERCHECK_TIE_RULE_UNSPECIFIED},
      {"basis", number(contract.basis), RASTERCHECK_BASIS_UNSPECIFIED},
      {"claims", number(contract.claims), RASTERCHECK_CLAIM_AFFINE},
      {"depth_format", number(contract.depth_format), RASTERCHECK_DEPTH_UNORM32},
      {"keeps", number(contract.keeps), kAllKeeps},
      {"lacks", number(contract.lacks), kAllLacks},
      {"sample_counts", number(contract.sample_counts), kAllSamples}};
  const std::array<std::pair<std::string, const rastercheck_bound*>, 3> bounds{
      {{"smooth", &contract.smooth},
       {"noperspective", &contract.noperspective},
       {"depth", &contract.depth}}};
  for (const auto& [name, bound] : bounds) {
    for (const float share :
         {bound->constant, bound->per_horizon, bound->per_condition, bound->range_share}) {
      members.push_back({name, number(share), kAnyNumber});
    }
  }
  for (const Limited& member : members) {
    if (member.value >= 0 && member.value <= member.most) continue;  // false for NaN
    return fmt::format("its contract's {} is {}, but must be from 0 to {}", member.name,
                       member.value, member.most);
  }
  constexpr std::uint32_t kAllRules =
      RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D;
  if ((contract.lacks & kAllRules) == kAllRules)
    return "its contract excludes the rules of every API";
  return "";
}

/// The sizes of the structs in the first version of ABI 1; smaller structs are refused.
constexpr std::size_t kLeastPlugin =
    offsetof(rastercheck_plugin, draw) + sizeof(rastercheck_plugin::draw);
constexpr std::size_t kLeastContract =
    offsetof(rastercheck_contract, max_attributes) + sizeof(rastercheck_contract::max_attributes);

}  // namespace

Result<Plugin> checked_plugin(const rastercheck_plugin* theirs, const std::string& path) {
  if (theirs == nullptr) {
    return tl::unexpected(unavailable(path, "rastercheck_plugin_get() returned a null pointer"));
  }
  // The sizes and the ABI number are at the same place in every ABI.
  const auto header = completed(theirs, offsetof(rastercheck_plugin, name));
  if (header && header->abi != RASTERCHECK_PLUGIN_ABI) {
    return tl::unexpected(
        unavailable(path, fmt::format("it was compiled for plugin ABI {}, but this RasterCheck has "
                                      "ABI {}; compile it with this version's rastercheck/plugin.h",
                                      header->abi, RASTERCHECK_PLUGIN_ABI)));
  }
  const auto all = completed(theirs, kLeastPlugin);
  if (!all) {
    return tl::unexpected(unavailable(
        path,
        "the first member of its rastercheck_plugin, `size`, is not sizeof(rastercheck_plugin)"));
  }
  const auto name = line_of(all->name);
  const auto version = line_of(all->version);
  if (!name || !version || all->contract == nullptr || all->draw == nullptr) {
    return tl::unexpected(unavailable(
        path, "the name, version, contract or draw of its rastercheck_plugin is a null pointer"));
  }
  const auto contract = completed(all->contract, kLeastContract);
  if (!contract) {
    return tl::unexpected(unavailable(
        path, "the first member of its contract, `size`, is not sizeof(rastercheck_contract)"));
  }
  if (const std::string fault = fault_of(*contract); !fault.empty()) {
    return tl::unexpected(unavailable(path, fault));
  }
  rastercheck_contract promised = *contract;
  // A plugin that was compiled before rastercheck_draw had depth_clear does not read that member.
  constexpr std::size_t kWithDepthClear =
      offsetof(rastercheck_contract, depth_format) + sizeof(rastercheck_contract::depth_format);
  if (all->contract->size < kWithDepthClear) promised.lacks |= RASTERCHECK_LACKS_DEPTH_CLEAR;
  return Plugin{*name, *version, promised, all->draw, all->query};
}

namespace {

cases::ValueBound bound_of(const rastercheck_bound& bound) {
  return {bound.constant == 0 ? cases::ValueBound().constant : bound.constant, bound.per_horizon,
          bound.per_condition, bound.range_share};
}

cases::Rounding rounding_of(std::uint32_t rounding) {
  if (rounding == RASTERCHECK_ROUNDING_HALF_UP) return cases::Rounding::half_up;
  return rounding == RASTERCHECK_ROUNDING_NEAREST_EVEN ? cases::Rounding::nearest_even
                                                       : cases::Rounding::unspecified;
}

}  // namespace

Result<Plugin> load_plugin(const std::string& path) {
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) {
    return tl::unexpected(
        Error{"plugin:" + path, "",
              "no such file; paths are relative to the folder that rastercheck runs in"});
  }
  // If the name has no folder, dlopen() would search elsewhere.
  const std::string file = std::filesystem::absolute(path, problem).string();
  const FloatingPointModes modes;
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return tl::unexpected(unavailable(path, std::string("cannot be loaded as a shared library: ") +
                                                cases::one_line(::dlerror())));
  }
  constexpr const char* kName = "rastercheck_plugin_get";
  void* const function = ::dlsym(library, kName);
  if (function == nullptr) {
    return tl::unexpected(unavailable(
        path, std::string("does not export the function ") + kName +
                  "() (a C++ plugin must define it as extern \"C\", as the header declares it)"));
  }
  const rastercheck_plugin* const plugin =
      reinterpret_cast<decltype(&rastercheck_plugin_get)>(function)();
  if (modes.have_changed()) {
    return tl::unexpected(unavailable(path,
                                      "loading it changes the rounding mode or the treatment of "
                                      "subnormal numbers; link it without -ffast-math"));
  }
  return checked_plugin(plugin, path);
}

cases::Contract contract_of(const rastercheck_contract& contract, const cases::Case& c) {
  cases::Contract promised = cases::contract_of(c);
  if (contract.coverage == RASTERCHECK_COVERAGE_EXACT) promised.coverage = std::nullopt;
  if (contract.coverage == RASTERCHECK_COVERAGE_SNAPPED) {
    promised.coverage = cases::Snapping{static_cast<int>(contract.subpixel_bits),
                                        rounding_of(contract.rounding), contract.position_error};
  }
  promised.clip_tolerance = double{contract.clip_tolerance};
  if (contract.guard_band > 0) promised.guard_band = contract.guard_band;
  constexpr std::array kTieRules{cases::TieRule::top_left, cases::TieRule::bottom_left,
                                 cases::TieRule::unspecified};
  if (contract.tie_rule != RASTERCHECK_TIE_RULE_AS_ASKED) {
    promised.tie_rule = kTieRules[contract.tie_rule - RASTERCHECK_TIE_RULE_TOP_LEFT];
  }
  constexpr std::array kBases{cases::Basis::ideal, cases::Basis::snapped,
                              cases::Basis::unspecified};
  promised.basis = contract.basis == RASTERCHECK_BASIS_AS_ASKED
                       ? c.basis
                       : kBases[contract.basis - RASTERCHECK_BASIS_IDEAL];
  if (!promised.coverage) promised.basis = cases::Basis::ideal;
  promised.claims = contract.claims == RASTERCHECK_CLAIM_AFFINE ? cases::Claim::affine
                                                                : cases::Claim::perspective;
  promised.bounds = {bound_of(contract.smooth), bound_of(contract.noperspective),
                     bound_of(contract.depth)};
  promised.keeps_constants = (contract.keeps & RASTERCHECK_KEEPS_CONSTANTS) != 0;
  promised.keeps_vertex_values = (contract.keeps & RASTERCHECK_KEEPS_VERTEX_VALUES) != 0;
  promised.keeps_equal_depth = (contract.keeps & RASTERCHECK_KEEPS_EQUAL_DEPTH) != 0;
  promised.keeps_sign_of_zero = (contract.keeps & RASTERCHECK_KEEPS_SIGN_OF_ZERO) != 0;
  constexpr std::array kDepthFormats{cases::DepthFormat::float32, cases::DepthFormat::float64,
                                     cases::DepthFormat::unorm16, cases::DepthFormat::unorm24,
                                     cases::DepthFormat::unorm32};
  promised.depth_format = kDepthFormats[contract.depth_format];
  return promised;
}

namespace {

/// A bit of rastercheck_contract.lacks, and the feature that it excludes.
struct LackedFeature {
  std::uint32_t bit;
  cases::Feature feature;
};
constexpr std::array kFeatures{
    LackedFeature{RASTERCHECK_LACKS_NONPOSITIVE_W, cases::Feature::nonpositive_w},
    LackedFeature{RASTERCHECK_LACKS_DEPTH_CLIPPING, cases::Feature::depth_clipping},
    LackedFeature{RASTERCHECK_LACKS_SIDE_CLIPPING, cases::Feature::side_clipping},
    LackedFeature{RASTERCHECK_LACKS_CLIP_DISTANCES, cases::Feature::clip_distances},
    LackedFeature{RASTERCHECK_LACKS_DEPTH_CLAMP, cases::Feature::depth_clamp},
    LackedFeature{RASTERCHECK_LACKS_DEPTH_RANGE, cases::Feature::depth_range},
    LackedFeature{RASTERCHECK_LACKS_DEPTH_TEST, cases::Feature::depth_test},
    LackedFeature{RASTERCHECK_LACKS_DEPTH_CLEAR, cases::Feature::depth_clear},
    LackedFeature{RASTERCHECK_LACKS_VIEWPORT, cases::Feature::viewport},
    LackedFeature{RASTERCHECK_LACKS_SCISSOR, cases::Feature::scissor},
    LackedFeature{RASTERCHECK_LACKS_CULLING, cases::Feature::culling},
    LackedFeature{RASTERCHECK_LACKS_SMOOTH, cases::Feature::smooth},
    LackedFeature{RASTERCHECK_LACKS_NOPERSPECTIVE, cases::Feature::noperspective},
    LackedFeature{RASTERCHECK_LACKS_FLAT, cases::Feature::flat},
    LackedFeature{RASTERCHECK_LACKS_CENTER, cases::Feature::center},
    LackedFeature{RASTERCHECK_LACKS_CENTROID, cases::Feature::centroid}};

bool has_rules(const rastercheck_contract& contract, cases::Rules rules) {
  constexpr std::array<std::uint32_t, 3> kBits{RASTERCHECK_LACKS_OPENGL, RASTERCHECK_LACKS_VULKAN,
                                               RASTERCHECK_LACKS_D3D};
  return (contract.lacks & kBits[static_cast<std::size_t>(rules)]) == 0;
}

}  // namespace

cases::Capabilities capabilities_of(const rastercheck_contract& contract) {
  cases::Capabilities has;
  std::erase_if(has.rules, [&](cases::Rules rules) { return !has_rules(contract, rules); });
  for (const LackedFeature& one : kFeatures) {
    if ((contract.lacks & one.bit) != 0) has.lacks.push_back(one.feature);
  }
  std::erase_if(has.sample_counts, [&](int samples) {
    return contract.sample_counts != 0 &&
           (contract.sample_counts & static_cast<std::uint32_t>(samples)) == 0;
  });
  constexpr auto kMaxSize = static_cast<std::uint32_t>(cases::kMaxSize);
  if (contract.max_size != 0) {
    has.max_size = static_cast<int>(std::min(contract.max_size, kMaxSize));
  }
  if (contract.max_attributes != 0) {
    has.max_attributes = std::min(std::size_t{contract.max_attributes}, has.max_attributes);
  }
  return has;
}

std::string lacks(const rastercheck_contract& contract, const cases::Case& c) {
  return lacked_by(capabilities_of(contract), c);
}

std::string describe(const Plugin& plugin) {
  const rastercheck_contract& contract = plugin.contract;
  std::string text = fmt::format("{} {}: ", plugin.name, plugin.version);
  if (contract.coverage == RASTERCHECK_COVERAGE_SNAPPED) {
    text += fmt::format("coverage snapped to {} subpixel bits", contract.subpixel_bits);
  } else {
    text += contract.coverage == RASTERCHECK_COVERAGE_EXACT ? "exact coverage"
                                                            : "coverage as each case asks";
  }
  const cases::ValueBound smooth = bound_of(contract.smooth);
  text += fmt::format(", smooth values within {}{} scale ULP", smooth.constant,
                      smooth.is_constant() ? "" : " and more");
  std::string missing;
  const auto add = [&missing](std::string_view what) {
    missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  for (const cases::Rules rules : cases::Capabilities().rules) {
    if (!has_rules(contract, rules)) add(cases::words_for(rules));
  }
  for (const cases::Feature feature : capabilities_of(contract).lacks) add(to_string(feature));
  return missing.empty() ? text : text + "; not supported: " + missing;
}

}  // namespace rastercheck::backends
