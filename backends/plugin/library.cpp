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

/// Of a plugin's name and version.
constexpr std::size_t kLongestName = 100;

Error unavailable(const std::string& path, const std::string& reason) {
  return {"plugin:" + path, "", reason, Failure::unavailable};
}

/// A struct of the plugin's, of as many members as both sides know, the rest 0; nothing where it is
/// too small to have those before `least`.
template <typename Struct>
std::optional<Struct> completed(const Struct* theirs, std::size_t least) {
  std::uint32_t size = 0;
  std::memcpy(&size, theirs, sizeof size);
  if (size < least) return std::nullopt;
  Struct ours{};
  std::memcpy(&ours, theirs, std::min<std::size_t>(size, sizeof ours));
  return ours;
}

/// A text of the plugin's, as one line.
std::optional<std::string> line_of(const char* text) {
  if (text == nullptr) return std::nullopt;
  return cases::one_line(std::string_view(text, ::strnlen(text, kLongestName)));
}

/// A member that has to be at most `most`.
struct Limited {
  std::string_view name;
  double value = 0;
  double most = 0;
};

/// What a contract says that cannot be; empty where there is nothing.
std::string fault_of(const rastercheck_contract& contract) {
  constexpr double kAllLacks = 2 * RASTERCHECK_LACKS_CENTROID - 1;
  constexpr double kAllKeeps = 2 * RASTERCHECK_KEEPS_EQUAL_DEPTH - 1;
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
    if (member.value >= 0 && member.value <= member.most) continue;  // not NaN
    return fmt::format("its contract's {} is {}, which has to be from 0 to {}", member.name,
                       member.value, member.most);
  }
  return "";
}

/// Up to the last members that ABI 1 began with: who has fewer is refused.
constexpr std::size_t kLeastPlugin =
    offsetof(rastercheck_plugin, draw) + sizeof(rastercheck_plugin::draw);
constexpr std::size_t kLeastContract =
    offsetof(rastercheck_contract, max_attributes) + sizeof(rastercheck_contract::max_attributes);

}  // namespace

Result<Plugin> checked_plugin(const rastercheck_plugin* theirs, const std::string& path) {
  if (theirs == nullptr) {
    return tl::unexpected(unavailable(path, "rastercheck_plugin_get() returned a null pointer"));
  }
  // Sizes and ABI stand where they are in every ABI.
  const auto header = completed(theirs, offsetof(rastercheck_plugin, name));
  if (header && header->abi != RASTERCHECK_PLUGIN_ABI) {
    return tl::unexpected(unavailable(
        path, fmt::format("it was made for plugin ABI {}, and this RasterCheck has ABI {}: compile "
                          "it with this one's rastercheck/plugin.h",
                          header->abi, RASTERCHECK_PLUGIN_ABI)));
  }
  const auto all = completed(theirs, kLeastPlugin);
  if (!all) {
    return tl::unexpected(unavailable(
        path,
        "its rastercheck_plugin's `size` is not sizeof(rastercheck_plugin), its first member"));
  }
  const auto name = line_of(all->name);
  const auto version = line_of(all->version);
  if (!name || !version || all->contract == nullptr || all->draw == nullptr) {
    return tl::unexpected(unavailable(
        path, "a null pointer is its rastercheck_plugin's name, version, contract or draw"));
  }
  const auto contract = completed(all->contract, kLeastContract);
  if (!contract) {
    return tl::unexpected(unavailable(path,
                                      "its contract's `size` is not sizeof(rastercheck_contract), "
                                      "its first member"));
  }
  if (const std::string fault = fault_of(*contract); !fault.empty()) {
    return tl::unexpected(unavailable(path, fault));
  }
  return Plugin{*name, *version, *contract, all->draw};
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
              "there is no such file; paths are from the folder that rastercheck runs in"});
  }
  // A name without a folder would be looked for elsewhere.
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
        path, std::string("exports no function ") + kName +
                  "() (a C++ plugin defines it as the header declares it, which is extern \"C\")"));
  }
  const rastercheck_plugin* const plugin =
      reinterpret_cast<decltype(&rastercheck_plugin_get)>(function)();
  if (modes.have_changed()) {
    return tl::unexpected(unavailable(
        path,
        "to load it changes the rounding mode, or how subnormal numbers are treated: link it "
        "without -ffast-math"));
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
  return promised;
}

namespace {

using Need = bool (*)(const cases::Case&);

bool has_rules(const cases::Case& c, cases::Rules rules) { return c.rules == rules; }

/// Whether some vertex of a triangle is such a one.
template <typename Is>
bool has_vertex(const cases::Case& c, const Is& is) {
  return std::any_of(c.triangles.begin(), c.triangles.end(), [&](const cases::Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return is(c.positions[v]); });
  });
}

bool has_attribute(const cases::Case& c, cases::Interpolation interpolation) {
  return std::any_of(c.attributes.begin(), c.attributes.end(),
                     [&](const cases::Attribute& a) { return a.interpolation == interpolation; });
}

