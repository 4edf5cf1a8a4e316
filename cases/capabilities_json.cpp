#include "cases/capabilities_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace rastercheck::cases {

template <typename Archive, Either<MagnitudeRange> T>
void members(Archive& archive, T& range) {
  archive.required("least", range.least);
  archive.required("greatest", range.greatest);
}

template <typename Archive, Either<Capabilities> T>
void members(Archive& archive, T& all) {
  const Capabilities usual;
  archive.optional("rules", all.rules, usual.rules);
  archive.optional("sample_counts", all.sample_counts, usual.sample_counts);
  archive.optional("primitives", all.primitives, usual.primitives);
  archive.optional("lacks", all.lacks);
  archive.optional("max_size", all.max_size, usual.max_size);
  archive.optional("size_multiple", all.size_multiple, usual.size_multiple);
  archive.optional("max_viewport", all.max_viewport, usual.max_viewport);
  archive.optional("max_attributes", all.max_attributes, usual.max_attributes);
  archive.optional("max_clip_distances", all.max_clip_distances, usual.max_clip_distances);
  archive.optional("numbers", all.numbers);
  archive.check([&](const JsonNode& node) {
    if constexpr (!std::is_const_v<T>) {
      std::sort(all.rules.begin(), all.rules.end());
      std::sort(all.sample_counts.begin(), all.sample_counts.end());
      std::sort(all.primitives.begin(), all.primitives.end());
      std::sort(all.lacks.begin(), all.lacks.end());
    }
    if (!has_meaning(all)) node.refuse("is inconsistent or excludes every case");
  });
}

void write_value(nlohmann::json& to, const Capabilities& capabilities) {
  write_members(to, capabilities);
}
void read_value(const JsonNode& node, Capabilities& capabilities) {
  read_members(node, capabilities);
}

}  // namespace rastercheck::cases
