#include "cases/fragment_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rastercheck::cases {
namespace {

bool is_beyond(std::uint32_t index, auto count) {
  return index >= static_cast<std::uint32_t>(count);
}

/// Appends a fragment without derivatives.
void append(Fragments& to, const SamplePlace& at, float depth, std::span<const float> attributes) {
  to.triangle.push_back(at.triangle);
  to.x.push_back(static_cast<std::uint16_t>(at.x));
  to.y.push_back(static_cast<std::uint16_t>(at.y));
  to.sample.push_back(static_cast<std::uint8_t>(at.sample));
  to.depth.push_back(depth);
  to.attributes.insert(to.attributes.end(), attributes.begin(), attributes.end());
}

void reserve_more(auto& numbers, std::size_t more) {
  const std::size_t needed = numbers.size() + more;
  // At least doubles, so that many small reservations do not copy everything each time.
  if (needed > numbers.capacity()) numbers.reserve(std::max(needed, 2 * numbers.capacity()));
}

void reserve_fragments(Fragments& fragments, std::size_t more) {
  reserve_more(fragments.triangle, more);
  reserve_more(fragments.x, more);
  reserve_more(fragments.y, more);
  reserve_more(fragments.sample, more);
  reserve_more(fragments.depth, more);
  reserve_more(fragments.attributes, more * fragments.attribute_count);
}

}  // namespace

FragmentCollector::FragmentCollector(const Case& c) : case_(c) {
  added_.attribute_count = c.attributes.size();
}

void FragmentCollector::reserve(std::size_t fragments) { reserve_fragments(added_, fragments); }

std::string FragmentCollector::fault_of(const SamplePlace& at, std::size_t attributes) const {
  const FramebufferSize& size = case_.framebuffer;
  if (is_beyond(at.triangle, case_.triangles.size())) {
    return fmt::format("triangle {} of {}", at.triangle, case_.triangles.size());
  }
  if (is_beyond(at.x, size.width) || is_beyond(at.y, size.height) ||
      is_beyond(at.sample, size.samples)) {
    return fmt::format("pixel {}, {}, sample {} of {} x {} pixels, {} samples", at.x, at.y,
                       at.sample, size.width, size.height, size.samples);
  }
  if (attributes != case_.attributes.size()) {
    return fmt::format("{} attributes of {}", attributes, case_.attributes.size());
  }
  return {};
}

std::string FragmentCollector::add(const SamplePlace& at, float depth,
                                   std::span<const float> attributes) {
  if (std::string fault = fault_of(at, attributes.size()); !fault.empty()) return fault;
  if (is_in_order_ && added_.size() > 0) {
    is_in_order_ = added_.place_of(added_.size() - 1) < at;
  }
  append(added_, at, depth, attributes);
  return {};
}

tl::expected<Fragments, std::string> FragmentCollector::take() {
  if (!is_in_order_) return take_sorted();
  return std::move(added_);
}

tl::expected<Fragments, std::string> FragmentCollector::take_sorted() {
  std::vector<std::size_t> order(added_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
    return added_.place_of(a) < added_.place_of(b);
  });
  Fragments sorted;
  sorted.attribute_count = added_.attribute_count;
  reserve_fragments(sorted, order.size());
  for (const std::size_t i : order) {
    const SamplePlace at = added_.place_of(i);
    if (sorted.size() > 0 && sorted.place_of(sorted.size() - 1) == at) {
      return tl::unexpected(fmt::format("pixel {}, {}, sample {} has two fragments of triangle {}",
                                        at.x, at.y, at.sample, at.triangle));
    }
    append(sorted, at, added_.depth[i], added_.attributes_of(i));
  }
  return sorted;
}

}  // namespace rastercheck::cases