/// One whose place is not the sample's own.
bool has_location(const cases::Case& c, cases::Location location) {
  return c.framebuffer.samples > 1 &&
         std::any_of(c.attributes.begin(), c.attributes.end(), [&](const cases::Attribute& a) {
           return a.location == location && a.interpolation != cases::Interpolation::flat;
         });
}

bool is_depth_clipped(const cases::Case& c) {
  const bool from_minus_one = c.rules == cases::Rules::opengl;
  return !c.depth_clamp && has_vertex(c, [from_minus_one](const cases::ClipVertex& p) {
    return p.z > p.w || p.z < (from_minus_one ? -p.w : 0);
  });
}

bool is_whole_viewport(const cases::Case& c) {
  const cases::Viewport& v = c.viewport;
  return v.x == 0 && v.y == 0 && v.width == static_cast<float>(c.framebuffer.width) &&
         v.height == static_cast<float>(c.framebuffer.height);
}

/// What a bit of rastercheck_contract.lacks stands for.
struct LackedKind {
  std::uint32_t bit;
  const char* name;
  Need needs;
};
const std::array<LackedKind, 17> kKinds{{
    {RASTERCHECK_LACKS_OPENGL, "OpenGL's rules",
     [](const cases::Case& c) { return has_rules(c, cases::Rules::opengl); }},
    {RASTERCHECK_LACKS_VULKAN, "Vulkan's rules",
     [](const cases::Case& c) { return has_rules(c, cases::Rules::vulkan); }},
    {RASTERCHECK_LACKS_D3D, "D3D's rules",
     [](const cases::Case& c) { return has_rules(c, cases::Rules::d3d); }},
    {RASTERCHECK_LACKS_NONPOSITIVE_W, "vertices with w <= 0",
     [](const cases::Case& c) {
       return has_vertex(c, [](const cases::ClipVertex& p) { return p.w <= 0; });
     }},
    {RASTERCHECK_LACKS_DEPTH_CLIPPING, "clipping by depth", &is_depth_clipped},
    {RASTERCHECK_LACKS_CLIP_DISTANCES, "clip distances",
     [](const cases::Case& c) { return c.clip_distance_count > 0; }},
    {RASTERCHECK_LACKS_DEPTH_CLAMP, "depth clamp",
     [](const cases::Case& c) { return c.depth_clamp; }},
    {RASTERCHECK_LACKS_DEPTH_RANGE, "depth ranges but 0 to 1",
     [](const cases::Case& c) { return c.viewport.min_depth != 0 || c.viewport.max_depth != 1; }},
    {RASTERCHECK_LACKS_DEPTH_TEST, "the depth test",
     [](const cases::Case& c) { return c.depth_test != cases::DepthTest::none; }},
    {RASTERCHECK_LACKS_VIEWPORT, "viewports but the whole framebuffer",
     [](const cases::Case& c) { return !is_whole_viewport(c); }},
    {RASTERCHECK_LACKS_SCISSOR, "scissors",
     [](const cases::Case& c) { return c.scissor.has_value(); }},
    {RASTERCHECK_LACKS_CULLING, "culling",
     [](const cases::Case& c) { return c.cull != cases::Cull::none; }},
    {RASTERCHECK_LACKS_SMOOTH, "smooth attributes",
     [](const cases::Case& c) { return has_attribute(c, cases::Interpolation::smooth); }},
    {RASTERCHECK_LACKS_NOPERSPECTIVE, "noperspective attributes",
     [](const cases::Case& c) { return has_attribute(c, cases::Interpolation::noperspective); }},
    {RASTERCHECK_LACKS_FLAT, "flat attributes",
     [](const cases::Case& c) { return has_attribute(c, cases::Interpolation::flat); }},
    {RASTERCHECK_LACKS_CENTER, "attributes at centres of several samples",
     [](const cases::Case& c) { return has_location(c, cases::Location::center); }},
    {RASTERCHECK_LACKS_CENTROID, "attributes at centroids of several samples",
     [](const cases::Case& c) { return has_location(c, cases::Location::centroid); }},
}};

}  // namespace

std::string lacks(const rastercheck_contract& contract, const cases::Case& c) {
  for (const LackedKind& kind : kKinds) {
    if ((contract.lacks & kind.bit) != 0 && kind.needs(c)) return kind.name;
  }
  const auto samples = static_cast<std::uint32_t>(c.framebuffer.samples);
  if (contract.sample_counts != 0 && (contract.sample_counts & samples) == 0) {
    return fmt::format("{} samples", samples);
  }
  const auto size = static_cast<std::uint32_t>(std::max(c.framebuffer.width, c.framebuffer.height));
  if (contract.max_size != 0 && size > contract.max_size) {
    return fmt::format("framebuffers of {} pixels", size);
  }
  if (contract.max_attributes != 0 && c.attributes.size() > contract.max_attributes) {
    return fmt::format("{} attributes", c.attributes.size());
  }
  return "";
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
  for (const LackedKind& kind : kKinds) {
    if ((contract.lacks & kind.bit) == 0) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(kind.name);
  }
  return missing.empty() ? text : text + "; not: " + missing;
}

}  // namespace rastercheck::backends
