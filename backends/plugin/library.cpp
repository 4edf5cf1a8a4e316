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

/// More than any float.
constexpr double kAnyNumber = 3.5e38;

/// A member of a contract whose value must be from 0 to `most`.
struct Limited {
  std::string_view name;
  double value = 0;
  double most = 0;
};

/// Names two members of a contract that contradict each other; empty if none do.
std::string contradiction_in(const rastercheck_contract& contract) {
  const auto contradict = [](std::string_view one, std::string_view other) {
    return fmt::format("in its contract, {} contradicts {}", one, other);
  };
  const bool is_unspecified = contract.rounding == RASTERCHECK_ROUNDING_UNSPECIFIED;
  if (contract.steps_per_pixel != 0 && contract.subpixel_bits != 0) {
    return contradict("steps_per_pixel", "subpixel_bits (one of them must be 0)");
  }
  if (contract.rounding_of_y != 0 &&
      is_unspecified != (contract.rounding_of_y == RASTERCHECK_ROUNDING_UNSPECIFIED + 1)) {
    return contradict("rounding_of_y", "rounding (both must be unspecified, or neither)");
  }
  if (contract.coverage == RASTERCHECK_COVERAGE_EXACT &&
      contract.basis == RASTERCHECK_BASIS_SNAPPED) {
    return contradict("basis SNAPPED", "coverage EXACT, which has no snapped positions");
  }
  if (contract.greatest_number != 0 && contract.least_number > contract.greatest_number) {
    return contradict("least_number", "greatest_number, which is less");
  }
  if (contract.sample_parts != 0) {
    if (contract.sample_x >= contract.sample_parts || contract.sample_y >= contract.sample_parts) {
      return contradict("sample_x or sample_y", "sample_parts, which must be greater");
    }
    if (contract.sample_counts != 1) {
      return contradict("sample_parts", "sample_counts, which must be 1 with it");
    }
  }
  if ((contract.lacks & RASTERCHECK_LACKS_DEPTH) != 0) {
    if ((contract.keeps & RASTERCHECK_KEEPS_EQUAL_DEPTH) != 0) {
      return contradict("keeps EQUAL_DEPTH", "lacks DEPTH");
    }
    if (contract.depth_error != RASTERCHECK_DEPTH_ON_EITHER_SIDE) {
      return contradict("depth_error", "lacks DEPTH");
    }
  }
  if (contract.conservative != RASTERCHECK_CONSERVATIVE_OUTER) {
    if (contract.conservative_growth != 0) {
      return contradict("conservative_growth", "conservative, which must be OUTER with it");
    }
    if (contract.shifts_edges != 0) {
      return contradict("shifts_edges", "conservative, which must be OUTER with it");
    }
    if (contract.covers_degenerates != 0) {
      return contradict("covers_degenerates", "conservative, which must be OUTER with it");
    }
  }
  if (contract.conservative == RASTERCHECK_CONSERVATIVE_NO && contract.conservative_error != 0) {
    return contradict("conservative_error", "conservative, which must be OUTER or INNER with it");
  }
  if (contract.max_size != 0 && contract.size_multiple > contract.max_size) {
    return contradict("size_multiple", "max_size, which is less");
  }
  return "";
}

/// The members that are about pictures.
std::vector<Limited> members_of_pictures(const rastercheck_contract& contract) {
  constexpr double kAllPictures = 2 * RASTERCHECK_PICTURES_ROUNDED_COORDINATES - 1;
  constexpr double kMostByte = 255;
  return {{"pictures", static_cast<double>(contract.pictures), kAllPictures},
          {"float_error", double{contract.float_error}, kAnyNumber},
          {"byte_store", double{contract.byte_store}, kMostByte},
          {"byte_blend", double{contract.byte_blend}, kMostByte},
          {"byte_mean", double{contract.byte_mean}, kMostByte},
          {"texel_share", double{contract.texel_share}, kAnyNumber},
          {"texel_distance", double{contract.texel_distance}, kAnyNumber},
          {"quad_share", double{contract.quad_share}, kAnyNumber},
          {"filter_share", double{contract.filter_share}, kAnyNumber},
          {"filter_constant", double{contract.filter_constant}, kAnyNumber},
          {"bilinear", double{contract.bilinear}, kAnyNumber},
          {"trilinear", double{contract.trilinear}, kAnyNumber},
          {"derivative_share", double{contract.derivative_share}, kAnyNumber}};
}

