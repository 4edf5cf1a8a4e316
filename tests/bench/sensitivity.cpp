// Measures which defects the judge notices under each promise of a driver: docs/sensitivity.md.
//
//   rastercheck-sensitivity [FRAMES]
//
// draws FRAMES frames of each kind exactly, adds each defect to each drawing
// (properties/campaign/sabotage.h), and prints in how many drawings each contract lets the judge
// notice the defect.

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>

#include "backends/api_promise.h"
#include "backends/factory.h"
#include "cases/driver_promise.h"
#include "properties/campaign/sabotage.h"

namespace {

using rastercheck::backends::api_promise;
using rastercheck::backends::Backend;
using rastercheck::cases::Case;
using rastercheck::cases::ClipCase;
using rastercheck::cases::ClipVertex;
using rastercheck::cases::Contract;
using rastercheck::cases::DriverPromise;
using rastercheck::cases::Fragments;
using rastercheck::properties::Drawing;
using rastercheck::properties::has_wrong;
using rastercheck::properties::Sabotage;
using rastercheck::properties::sabotages;
using rastercheck::records::Defect;

constexpr int kSubpixelBits = 8;

class Frames {
 public:
  /// A number from 0 to 1.
  float unit() { return static_cast<float>(random_() >> 8U) * 0x1p-24F; }
  float between(float least, float most) { return least + (most - least) * unit(); }

  /// An empty frame with two attributes.
  static Case empty(int size, int samples) {
    Case c;
    c.framebuffer = {size, size, samples};
    c.viewport = {0, 0, static_cast<float>(size), static_cast<float>(size), 0, 1};
    c.rules = rastercheck::cases::Rules::vulkan;
    c.attributes = {{"r"}, {"s", rastercheck::cases::Interpolation::noperspective}};
    return c;
  }

  /// Adds a vertex at a place of the window, in pixels.
  std::uint32_t add(Case& c, float x, float y, float most_w) {
    const float w = between(1, most_w);
    const auto size = static_cast<float>(c.framebuffer.width);
    c.positions.push_back(
        {(2 * x / size - 1) * w, (2 * y / size - 1) * w, between(0.25F, 0.75F) * w, w});
    c.attribute_values.push_back(between(0.25F, 1));
    c.attribute_values.push_back(between(0.25F, 1));
    return static_cast<std::uint32_t>(c.positions.size() - 1);
  }

  /// Triangles with legs of `least` to `most` pixels.
  Case triangles(int size, int samples, float least, float most, int count, float most_w) {
    Case c = empty(size, samples);
    for (int t = 0; t < count; ++t) {
      const float leg = between(least, most);
      const float x = between(0, static_cast<float>(size) - leg);
      const float y = between(0, static_cast<float>(size) - leg);
      const float slant = between(0, leg);
      const std::uint32_t a = add(c, x, y, most_w);
      const std::uint32_t b = add(c, x + leg, y + slant / 2, most_w);
      const std::uint32_t d = add(c, x + slant, y + leg, most_w);
      c.triangles.push_back({a, b, d});
    }
    return c;
  }

  /// A net of 3 × 3 cells, in which pairs of triangles share the inner edges.
  Case net(int size, float most_w) {
    Case c = empty(size, 1);
    const float cell = static_cast<float>(size) / 3;
    for (int y = 0; y <= 3; ++y) {
      for (int x = 0; x <= 3; ++x) {
        const auto at = [&](int i) {
          const float place = static_cast<float>(i) * cell;
          return i == 0 || i == 3 ? place : place + between(-0.3F, 0.3F) * cell;
        };
        add(c, at(x), at(y), most_w);
      }
    }
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 3; ++x) {
        const std::uint32_t a = y * 4 + x;
        c.triangles.push_back({a, a + 1, a + 5});
        c.triangles.push_back({a, a + 5, a + 4});
      }
    }
    return c;
  }

 private:
  std::mt19937 random_{1};
};

