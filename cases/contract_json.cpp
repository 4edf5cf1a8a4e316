#include "cases/contract_json.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>
#include <vector>

#include "cases/conservative_json.h"
#include "cases/digest.h"
#include "cases/files.h"
#include "cases/json.h"
#include "cases/names.h"

namespace rastercheck::cases {

constexpr auto names_of(Claim /*type*/) {
  return std::to_array<std::string_view>({"perspective", "affine"});
}
constexpr auto names_of(Winding /*type*/) {
  return std::to_array<std::string_view>({"none", "clockwise", "counter_clockwise"});
}
constexpr auto names_of(KeptDepth /*type*/) {
  return std::to_array<std::string_view>({"less", "less_or_equal", "greater", "greater_or_equal"});
}
constexpr auto names_of(DepthError /*type*/) {
  return std::to_array<std::string_view>({"either_side", "never_nearer", "never_farther"});
}

namespace {

constexpr float kMost = std::numeric_limits<float>::max();
constexpr std::string_view kAsAsked = "as_asked";
constexpr std::string_view kNone = "none";

bool is_word(const JsonNode& node, std::string_view word) {
  return node.is_string() && node.text() == word;
}

/// Reads one rounding for both axes or, as {"x": …, "y": …}, one for each.
void read_rounding(const JsonNode& node, Snapping& snapping) {
  if (node.is_string()) {
    snapping.rounding = node.enumerator<Rounding>();
    return;
  }
  node.expect_object({"x", "y"}, {});
  snapping.rounding = node["x"].enumerator<Rounding>();
  const auto along_y = node["y"].enumerator<Rounding>();
  if (along_y == snapping.rounding) return;
  snapping.rounding_of_y = along_y;
  if (!node.failed() && (snapping.is_unspecified() || along_y == Rounding::unspecified)) {
    node.refuse("x and y must both be unspecified, or neither");
  }
}

CoverageTerm read_coverage_term(const JsonNode& node) {
  if (is_word(node, kAsAsked)) return AsAsked{};
  if (node.is_string()) {
    if (node.text() != "exact") {
      node.refuse("must be \"exact\", \"as_asked\" or an object with subpixel_bits");
    }
    return Coverage();
  }
  node.expect_object({}, {"subpixel_bits", "steps_per_pixel", "rounding", "position_error"});
  if (!node.failed() && node.has("subpixel_bits") == node.has("steps_per_pixel")) {
    node.refuse("must have either subpixel_bits or steps_per_pixel");
  }
  if (node.failed()) return AsAsked{};
  Snapping snapping;
  if (node.has("rounding")) read_rounding(node["rounding"], snapping);
  if (node.has("position_error")) {
    snapping.position_error = node["position_error"].float32(0, kMaxPositionError);
  }
  if (node.has("steps_per_pixel")) {
    const auto steps = node["steps_per_pixel"].integer(1, kMaxGridSteps);
    return Coverage(with_steps(snapping, static_cast<int>(steps)));
  }
  const JsonNode bits = node["subpixel_bits"];
  if (is_word(bits, kAsAsked)) {
    return AskedGrid{snapping.rounding, snapping.position_error, snapping.rounding_of_y};
  }
  snapping.subpixel_bits = static_cast<int>(bits.integer(0, kMaxSubpixelBits));
  return Coverage(snapping);
}

/// Reads one coordinate of a position within a pixel: a fraction such as "7/12", or 0.
std::array<int, 2> read_fraction(const JsonNode& node) {
  const std::string text = node.is_string() ? node.text() : "0/1";
  const bool is_zero = node.is_string() || node.integer(0, 0) == 0;
  const std::size_t slash = text.find('/');
  const auto number = [](std::string_view digits) {
    int value = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size() ? value : -1;
  };
  if (is_zero && slash != std::string::npos) {
    const int part = number(std::string_view(text).substr(0, slash));
    const int parts = number(std::string_view(text).substr(slash + 1));
    if (part >= 0 && parts > part && parts <= kMostPixelParts) return {part, parts};
  }
  node.refuse(fmt::format("must be 0 or a fraction below 1 such as \"7/12\", in at most {} parts",
                          kMostPixelParts));
  return {0, 1};
}

PixelFraction read_sample_position(const JsonNode& node) {
  const auto [along_x, along_y] = node.two_elements("fractions of a pixel, of x and y");
  const auto [x, parts_of_x] = read_fraction(along_x);
  const auto [y, parts_of_y] = read_fraction(along_y);
  const int parts = std::lcm(parts_of_x, parts_of_y);
  if (parts > kMostPixelParts) {
    node.refuse(fmt::format("must have a common denominator of at most {}", kMostPixelParts));
    return {};
  }
  return {x * (parts / parts_of_x), y * (parts / parts_of_y), parts};
}

ValueBound read_bound(const JsonNode& node) {
  node.expect_object({"constant"}, {"per_horizon", "per_condition", "range_share", "absolute"});
  const auto part = [&node](std::string_view key) {
    return node.has(key) ? node[key].float32(0, kMost) : 0;
  };
  return {node["constant"].float32(0, kMost), part("per_horizon"), part("per_condition"),
          part("range_share"), part("absolute")};
}

BiasPromise read_bias_promise(const JsonNode& node) {
  node.expect_object({}, {"slope", "unit", "exponent"});
  BiasPromise bias;
  if (node.has("slope")) bias.slope = node["slope"].enumerator<BiasSlope>();
  if (node.has("unit")) bias.unit = node["unit"].enumerator<BiasUnit>();
  if (node.has("exponent")) bias.exponent = node["exponent"].enumerator<BiasExponent>();
  return bias;
}

MagnitudeRange read_numbers(const JsonNode& node) {
  node.expect_object({}, {"least", "greatest"});
  MagnitudeRange range;
  if (node.has("least")) range.least = node["least"].float32(0, kMost);
  if (node.has("greatest")) range.greatest = node["greatest"].float32(0, kMost);
  if (!node.failed() && range.least > range.greatest) node.refuse("least must not exceed greatest");
  return range;
}

/// Reads a bound; empty for "none".
std::optional<float> read_promised_bound(const JsonNode& node) {
  if (is_word(node, kNone)) return std::nullopt;
  return node.float32(0, kMost);
}

/// Reads the term of a key, if the file has the key.
template <typename Promise, typename Read>
void read_term(const JsonNode& root, std::string_view key, std::optional<Promise>& term,
               const Read& read) {
  if (root.has(key)) term = read(root[key]);
}

template <typename Promise, typename Read>
void read_asked_term(const JsonNode& root, std::string_view key, Term<Promise>& term,
                     const Read& read) {
  if (!root.has(key)) return;
  if (is_word(root[key], kAsAsked)) {
    term = AsAsked{};
  } else {
    term = read(root[key]);
  }
}

void read_bounds(const JsonNode& node, ContractTerms& terms) {
  node.expect_object({}, {"smooth", "noperspective", "depth"});
  read_term(node, "smooth", terms.smooth, &read_bound);
  read_term(node, "noperspective", terms.noperspective, &read_bound);
  read_term(node, "depth", terms.depth, &read_bound);
  const auto& depth = terms.depth;
  const bool varies = depth && (!depth->is_uniform() || depth->range_share != 0);
  if (varies && !node.failed()) {
    node["depth"].refuse("must have only constant and absolute");
  }
}

void check_contract_header(const JsonNode& root) {
  // Checks format and version first, because in a later version unknown keys are not the fault.
  root.expect_format("rastercheck-contract");
  if (root.has("version") && root["version"].integer(0, std::numeric_limits<int>::max()) != 1) {
    root["version"].refuse("version must be 1");
  }
  root.expect_object({"format", "version"}, {"name",
                                             "promise",
                                             "coverage",
                                             "is_on_grid",
                                             "basis",
                                             "tie_rule",
                                             "conservative",
                                             "guard_band",
                                             "guard_beyond_viewport",
                                             "culls_instead_of_clipping",
                                             "culls",
                                             "least_area",
                                             "sample_position",
                                             "clip_tolerance",
                                             "clip_error",
                                             "viewport_error",
                                             "depth_format",
                                             "depth_store",
                                             "depth_bias",
                                             "depth_function",
                                             "depth_error",
                                             "claims",
                                             "bounds",
                                             "keeps_equal_depth",
                                             "keeps_constants",
                                             "keeps_vertex_values",
                                             "keeps_sign_of_zero",
                                             "is_invariant",
                                             "derivative_bound",
                                             "quad_share",
                                             "numbers"});
}

/// Refuses two members of a file that contradict each other, and names them.
void check_contradictions(const JsonNode& root, const ContractTerms& terms) {
  if (terms.guard_band && terms.guard_beyond_viewport) {
    root["guard_beyond_viewport"].refuse("contradicts guard_band: only one of them can hold");
  }
  const auto* coverage = terms.coverage ? std::get_if<Coverage>(&*terms.coverage) : nullptr;
  const bool is_exact = coverage != nullptr && !*coverage;
  const auto* basis = terms.basis ? std::get_if<Basis>(&*terms.basis) : nullptr;
  if (is_exact && basis != nullptr && *basis == Basis::snapped) {
    root["basis"].refuse("snapped contradicts coverage: exact, which has no snapped positions");
  }
  if (is_exact && terms.guard_beyond_viewport) {
    root["guard_beyond_viewport"].refuse(
        "contradicts coverage: exact, of which nothing may be clipped but beyond the viewport");
  }
}

// Writing.

std::string quoted(std::string_view word) { return fmt::format("\"{}\"", word); }
/// The shortest digits that read back as the same double, and so the same float32.
std::string text_of(float number) { return fmt::format("{}", double{number}); }
std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(const std::optional<float>& bound) {
  return bound ? text_of(*bound) : quoted(kNone);
}
std::string text_of(Basis basis) { return quoted(name_of(basis)); }
std::string text_of(DriverPromise promise) { return quoted(name_of(promise)); }
std::string text_of(DepthFormat format) { return quoted(name_of(format)); }
std::string text_of(Claim claim) { return quoted(name_of(claim)); }
std::string text_of(TieRule rule) { return quoted(name_of(rule)); }
std::string text_of(Winding winding) { return quoted(name_of(winding)); }
std::string text_of(KeptDepth function) { return quoted(name_of(function)); }
std::string text_of(DepthError error) { return quoted(name_of(error)); }
std::string text_of(DepthStore store) { return quoted(name_of(store)); }
std::string text_of(const BiasPromise& bias) {
  return fmt::format(R"({{"slope": "{}", "unit": "{}", "exponent": "{}"}})", name_of(bias.slope),
                     name_of(bias.unit), name_of(bias.exponent));
}

std::string text_of(const PixelFraction& at) {
  const auto fraction = [&at](int part) {
    const int common = std::gcd(part, at.parts);
    return part == 0 ? "0" : fmt::format("\"{}/{}\"", part / common, at.parts / common);
  };
  return fmt::format("[{}, {}]", fraction(at.x), fraction(at.y));
}

std::string grid_text(const std::string& grid, Rounding rounding,
                      const std::optional<Rounding>& rounding_of_y, float position_error) {
  const std::string roundings =
      rounding_of_y
          ? fmt::format(R"({{"x": "{}", "y": "{}"}})", name_of(rounding), name_of(*rounding_of_y))
          : quoted(name_of(rounding));
  return fmt::format(R"({{{}, "rounding": {}, "position_error": {}}})", grid, roundings,
                     text_of(position_error));
}

std::string text_of(const std::variant<AsAsked, AskedGrid, Coverage>& term) {
  if (const auto* grid = std::get_if<AskedGrid>(&term)) {
    return grid_text(R"("subpixel_bits": "as_asked")", grid->rounding, grid->rounding_of_y,
                     grid->position_error);
  }
  const auto* named = std::get_if<Coverage>(&term);
  if (named == nullptr) return quoted(kAsAsked);
  if (!*named) return quoted("exact");
  const Snapping& s = **named;
  const std::string spacing = s.odd_steps == 1
                                  ? fmt::format("\"subpixel_bits\": {}", s.subpixel_bits)
                                  : fmt::format("\"steps_per_pixel\": {}", s.steps());
  return grid_text(spacing, s.rounding, s.rounding_of_y, s.position_error);
}

std::string text_of(const ValueBound& bound) {
  // Left out where 0, so that the digests of older contracts stay what they are.
  const std::string absolute =
      bound.absolute == 0 ? "" : fmt::format(", \"absolute\": {}", text_of(bound.absolute));
  return fmt::format(
      R"({{"constant": {}, "per_horizon": {}, "per_condition": {}, "range_share": {}{}}})",
      text_of(bound.constant), text_of(bound.per_horizon), text_of(bound.per_condition),
      text_of(bound.range_share), absolute);
}

std::string text_of(const MagnitudeRange& range) {
  return fmt::format(R"({{"least": {}, "greatest": {}}})", text_of(range.least),
                     text_of(range.greatest));
}

/// Collects the members of an object that are present.
class Members {
 public:
  void add(std::string_view key, const std::string& value) {
    members_.push_back(fmt::format("\"{}\": {}", key, value));
  }
  template <typename Promise>
  void add(std::string_view key, const std::optional<Promise>& term) {
    if (term) add(key, text_of(*term));
  }
  template <typename Promise>
  void add_asked(std::string_view key, const Term<Promise>& term) {
    if (!term) return;
    const auto* named = std::get_if<Promise>(&*term);
    add(key, named == nullptr ? quoted(kAsAsked) : text_of(*named));
  }
  bool is_empty() const { return members_.empty(); }
  std::string joined(std::string_view between) const {
    return fmt::format("{}", fmt::join(members_, between));
  }