/// Describes an impossible value in a contract; empty if all values are possible.
std::string fault_of(const rastercheck_contract& contract) {
  constexpr double kAllLacks = 2 * RASTERCHECK_LACKS_DEPTH - 1;
  constexpr double kAllKeeps = 2 * RASTERCHECK_KEEPS_SIGN_OF_ZERO - 1;
  constexpr double kAllSamples = 31;
  const auto number = [](auto value) { return static_cast<double>(value); };
  std::vector<Limited> members{
      {"coverage", number(contract.coverage), RASTERCHECK_COVERAGE_SNAPPED},
      {"subpixel_bits", number(contract.subpixel_bits), cases::kMaxSubpixelBits},
      {"rounding", number(contract.rounding), RASTERCHECK_ROUNDING_TOWARD_ZERO},
      {"rounding_of_y", number(contract.rounding_of_y), RASTERCHECK_ROUNDING_TOWARD_ZERO + 1},
      {"steps_per_pixel", number(contract.steps_per_pixel), cases::kMaxGridSteps},
      {"clips", number(contract.clips), RASTERCHECK_CLIPS_BEYOND_VIEWPORT},
      {"beyond", number(contract.beyond), RASTERCHECK_BEYOND_LEFT_OUT},
      {"clip_error", number(contract.clip_error), kAnyNumber},
      {"least_number", number(contract.least_number), kAnyNumber},
      {"greatest_number", number(contract.greatest_number), kAnyNumber},
      {"culls", number(contract.culls), RASTERCHECK_CULLS_COUNTER_CLOCKWISE},
      {"least_area", number(contract.least_area), kAnyNumber},
      {"sample_parts", number(contract.sample_parts), cases::kMostPixelParts},
      {"smooth_absolute", number(contract.smooth_absolute), kAnyNumber},
      {"noperspective_absolute", number(contract.noperspective_absolute), kAnyNumber},
      {"depth_absolute", number(contract.depth_absolute), kAnyNumber},
      {"depth_function", number(contract.depth_function),
       RASTERCHECK_DEPTH_FUNCTION_GREATER_OR_EQUAL},
      {"depth_error", number(contract.depth_error), RASTERCHECK_DEPTH_NEVER_FARTHER},
      {"size_multiple", number(contract.size_multiple), cases::kMaxSize},
      {"conservative", number(contract.conservative), RASTERCHECK_CONSERVATIVE_INNER},
      {"conservative_error", number(contract.conservative_error), cases::kMaxConservativeReach},
      {"conservative_growth", number(contract.conservative_growth), cases::kMaxConservativeReach},
      {"shifts_edges", number(contract.shifts_edges), 1},
      {"covers_degenerates", number(contract.covers_degenerates), 1},
      {"draws", number(contract.draws), 2 * RASTERCHECK_DRAWS_POINTS - 1},
      {"depth_store", number(contract.depth_store), RASTERCHECK_STORE_EITHER},
      {"bias_slope", number(contract.bias_slope), RASTERCHECK_SLOPE_BETWEEN},
      {"bias_unit", number(contract.bias_unit), RASTERCHECK_UNIT_OPEN},
      {"bias_exponent", number(contract.bias_exponent), RASTERCHECK_EXPONENT_OPEN},
      {"position_error", number(contract.position_error), number(cases::kMaxPositionError)},
      {"clip_tolerance", number(contract.clip_tolerance), kAnyNumber},
      {"guard_band", number(contract.guard_band), kAnyNumber},
      {"tie_rule", number(contract.tie_rule), RASTERCHECK_TIE_RULE_NONE},
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
  const std::vector<Limited> of_pictures = members_of_pictures(contract);
  members.insert(members.end(), of_pictures.begin(), of_pictures.end());
  for (const Limited& member : members) {
    if (member.value >= 0 && member.value <= member.most) continue;  // false for NaN
    return fmt::format("its contract's {} is {}, but must be from 0 to {}", member.name,
                       member.value, member.most);
  }
  constexpr std::uint32_t kAllRules =
      RASTERCHECK_LACKS_OPENGL | RASTERCHECK_LACKS_VULKAN | RASTERCHECK_LACKS_D3D;
  if ((contract.lacks & kAllRules) == kAllRules)
    return "its contract excludes the rules of every API";
  return contradiction_in(contract);
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
  if (all->draw_picture != nullptr && (contract->lacks & RASTERCHECK_LACKS_DEPTH) != 0) {
    return tl::unexpected(unavailable(
        path,
        "its draw_picture contradicts its contract, which lacks DEPTH: pictures have depths"));
  }
  rastercheck_contract promised = *contract;
  // A plugin that was compiled before rastercheck_draw had depth_clear, or bias and format, does
  // not read these members.
  constexpr std::size_t kWithDepthClear =
      offsetof(rastercheck_contract, depth_format) + sizeof(rastercheck_contract::depth_format);
  if (all->contract->size < kWithDepthClear) promised.lacks |= RASTERCHECK_LACKS_DEPTH_CLEAR;
  return Plugin{*name, *version, promised, all->draw, all->query, all->draw_picture};
}

namespace {

cases::ValueBound bound_of(const rastercheck_bound& bound) {
  return {bound.constant == 0 ? cases::ValueBound().constant : bound.constant, bound.per_horizon,
          bound.per_condition, bound.range_share};
}

cases::Rounding rounding_of(std::uint32_t rounding) {
  constexpr std::array kRoundings{cases::Rounding::nearest_even, cases::Rounding::half_up,
                                  cases::Rounding::unspecified,  cases::Rounding::half_down,
                                  cases::Rounding::floor,        cases::Rounding::ceil,
                                  cases::Rounding::toward_zero};
  return kRoundings[rounding];
}

cases::Snapping snapping_of(const rastercheck_contract& contract) {
  cases::Snapping snapping{static_cast<int>(contract.subpixel_bits), rounding_of(contract.rounding),
                           contract.position_error};
  if (contract.steps_per_pixel != 0) {
    snapping = with_steps(snapping, static_cast<int>(contract.steps_per_pixel));
  }
  if (contract.rounding_of_y != 0 && contract.rounding_of_y != contract.rounding + 1) {
    snapping.rounding_of_y = rounding_of(contract.rounding_of_y - 1);
  }
  return snapping;
}

void add_limits_of_area(const rastercheck_contract& contract, cases::Contract& promised) {
  if (contract.clips == RASTERCHECK_CLIPS_BEYOND_VIEWPORT) {
    promised.guard_beyond_viewport = contract.guard_band;
  } else if (contract.guard_band > 0) {
    promised.guard_band = contract.guard_band;
  }
  promised.clip_tolerance = double{contract.clip_tolerance};
  promised.clip_error = double{contract.clip_error};
  promised.culls_instead_of_clipping = contract.beyond == RASTERCHECK_BEYOND_LEFT_OUT;
  constexpr std::array kWindings{cases::Winding::none, cases::Winding::clockwise,
                                 cases::Winding::counter_clockwise};
  promised.culls = kWindings[contract.culls];
  promised.least_area = contract.least_area;
}

void add_conservative(const rastercheck_contract& contract, cases::Contract& promised) {
  if (contract.conservative == RASTERCHECK_CONSERVATIVE_NO) return;
  const bool is_outer = contract.conservative == RASTERCHECK_CONSERVATIVE_OUTER;
  promised.conservative = cases::Conservative{
      is_outer ? cases::ConservativeKind::outer : cases::ConservativeKind::inner,
      contract.conservative_error, contract.conservative_growth,
      contract.shifts_edges != 0 ? cases::ConservativeCorners::edges
                                 : cases::ConservativeCorners::square,
      contract.covers_degenerates != 0};
}

void add_bounds(const rastercheck_contract& contract, cases::Contract& promised) {
  promised.bounds = {bound_of(contract.smooth), bound_of(contract.noperspective),
                     bound_of(contract.depth)};
  promised.bounds.smooth.absolute = contract.smooth_absolute;
  promised.bounds.noperspective.absolute = contract.noperspective_absolute;
  promised.bounds.depth.absolute = contract.depth_absolute;
  // A bound of so many ULP leaves no digit.
  constexpr float kNoDepth = 0x1p24F;
  if ((contract.lacks & RASTERCHECK_LACKS_DEPTH) != 0) promised.bounds.depth = {kNoDepth};
  constexpr std::array kSides{cases::DepthError::either_side, cases::DepthError::never_nearer,
                              cases::DepthError::never_farther};
  promised.depth_error = kSides[contract.depth_error];
  constexpr std::array kFunctions{cases::KeptDepth::less, cases::KeptDepth::less_or_equal,
                                  cases::KeptDepth::greater, cases::KeptDepth::greater_or_equal};
  promised.depth_function = kFunctions[contract.depth_function];
}

/// Adds how depths are biased and stored; `promised` has what the rules of the case say.
void add_depth_storage(const rastercheck_contract& contract, cases::Contract& promised) {
  constexpr std::array kStores{cases::DepthStore::nearest, cases::DepthStore::nearly_nearest,
                               cases::DepthStore::either};
  promised.depth_store = kStores[contract.depth_store];
  constexpr std::array kSlopes{cases::BiasSlope::greatest, cases::BiasSlope::root,
                               cases::BiasSlope::between};
  promised.depth_bias.slope = kSlopes[contract.bias_slope];
  constexpr std::array kUnits{cases::BiasUnit::power, cases::BiasUnit::double_power,
                              cases::BiasUnit::either_power, cases::BiasUnit::least_value,
                              cases::BiasUnit::open};
  if (contract.bias_unit != RASTERCHECK_UNIT_OF_RULES) {
    promised.depth_bias.unit = kUnits[contract.bias_unit - RASTERCHECK_UNIT_POWER];
  }
  promised.depth_bias.exponent = contract.bias_exponent == RASTERCHECK_EXPONENT_OPEN
                                     ? cases::BiasExponent::open
                                     : cases::BiasExponent::vertices;
}

/// The byte that is nearest is promised if a contract says nothing.
float byte_bound(float of_contract) {
  return of_contract == 0 ? cases::PictureBounds().byte_store : of_contract;
}

void add_pictures(const rastercheck_contract& contract, cases::Contract& promised) {
  const std::array<float, 6> bounds{contract.float_error, contract.byte_store,
                                    contract.byte_blend,  contract.byte_mean,
                                    contract.texel_share, contract.texel_distance};
  const bool leaves_open =
      contract.pictures != 0 ||
      std::any_of(bounds.begin(), bounds.end(), [](float bound) { return bound > 0; });
  if (leaves_open) {
    promised.picture_bounds = {
        .keeps_fragments = (contract.pictures & RASTERCHECK_PICTURES_OTHER_FRAGMENTS) == 0,
        .resolves_to_mean = (contract.pictures & RASTERCHECK_PICTURES_NO_MEAN) == 0,
        .float_error = contract.float_error,
        .byte_store = byte_bound(contract.byte_store),
        .byte_blend = byte_bound(contract.byte_blend),
        .byte_mean = byte_bound(contract.byte_mean),
        .texel_share = contract.texel_share,
        .texel_distance = contract.texel_distance};
  }
  if (contract.quad_share > 0) promised.quad_share = contract.quad_share;
  if (contract.bilinear > 0 || contract.trilinear > 0) {
    promised.texture_bounds = {.coordinate_share = contract.filter_share,
                               .coordinate_constant = contract.filter_constant,
                               .bilinear = contract.bilinear,
                               .trilinear = contract.trilinear,
                               .derivative_share = contract.derivative_share};
  }
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
    promised.coverage = snapping_of(contract);
  }
  add_limits_of_area(contract, promised);
  add_conservative(contract, promised);
  promised.numbers.least = contract.least_number;
  if (contract.greatest_number > 0) promised.numbers.greatest = contract.greatest_number;
  if (contract.sample_parts != 0) {
    promised.sample_position = cases::PixelFraction{static_cast<int>(contract.sample_x),
                                                    static_cast<int>(contract.sample_y),
                                                    static_cast<int>(contract.sample_parts)};
  }
  constexpr std::array kTieRules{cases::TieRule::top_left,
                                 cases::TieRule::bottom_left,
                                 cases::TieRule::unspecified,
                                 cases::TieRule::top_right,
                                 cases::TieRule::bottom_right,
                                 cases::TieRule::top_then_left,
                                 cases::TieRule::top_then_right,
                                 cases::TieRule::bottom_then_left,
                                 cases::TieRule::bottom_then_right,
                                 cases::TieRule::all,
                                 cases::TieRule::none};
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
  add_bounds(contract, promised);
  promised.keeps_constants = (contract.keeps & RASTERCHECK_KEEPS_CONSTANTS) != 0;
  promised.keeps_vertex_values = (contract.keeps & RASTERCHECK_KEEPS_VERTEX_VALUES) != 0;
  promised.keeps_equal_depth = (contract.keeps & RASTERCHECK_KEEPS_EQUAL_DEPTH) != 0;
  promised.keeps_sign_of_zero = (contract.keeps & RASTERCHECK_KEEPS_SIGN_OF_ZERO) != 0;
  constexpr std::array kDepthFormats{cases::DepthFormat::float32, cases::DepthFormat::float64,
                                     cases::DepthFormat::unorm16, cases::DepthFormat::unorm24,
                                     cases::DepthFormat::unorm32};
  if (c.depth_format == cases::DepthFormat::float32) {
    promised.depth_format = kDepthFormats[contract.depth_format];
  }
  add_depth_storage(contract, promised);
  add_pictures(contract, promised);
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
    LackedFeature{RASTERCHECK_LACKS_VIEWPORT_FRACTIONS, cases::Feature::viewport_fractions},
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
  if ((contract.draws & RASTERCHECK_DRAWS_DEPTH_BIAS) == 0) {
    has.lacks.push_back(cases::Feature::depth_bias);
  }
  if ((contract.draws & RASTERCHECK_DRAWS_UNORM_DEPTH) == 0) {
    has.lacks.push_back(cases::Feature::unorm_depth);
  }
  std::sort(has.lacks.begin(), has.lacks.end());
  if ((contract.draws & RASTERCHECK_DRAWS_LINES) != 0) {
    has.primitives.push_back(cases::Primitive::lines);
  }
  if ((contract.draws & RASTERCHECK_DRAWS_POINTS) != 0) {
    has.primitives.push_back(cases::Primitive::points);
  }
  std::erase_if(has.sample_counts, [&](int samples) {
    return contract.sample_counts != 0 &&
           (contract.sample_counts & static_cast<std::uint32_t>(samples)) == 0;
  });
  constexpr auto kMaxSize = static_cast<std::uint32_t>(cases::kMaxSize);
  if (contract.max_size != 0) {
    has.max_size = static_cast<int>(std::min(contract.max_size, kMaxSize));
  }
  if (contract.size_multiple > 1) has.size_multiple = static_cast<int>(contract.size_multiple);
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
    text += contract.steps_per_pixel == 0
                ? fmt::format("coverage snapped to {} subpixel bits", contract.subpixel_bits)
                : fmt::format("coverage snapped to 1/{} pixel", contract.steps_per_pixel);
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
  // Most plugins do not draw what they have to say that they draw: those that do are named.
  rastercheck_contract declared = contract;
  declared.draws = RASTERCHECK_DRAWS_DEPTH_BIAS | RASTERCHECK_DRAWS_UNORM_DEPTH;
  for (const cases::Feature feature : capabilities_of(declared).lacks) add(to_string(feature));
  if ((contract.lacks & RASTERCHECK_LACKS_DEPTH) != 0) add("depth values");
  if ((contract.draws & RASTERCHECK_DRAWS_DEPTH_BIAS) != 0) text += ", depth bias";
  if ((contract.draws & RASTERCHECK_DRAWS_UNORM_DEPTH) != 0) text += ", unorm depth";
  if ((contract.draws & RASTERCHECK_DRAWS_LINES) != 0) text += ", lines";
  if ((contract.draws & RASTERCHECK_DRAWS_POINTS) != 0) text += ", points";
  return missing.empty() ? text : text + "; not supported: " + missing;
}

}  // namespace rastercheck::backends
