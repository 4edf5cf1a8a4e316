#include "backends/exec/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "backends/plugin/draw_state.h"
#include "cases/capabilities_json.h"
#include "cases/contract_json.h"
#include "cases/json.h"
#include "cases/json_members.h"

namespace rastercheck::backends {

namespace {
constexpr std::string_view kOurName = "RasterCheck";
}

template <typename Archive, cases::Either<ProgramHello> Hello>
void members(Archive& archive, Hello& hello) {
  std::uint64_t protocol = kExecProtocol;
  archive.required("protocol", protocol);
  archive.check([&](const cases::JsonNode& node) {
    if (protocol != kExecProtocol) {
      node["protocol"].refuse(fmt::format("must be {}, the only version", kExecProtocol));
    }
  });
  archive.required("name", hello.name);
  archive.check([&](const cases::JsonNode& node) {
    if (hello.name == kOurName)
      node["name"].refuse("is RasterCheck's: the program repeats what it reads");
  });
  archive.optional("version", hello.version);
  archive.optional("gives", hello.gives, Gives::attributes);
  archive.optional("shared_memory", hello.has_shared_memory);
  archive.optional("contract", hello.contract);
  archive.optional("limits", hello.limits);
  archive.optional("draws", hello.draws);
}

template <typename Archive, cases::Either<AnswerHeader> Header>
void members(Archive& archive, Header& header) {
  archive.required("status", header.status);
  archive.optional("message", header.message);
  archive.optional("min_x", header.min_x);
  archive.optional("min_y", header.min_y);
  archive.optional("max_x", header.max_x);
  archive.optional("max_y", header.max_y);
  archive.optional("bytes", header.bytes);
}

namespace {

static_assert(std::endian::native == std::endian::little);

tl::unexpected<Error> refusal(const std::string& reason) {
  return tl::unexpected(Error{"", "", reason});
}

/// Reads a line of JSON that a program wrote; `what` names it in errors.
template <typename T>
Result<T> parse_line(std::string_view line, const std::string& what) {
  Result<T> read = cases::read_json(line, what, &cases::read_as<T>);
  if (read) return read;
  return refusal(fmt::format("{}; it wrote {}", to_string(read.error()),
                             cases::json_string(cases::printable(line))));
}

template <typename T>
void append(std::string& to, std::span<const T> values) {
  static_assert(sizeof(T) % 4 == 0);
  if (values.empty()) return;
  const std::size_t begin = to.size();
  to.resize(begin + values.size_bytes());
  std::memcpy(to.data() + begin, values.data(), values.size_bytes());
}

/// Appends the arrays of all vertices and triangles of a case.
void append_whole(std::string& to, const cases::Case& c) {
  append(to, std::span(c.positions));
  append(to, std::span(c.attribute_values));
  append(to, std::span(c.clip_distances));
  append(to, std::span(c.triangles));
}

/// Appends the arrays of one triangle and its three vertices.
void append_triangle(std::string& to, const cases::Case& c, std::uint32_t triangle) {
  const auto append_rows = [&](const auto& values, std::size_t row) {
    for (const std::uint32_t vertex : c.triangles[triangle]) {
      append(to, std::span(values).subspan(vertex * row, row));
    }
  };
  append_rows(c.positions, 1);
  append_rows(c.attribute_values, c.attributes.size());
  append_rows(c.clip_distances, static_cast<std::size_t>(c.clip_distance_count));
  constexpr std::array<std::uint32_t, 3> kItsVertices{0, 1, 2};
  append(to, std::span<const std::uint32_t>(kItsVertices));
}

/// What a draw asks for where a case leaves the choice open, as rastercheck_draw does (plugin.h).
cases::Rounding asked(cases::Rounding rounding) {
  return rounding == cases::Rounding::half_up ? rounding : cases::Rounding::nearest_even;
}
cases::TieRule asked(cases::TieRule rule) {
  return rule == cases::TieRule::top_left ? rule : cases::TieRule::bottom_left;
}

/// The members of plugin.h's rastercheck_draw. Enumerators are written as the names that case files
/// use for them.
nlohmann::json header_of(const cases::Case& c, const cases::Contract& promised,
                         const rastercheck_draw& d) {
  const cases::Snapping grid = c.coverage.value_or(cases::Snapping{});
  nlohmann::json header{{"rules", name_of(c.rules)},
                        {"width", d.width},
                        {"height", d.height},
                        {"samples", d.samples},
                        {"viewport_x", d.viewport_x},
                        {"viewport_y", d.viewport_y},
                        {"viewport_width", d.viewport_width},
                        {"viewport_height", d.viewport_height},
                        {"min_depth", d.min_depth},
                        {"max_depth", d.max_depth},
                        {"scissor_x", d.scissor_x},
                        {"scissor_y", d.scissor_y},
                        {"scissor_width", d.scissor_width},
                        {"scissor_height", d.scissor_height},
                        {"cull", name_of(c.cull)},
                        {"front_face", name_of(c.front_face)},
                        {"depth_test", d.depth_test != 0},
                        {"depth_clamp", d.depth_clamp != 0},
                        {"depth_clear", d.depth_clear},
                        {"bias_constant", d.bias_constant},
                        {"bias_slope", d.bias_slope},
                        {"bias_clamp", d.bias_clamp},
                        {"depth_bits", d.depth_bits},
                        {"primitive", name_of(c.primitive)},
                        {"line_mode", name_of(c.line_mode)},
                        {"line_width", d.line_width},
                        {"point_size", d.point_size},
                        {"coverage", c.coverage ? "snapped" : "exact"},
                        {"subpixel_bits", d.subpixel_bits},
                        {"rounding", name_of(asked(grid.rounding))},
                        {"tie_rule", name_of(asked(c.fill_rule))},
                        {"basis", name_of(promised.coverage ? c.basis : cases::Basis::ideal)},
                        {"clip_distance_count", d.clip_distance_count},
                        {"attribute_count", d.attribute_count}};
  nlohmann::json& interpolations = header["interpolations"] = nlohmann::json::array();
  nlohmann::json& locations = header["locations"] = nlohmann::json::array();
  for (const cases::Attribute& attribute : c.attributes) {
    interpolations.push_back(name_of(attribute.interpolation));
    locations.push_back(name_of(attribute.location));
  }
  return header;
}

/// The bound of values that are computed from weights within `bound`: see contract_of().
cases::ValueBound bound_of_sums(const cases::ValueBound& bound) {
  constexpr float kFactor = 6;
  constexpr float kUlpsOfOne = 0x1p23F;
  return {kFactor * (bound.constant + bound.range_share * kUlpsOfOne) + 0.5F + 0x1p-20F,
          kFactor * bound.per_horizon, kFactor * bound.per_condition, 0};
}

/// A bound at which nothing is promised (cases::ValueBound).
constexpr cases::ValueBound kNoBound{.constant = 0x1p24F};

}  // namespace

std::string our_hello() {
  return nlohmann::json{{"protocol", kExecProtocol}, {"name", kOurName}}.dump();
}

Result<ProgramHello> parse_hello(std::string_view line) {
  Result<ProgramHello> hello = parse_line<ProgramHello>(line, "its first line");
  if (!hello) return hello;
  hello->name = cases::one_line(hello->name);
  hello->version = cases::one_line(hello->version);
  std::vector<cases::Feature>& lacks = hello->limits.lacks;
  const auto lack = [&lacks](cases::Feature feature) {
    if (std::find(lacks.begin(), lacks.end(), feature) == lacks.end()) lacks.push_back(feature);
  };
  for (const cases::Feature feature : {cases::Feature::depth_bias, cases::Feature::unorm_depth}) {
    const std::vector<cases::Feature>& draws = hello->draws;
    if (std::find(draws.begin(), draws.end(), feature) == draws.end()) lack(feature);
  }
  // Weights at a sample say nothing about other places, nor about values that are linear in the
  // window.
  if (hello->gives == Gives::barycentrics) {
    lack(cases::Feature::noperspective);
    lack(cases::Feature::center);
    lack(cases::Feature::centroid);
  }
  std::sort(lacks.begin(), lacks.end());
  return hello;
}

cases::Contract contract_of(const ProgramHello& hello, const cases::Case& c) {
  cases::Contract promised = cases::with_terms(cases::contract_of(c), hello.contract, c);
  if (hello.gives == Gives::attributes) return promised;
  promised.keeps_constants = false;
  promised.keeps_vertex_values = false;
  promised.keeps_sign_of_zero = false;
  if (hello.gives == Gives::barycentrics) {
    promised.bounds.smooth = bound_of_sums(promised.bounds.smooth);
    return promised;
  }
  promised.bounds.smooth = kNoBound;
  promised.bounds.noperspective = kNoBound;
  if (hello.gives == Gives::triangle) {
    promised.bounds.depth = kNoBound;
    promised.keeps_equal_depth = false;
  }
  return promised;
}

DrawMessage draw_message(const cases::Case& c, const cases::Contract& promised,
                         std::optional<std::uint32_t> triangle) {
  const rastercheck_draw d = draw_state(c, promised);
  DrawMessage message;
  message.samples = std::uint64_t{d.width} * d.height * d.samples;
  append(message.arrays, std::span<const float>(sample_places(c)));
  if (triangle) {
    append_triangle(message.arrays, c, *triangle);
  } else {
    append_whole(message.arrays, c);
  }
  nlohmann::json header = header_of(c, promised, d);
  header["vertex_count"] = triangle ? 3 : c.positions.size();
  header["triangle_count"] = triangle ? 1 : c.triangles.size();
  header["bytes"] = message.arrays.size();
  message.header = header.dump();
  return message;
}

void add_memory(DrawMessage& message, const MemoryPlan& memory) {
  message.header.pop_back();
  message.header +=
      fmt::format(R"(,"memory_size":{},"answer_at":{}}})", memory.size, memory.answer_at);
}

std::uint64_t answer_bytes(Gives gives, const cases::Case& c, std::uint64_t samples) {
  std::uint64_t words = 1;
  if (gives != Gives::triangle) ++words;
  if (gives == Gives::barycentrics) words += 3;
  if (gives == Gives::attributes) words += c.attributes.size();
  return samples * words * sizeof(float);
}

Result<AnswerHeader> parse_answer(std::string_view line, Gives gives, const cases::Case& c) {
  Result<AnswerHeader> header = parse_line<AnswerHeader>(line, "its answer");
  if (!header || header->status != AnswerHeader::Status::ok) return header;
  const auto width = static_cast<std::uint32_t>(c.framebuffer.width);
  const auto height = static_cast<std::uint32_t>(c.framebuffer.height);
  if (header->min_x > header->max_x || header->min_y > header->max_y || header->max_x > width ||
      header->max_y > height) {
    return refusal(
        fmt::format("its answer has an invalid rectangle: x from {} to {}, y from {} to "
                    "{}, of {} x {} pixels",
                    header->min_x, header->max_x, header->min_y, header->max_y, width, height));
  }
  const auto per_pixel = static_cast<std::uint64_t>(c.framebuffer.samples);
  const std::uint64_t due = answer_bytes(gives, c, header->pixels() * per_pixel);
  if (header->bytes != due) {
    return refusal(fmt::format("its answer has {} bytes; {} x {} pixels of {} samples have {}",
                               header->bytes, header->max_x - header->min_x,
                               header->max_y - header->min_y, per_pixel, due));
  }
  return header;
}

namespace {

/// Computes the attributes of a fragment from what a program gave for it.
class Values {
 public:
  Values(Gives gives, const cases::Case& c) : gives_(gives), case_(c) {}

