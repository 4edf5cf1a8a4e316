#include "tests/mutants/overlaid_backend.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace rastercheck::mutants {
namespace {

using cases::Fragments;

bool has_same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Copies to `all` the numbers in which a damaged drawing differs from the right one.
void take_over(const std::vector<float>& right, const std::vector<float>& damaged,
               std::vector<float>& all) {
  for (std::size_t i = 0; i < right.size() && i < damaged.size() && i < all.size(); ++i) {
    if (!has_same_bits(right[i], damaged[i])) all[i] = damaged[i];
  }
}

/// A fragment's numbers: its depth, attributes and derivatives.
std::vector<float> numbers_at(const Fragments& drawn, std::size_t i) {
  std::vector<float> numbers{drawn.depth[i]};
  const auto attributes = drawn.attributes_of(i);
  numbers.insert(numbers.end(), attributes.begin(), attributes.end());
  if (drawn.derivatives.empty()) return numbers;
  const auto derivatives = drawn.derivatives_of(i);
  numbers.insert(numbers.end(), derivatives.begin(), derivatives.end());
  return numbers;
}

/// The fragments' numbers by place, and by index among the fragments at that place.
using Placed = std::map<std::pair<cases::SamplePlace, int>, std::vector<float>>;

Placed placed(const Fragments& drawn) {
  Placed all;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    int which = 0;
    while (all.contains({drawn.place_of(i), which})) ++which;
    all[{drawn.place_of(i), which}] = numbers_at(drawn, i);
  }
  return all;
}

Fragments fragments_of(const Placed& all, std::size_t attribute_count) {
  Fragments drawn;
  drawn.attribute_count = attribute_count;
  for (const auto& [key, numbers] : all) {
    const cases::SamplePlace& place = key.first;
    drawn.triangle.push_back(place.triangle);
    drawn.x.push_back(static_cast<std::uint16_t>(place.x));
    drawn.y.push_back(static_cast<std::uint16_t>(place.y));
    drawn.sample.push_back(static_cast<std::uint8_t>(place.sample));
    drawn.depth.push_back(numbers[0]);
    const auto end = numbers.begin() + 1 + static_cast<std::ptrdiff_t>(attribute_count);
    drawn.attributes.insert(drawn.attributes.end(), numbers.begin() + 1, end);
    drawn.derivatives.insert(drawn.derivatives.end(), end, numbers.end());
  }
  return drawn;
}

void overlay_fragments(const Fragments& right, const Fragments& damaged, Fragments& all) {
  const Placed of_right = placed(right);
  const Placed of_damaged = placed(damaged);
  Placed of_all = placed(all);
  for (const auto& [place, numbers] : of_right) {
    if (!of_damaged.contains(place)) of_all.erase(place);
  }
  for (const auto& [place, numbers] : of_damaged) {
    const auto before = of_right.find(place);
    if (before == of_right.end()) {
      of_all[place] = numbers;
    } else if (const auto now = of_all.find(place); now != of_all.end()) {
      take_over(before->second, numbers, now->second);
    }
  }
  all = fragments_of(of_all, right.attribute_count);
}

void overlay_picture(const cases::Picture& right, const cases::Picture& damaged,
                     cases::Picture& all) {
  take_over(right.color, damaged.color, all.color);
  take_over(right.depth, damaged.depth, all.depth);
}

template <typename Vectors>
void overlay_vectors(const Vectors& right, const Vectors& damaged, Vectors& all) {
  using Vector = typename Vectors::value_type;
  constexpr std::size_t kCount = sizeof(Vector) / sizeof(float);
  using Numbers = std::array<float, kCount>;
  for (std::size_t i = 0; i < right.size() && i < damaged.size(); ++i) {
    const auto before = std::bit_cast<Numbers>(right[i]);
    const auto after = std::bit_cast<Numbers>(damaged[i]);
    auto now = std::bit_cast<Numbers>(all[i]);
    for (std::size_t k = 0; k < kCount; ++k) {
      if (!has_same_bits(before[k], after[k])) now[k] = after[k];
    }
    all[i] = std::bit_cast<Vector>(now);
  }
}

}  // namespace

OverlaidBackend::OverlaidBackend(std::unique_ptr<backends::Backend> unharmed,
                                 std::vector<std::unique_ptr<backends::Backend>> damaged)
    : unharmed_(std::move(unharmed)), damaged_(std::move(damaged)) {}

template <typename Ask, typename Overlay>
auto OverlaidBackend::overlaid(const Ask& ask, const Overlay& overlay) -> decltype(ask(*this)) {
  const auto right = ask(*unharmed_);
  if (!right) return right;
  auto all = *right;
  for (const auto& one : damaged_) {
    const auto damaged = ask(*one);
    if (!damaged) return damaged;
    overlay(*right, *damaged, all);
  }
  return all;
}

Result<Fragments> OverlaidBackend::draw_fragments(const cases::Case& c) {
  return overlaid([&c](backends::Backend& of) { return of.draw_unjudged(c); }, &overlay_fragments);
}

Result<cases::Picture> OverlaidBackend::draw_picture(const cases::Case& c,
                                                     const cases::Pipeline& pipeline) {
  return overlaid(
      [&](backends::Backend& of) { return of.picture_drawer()->draw_picture(c, pipeline); },
      &overlay_picture);
}

Result<void> OverlaidBackend::draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                                        cases::Picture& picture) {
  return overlaid(
             [&](backends::Backend& of) -> Result<cases::Picture> {
               cases::Picture over = picture;
               return of.picture_continuer()->draw_over(c, pipeline, over).map([&] {
                 return over;
               });
             },
             &overlay_picture)
      .map([&picture](cases::Picture&& drawn) { picture = std::move(drawn); });
}

Result<Fragments> OverlaidBackend::draw_assembled(const cases::Case& c, cases::Topology topology,
                                                  std::span<const std::uint32_t> indices) {
  return overlaid(
      [&](backends::Backend& of) { return of.assembler()->draw_assembled(c, topology, indices); },
      &overlay_fragments);
}

Result<bool> OverlaidBackend::is_occluded(const cases::Case& c, std::size_t occluders) {
  return overlaid(
      [&](backends::Backend& of) { return of.occlusion_culler()->is_occluded(c, occluders); },
      [](bool right, bool damaged, bool& answer) {
        if (damaged != right) answer = damaged;
      });
}

Result<std::vector<cases::ClipVertex>> OverlaidBackend::transform(const cases::Case& c) {
  return overlaid([&c](backends::Backend& of) { return of.vertex_stage()->transform(c); },
                  &overlay_vectors<std::vector<cases::ClipVertex>>);
}

Result<std::vector<cases::Normal>> OverlaidBackend::transform_normals(
    const cases::Matrix4& model, std::span<const cases::Normal> normals) {
  return overlaid(
      [&](backends::Backend& of) { return of.vertex_stage()->transform_normals(model, normals); },
      &overlay_vectors<std::vector<cases::Normal>>);
}

}  // namespace rastercheck::mutants
