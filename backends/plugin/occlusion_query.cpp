#include "backends/plugin/occlusion_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "backends/plugin/draw_state.h"
#include "backends/plugin/foreign_call.h"

namespace rastercheck::backends {
Result<void> OcclusionQuery::hand_over(const cases::Case& c, std::size_t occluders) {
  const std::vector<float> places = sample_places(c);
  const std::span<const cases::Triangle> triangles(c.triangles);
  const std::array<std::pair<GuardedArray*, std::span<const std::byte>>, 5> inputs{
      {{&sample_positions_, std::as_bytes(std::span(places))},
       {&positions_, std::as_bytes(std::span(c.positions))},
       {&clip_distances_, std::as_bytes(std::span(c.clip_distances))},
       {&occluders_, std::as_bytes(triangles.first(occluders))},
       {&occludee_, std::as_bytes(triangles.subspan(occluders))}}};
  for (const auto& [array, bytes] : inputs) {
    if (Result<void> assigned = array->assign(bytes); !assigned) return assigned;
  }
  if (Result<void> resized = message_.resize(kMessageSize); !resized) return resized;
  std::fill_n(message_.as<char>(), kMessageSize, '\0');
  return {};
}

Result<bool> OcclusionQuery::ask(const Plugin& plugin, const cases::Case& c,
                                 std::size_t occluders) {
  const ForeignCall foreign{path_, "query", &message_};
  cases::Case bare = c;
  bare.attributes.clear();
  bare.attribute_values.clear();
  // A query compares depths, whether or not draw() does.
  bare.depth_test = cases::DepthTest::none;
  if (const std::string what = lacks(plugin.contract, bare); !what.empty()) {
    return foreign.fail("its contract lacks " + what, Failure::unsupported);
  }
  bare.depth_test = cases::DepthTest::less;
  if (!hand_over(bare, occluders)) {
    return foreign.fail("the arrays of a query do not fit into the memory of its process",
                        Failure::unsupported);
  }
  rastercheck_draw hiding = draw_state(bare, contract_of(plugin.contract, bare));
  hiding.sample_positions = sample_positions_.as<const float>();
  hiding.positions = positions_.as<const float>();
  hiding.clip_distances = clip_distances_.as<const float>();
  rastercheck_draw asked_about = hiding;
  hiding.triangle_count = static_cast<std::uint32_t>(occluders);
  hiding.indices = occluders_.as<const std::uint32_t>();
  asked_about.triangle_count = static_cast<std::uint32_t>(c.triangles.size() - occluders);
  asked_about.indices = occludee_.as<const std::uint32_t>();
  const rastercheck_query query{sizeof query, 0, &hiding, &asked_about};
  rastercheck_answer answer{sizeof answer, RASTERCHECK_VISIBLE, message_.as<char>(), kMessageSize,
                            0};
  const auto check = [&]() -> Result<void> {
    if (message_.is_front_whole()) return {};
    return foreign.fail("query() wrote before the beginning of answer->message");
  };
  const Result<void> called = foreign([&] { return plugin.query(&query, &answer); }, check);
  if (!called) return tl::unexpected(called.error());
  if (answer.visibility > RASTERCHECK_OCCLUDED) {
    return foreign.fail(
        fmt::format("query() wrote {} to answer->visibility, which is neither "
                    "RASTERCHECK_VISIBLE nor RASTERCHECK_OCCLUDED",
                    answer.visibility));
  }
  return answer.visibility == RASTERCHECK_OCCLUDED;
}

}  // namespace rastercheck::backends