 private:
  std::vector<std::string> members_;
};

std::string bounds_text(const ContractTerms& terms) {
  Members bounds;
  bounds.add("smooth", terms.smooth);
  bounds.add("noperspective", terms.noperspective);
  bounds.add("depth", terms.depth);
  return bounds.is_empty() ? "" : fmt::format("{{\n    {}\n  }}", bounds.joined(",\n    "));
}

}  // namespace

std::string to_json(const ContractTerms& terms) {
  Members all;
  all.add("format", quoted("rastercheck-contract"));
  all.add("version", "1");
  if (!terms.name.empty()) all.add("name", json_string(terms.name));
  all.add("promise", terms.promise);
  all.add("coverage", terms.coverage);
  all.add("is_on_grid", terms.is_on_grid);
  all.add_asked("basis", terms.basis);
  all.add_asked("tie_rule", terms.tie_rule);
  if (terms.conservative) all.add("conservative", conservative_text(*terms.conservative));
  all.add("guard_band", terms.guard_band);
  all.add("guard_beyond_viewport", terms.guard_beyond_viewport);
  all.add("culls_instead_of_clipping", terms.culls_instead_of_clipping);
  all.add("culls", terms.culls);
  all.add("least_area", terms.least_area);
  all.add("sample_position", terms.sample_position);
  all.add("clip_tolerance", terms.clip_tolerance);
  all.add("clip_error", terms.clip_error);
  all.add("viewport_error", terms.viewport_error);
  all.add("depth_format", terms.depth_format);
  all.add("depth_store", terms.depth_store);
  all.add("depth_bias", terms.depth_bias);
  all.add("depth_function", terms.depth_function);
  all.add("depth_error", terms.depth_error);
  all.add("claims", terms.claims);
  if (const std::string bounds = bounds_text(terms); !bounds.empty()) all.add("bounds", bounds);
  all.add("keeps_equal_depth", terms.keeps_equal_depth);
  all.add("keeps_constants", terms.keeps_constants);
  all.add("keeps_vertex_values", terms.keeps_vertex_values);
  all.add("keeps_sign_of_zero", terms.keeps_sign_of_zero);
  all.add("is_invariant", terms.is_invariant);
  all.add("derivative_bound", terms.derivative_bound);
  all.add("quad_share", terms.quad_share);
  all.add("numbers", terms.numbers);
  return fmt::format("{{\n  {}\n}}\n", all.joined(",\n  "));
}

std::uint64_t digest_of(ContractTerms terms) {
  terms.name.clear();
  return fnv1a(to_json(terms));
}

ContractTerms read_contract_terms(const JsonNode& root) {
  ContractTerms terms;
  check_contract_header(root);
  if (root.failed()) return terms;
  if (root.has("name")) terms.name = root["name"].text();
  read_term(root, "promise", terms.promise,
            [](const JsonNode& node) { return node.enumerator<DriverPromise>(); });
  if (root.has("coverage")) terms.coverage = read_coverage_term(root["coverage"]);
  const auto boolean = [](const JsonNode& node) { return node.boolean(); };
  read_term(root, "is_on_grid", terms.is_on_grid, boolean);
  read_asked_term(root, "basis", terms.basis,
                  [](const JsonNode& node) { return node.enumerator<Basis>(); });
  read_asked_term(root, "tie_rule", terms.tie_rule,
                  [](const JsonNode& node) { return node.enumerator<TieRule>(); });
  const auto size = [](const JsonNode& node) { return node.float32(0, kMost); };
  read_term(root, "conservative", terms.conservative, &read_conservative);
  read_term(root, "guard_band", terms.guard_band, size);
  read_term(root, "guard_beyond_viewport", terms.guard_beyond_viewport, size);
  read_term(root, "culls_instead_of_clipping", terms.culls_instead_of_clipping, boolean);
  read_term(root, "culls", terms.culls,
            [](const JsonNode& node) { return node.enumerator<Winding>(); });
  read_term(root, "least_area", terms.least_area, size);
  read_term(root, "sample_position", terms.sample_position, &read_sample_position);
  read_term(root, "clip_tolerance", terms.clip_tolerance, size);
  read_term(root, "clip_error", terms.clip_error, size);
  read_term(root, "viewport_error", terms.viewport_error, size);
  read_term(root, "depth_format", terms.depth_format,
            [](const JsonNode& node) { return node.enumerator<DepthFormat>(); });
  read_term(root, "depth_store", terms.depth_store,
            [](const JsonNode& node) { return node.enumerator<DepthStore>(); });
  read_term(root, "depth_bias", terms.depth_bias, &read_bias_promise);
  read_term(root, "depth_function", terms.depth_function,
            [](const JsonNode& node) { return node.enumerator<KeptDepth>(); });
  read_term(root, "depth_error", terms.depth_error,
            [](const JsonNode& node) { return node.enumerator<DepthError>(); });
  read_term(root, "claims", terms.claims,
            [](const JsonNode& node) { return node.enumerator<Claim>(); });
  if (root.has("bounds")) read_bounds(root["bounds"], terms);
  read_term(root, "keeps_equal_depth", terms.keeps_equal_depth, boolean);
  read_term(root, "keeps_constants", terms.keeps_constants, boolean);
  read_term(root, "keeps_vertex_values", terms.keeps_vertex_values, boolean);
  read_term(root, "keeps_sign_of_zero", terms.keeps_sign_of_zero, boolean);
  read_term(root, "is_invariant", terms.is_invariant, boolean);
  read_term(root, "derivative_bound", terms.derivative_bound, &read_promised_bound);
  read_term(root, "quad_share", terms.quad_share, &read_promised_bound);
  read_term(root, "numbers", terms.numbers, &read_numbers);
  if (!root.failed()) check_contradictions(root, terms);
  return terms;
}

void write_value(nlohmann::json& to, const ContractTerms& terms) {
  // Parses the file writer's output, so that the two cannot drift apart.
  to = parse_json(to_json(terms), "contract").value_or(nlohmann::json());
}

void read_value(const JsonNode& node, ContractTerms& terms) { terms = read_contract_terms(node); }

Result<ContractTerms> parse_contract(std::string_view text, const std::string& file) {
  return read_json(text, file, [](const JsonNode& root) { return read_contract_terms(root); });
}

Result<ContractTerms> read_contract(const std::string& file) {
  return read_text(file).and_then(
      [&file](const std::string& text) { return parse_contract(text, file); });
}

}  // namespace rastercheck::cases
