#include "backends/cpu/stage_trace.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

std::string numbered(const char* name, std::size_t index) { return name + std::to_string(index); }

std::string_view word(ras::Decision decision) {
  switch (decision) {
    case ras::Decision::in_double:
      return "in_double";
    case ras::Decision::exactly:
      return "exactly";
    case ras::Decision::in_whole_numbers:
      break;
  }
  return "in_whole_numbers";
}

double number(bool is_so) { return is_so ? 1 : 0; }

/// What the stage `evaluation` handed on of a value.
void add_value(const std::string& name, const ras::TracedValue& value,
               records::NamedNumbers& numbers) {
  numbers.push_back({name, value.value});
  numbers.push_back({name + "_is_exact", number(value.is_exact)});
  if (value.is_at_sample) return;
  numbers.push_back({name + "_u", value.u});
  numbers.push_back({name + "_v", value.v});
}

}  // namespace

records::SampleTrace sample_trace(const ras::Trace& trace) {
  records::StageTrace edges{"edges", {}, {}};
  records::NamedNumbers bands;
  records::NamedNumbers weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p = trace.edges.positions[i];
    const auto& [a, b, c] = trace.edges.coefficients[i];
    edges.received.push_back({numbered("x", i), p.x});
    edges.received.push_back({numbered("y", i), p.y});
    edges.received.push_back({numbered("z", i), p.z});
    edges.received.push_back({numbered("w", i), p.w});
    edges.handed_on.push_back({numbered("a", i), a});
    edges.handed_on.push_back({numbered("b", i), b});
    edges.handed_on.push_back({numbered("c", i), c});
    bands.push_back({numbered("band", i), trace.edges.bands[i]});
    edges.handed_on.push_back(bands.back());
    weights.push_back({numbered("E", i), trace.weights[i]});
  }
  edges.handed_on.push_back({"is_snapped", number(trace.edges.is_snapped)});
  const records::NamedNumbers certificate{
      {"least_sum", trace.edges.least_sum},
      {"affine_is_certain", number(trace.edges.affine_is_certain)},
      {"depth_is_certain", number(trace.edges.depth_is_certain)}};
  const records::NamedNumbers place{
      {"U", trace.place[0]}, {"V", trace.place[1]}, {"T", trace.place[2]}};

  records::SampleTrace result;
  records::NamedNumbers values;
  add_value("depth", trace.depth, values);
  result.depth = trace.depth.value;
  for (std::size_t a = 0; a < trace.attributes.size(); ++a) {
    add_value("r[" + std::to_string(a) + "]", trace.attributes[a], values);
    result.attributes.push_back(trace.attributes[a].value);
  }
  result.stages = {std::move(edges),
                   {"certificate", std::move(bands), certificate},
                   {"coverage", place, {{std::string(word(trace.decision)), 1}}},
                   {"weights", place, weights},
                   {"evaluation", weights, std::move(values)}};
  return result;
}

}  // namespace rastercheck::backends