  /// `given` are the weights or attributes at a sample.
  std::span<const float> of(std::uint32_t triangle, std::span<const float> given) {
    if (gives_ == Gives::attributes) return given;
    values_.clear();
    for (std::size_t a = 0; a < case_.attributes.size(); ++a) {
      values_.push_back(value(a, case_.triangles[triangle], given));
    }
    return values_;
  }

 private:
  float value(std::size_t a, const std::array<std::uint32_t, 3>& corners,
              std::span<const float> given) const {
    const auto at = [&](std::uint32_t vertex) {
      return case_.attribute_values[vertex * case_.attributes.size() + a];
    };
    if (case_.attributes[a].interpolation == cases::Interpolation::flat) {
      return at(case_.rules == cases::Rules::opengl ? corners[2] : corners[0]);
    }
    if (gives_ != Gives::barycentrics) return std::nanf("");
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) sum += double{given[i]} * at(corners[i]);
    return static_cast<float>(sum);
  }

  Gives gives_;
  const cases::Case& case_;
  std::vector<float> values_;
};

/// Copies the numbers at the beginning of an answer's arrays, which may lie at any address, and
/// drops them there.
template <typename T>
std::vector<T> take_numbers(std::string_view& arrays, std::size_t count) {
  const std::string_view bytes = arrays.substr(0, count * sizeof(T));
  arrays.remove_prefix(bytes.size());
  std::vector<T> numbers(count);
  if (count > 0) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace

std::string add_answer(const AnswerHeader& header, std::string_view arrays, Gives gives,
                       const cases::Case& c, std::optional<std::uint32_t> triangle,
                       cases::FragmentCollector& fragments) {
  const auto per_pixel = static_cast<std::uint32_t>(c.framebuffer.samples);
  const std::size_t count = header.pixels() * per_pixel;
  const std::size_t row = gives == Gives::barycentrics ? 3
                          : gives == Gives::attributes ? c.attributes.size()
                                                       : 0;
  const auto seen = take_numbers<std::uint32_t>(arrays, count);
  const auto depths = take_numbers<float>(arrays, gives == Gives::triangle ? 0 : count);
  const auto given = take_numbers<float>(arrays, row * count);
  Values values(gives, c);
  const std::uint32_t triangles = triangle ? 1 : static_cast<std::uint32_t>(c.triangles.size());
  fragments.reserve(count - static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 0U)));
  std::size_t i = 0;
  for (std::uint32_t y = header.min_y; y < header.max_y; ++y) {
    for (std::uint32_t x = header.min_x; x < header.max_x; ++x) {
      for (std::uint32_t sample = 0; sample < per_pixel; ++sample, ++i) {
        if (seen[i] == 0) continue;
        if (seen[i] > triangles) {
          return fmt::format(
              "its answer shows triangle {} at pixel {}, {}; 0 means none, and the draw has {}",
              seen[i], x, y, triangles);
        }
        const cases::SamplePlace at{triangle.value_or(seen[i] - 1), y, x, sample};
        const float depth = depths.empty() ? std::numeric_limits<float>::quiet_NaN() : depths[i];
        const auto own = std::span(given).subspan(i * row, row);
        if (std::string fault = fragments.add(at, depth, values.of(at.triangle, own));
            !fault.empty()) {
          return "its answer: " + fault;
        }
      }
    }
  }
  return "";
}

}  // namespace rastercheck::backends
