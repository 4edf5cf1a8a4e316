#include "properties/choices.h"

#include <bit>
#include <string>

#include "cases/digest.h"

namespace rastercheck::properties {
namespace {

class Hash {
 public:
  void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) {
      bytes_.push_back(static_cast<char>(number >> shift & 0xffU));
    }
  }
  /// Hashes −0 as +0.
  void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number + 0.0F)}); }
  std::uint64_t value() const { return cases::fnv1a(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace

std::uint64_t choices_of(const cases::Case& c) {
  if (c.choices) return *c.choices;
  Hash hash;
  hash.add(static_cast<std::uint64_t>(c.framebuffer.width));
  hash.add(static_cast<std::uint64_t>(c.framebuffer.height));
  for (const cases::ClipVertex& p : c.positions) {
    for (const float part : {p.x, p.y, p.z, p.w}) hash.add(part);
  }
  for (const float value : c.attribute_values) hash.add(value);
  for (const cases::Triangle& triangle : c.triangles) {
    for (const std::uint32_t vertex : triangle) hash.add(std::uint64_t{vertex});
  }
  return hash.value();
}

}  // namespace rastercheck::properties