constexpr std::array<std::string_view, 4> kKinds{"ordinary", "small in a large window", "4 samples",
                                                 "shared edges"};

Case frame_of(Frames& frames, std::size_t kind, float most_w) {
  switch (kind) {
    case 0:
      return frames.triangles(40, 1, 12, 30, 2, most_w);
    case 1:
      return frames.triangles(1024, 1, 4, 32, 4, most_w);
    case 2:
      return frames.triangles(24, 4, 8, 20, 2, most_w);
    default:
      return frames.net(36, most_w);
  }
}

constexpr std::array<std::string_view, 4> kContracts{"ieee", "conformance", "spec", "exact"};

Contract contract_of(const Case& c, std::size_t contract) {
  constexpr std::array<DriverPromise, 3> kPromises{DriverPromise::ieee, DriverPromise::conformance,
                                                   DriverPromise::spec};
  if (contract < kPromises.size()) return api_promise(c, {kSubpixelBits}, kPromises[contract]);
  return rastercheck::cases::contract_of(c);
}

struct Row {
  int frames = 0;
  std::array<int, kContracts.size()> noticed{};
  std::array<int, kKinds.size()> of_kind{};
  std::array<int, kKinds.size()> by_ieee{};
};

std::string share(int noticed, int frames) {
  return frames == 0 ? "–" : fmt::format("{}%", 100 * noticed / frames);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 25;
  const auto cpu = rastercheck::backends::make_backend("cpu");
  if (!cpu || count < 1) {
    fmt::print(stderr, "rastercheck-sensitivity [FRAMES]: FRAMES is a number from 1\n");
    return 2;
  }
  Backend& backend = **cpu;
  const auto draw = [&backend](const Case& c) -> std::optional<Fragments> {
    auto drawn = backend.draw(c);
    if (!drawn) return std::nullopt;
    return std::move(drawn->fragments);
  };
  Frames frames;
  std::map<std::pair<Defect, std::string>, Row> rows;
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    for (int i = 0; i < count; ++i) {
      const bool is_flat = i % 2 == 0;
      const ClipCase c(frame_of(frames, kind, is_flat ? 1.1F : 4));
      const std::optional<Fragments> right = draw(c);
      if (!right) return 1;
      std::array<Contract, kContracts.size()> contracts;
      for (std::size_t k = 0; k < contracts.size(); ++k) {
        contracts[k] = contract_of(c, k);
        if (has_wrong(c, contracts[k], *right)) {
          fmt::print(stderr, "a right frame is wrong by {}\n", kContracts[k]);
          return 1;
        }
      }
      for (const Sabotage& sabotage : sabotages()) {
        const std::optional<Fragments> wrong = sabotage.apply({&c, &*right, draw});
        if (!wrong) continue;
        std::string name(to_string(sabotage.defect));
        if (sabotage.defect == Defect::values_affine)
          name += is_flat ? ", w 1 to 1.1" : ", w 1 to 4";
        Row& row = rows[{sabotage.defect, name}];
        ++row.frames;
        ++row.of_kind[kind];
        for (std::size_t k = 0; k < contracts.size(); ++k) {
          if (!has_wrong(c, contracts[k], *wrong, sabotage.changes)) continue;
          ++row.noticed[k];
          if (k == 0) ++row.by_ieee[kind];
        }
      }
    }
  }
  fmt::print("| defect | frames | ieee | conformance | spec | exact |");
  for (const std::string_view kind : kKinds) fmt::print(" ieee: {} |", kind);
  fmt::print("\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const auto& [defect, row] : rows) {
    fmt::print("| {} | {} |", defect.second, row.frames);
    for (const int noticed : row.noticed) fmt::print(" {} |", share(noticed, row.frames));
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      fmt::print(" {} |", share(row.by_ieee[kind], row.of_kind[kind]));
    }
    fmt::print("\n");
  }
}
