// Each common fault, put into `cpu`, is found and named; backends that are merely coarse or off are
// accused of nothing.

#include "properties/probing/common_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "backends/factory.h"
#include "properties/probing/probe.h"
#include "tests/properties/probing/bent.h"

namespace rastercheck::properties::common_faults_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Fragments;
using cases::Snapping;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The faults of a backend. The probe ends before its first measure, whatever it finds.
std::vector<records::DrawingFault> faults_of(backends::Backend& backend) {
  Subject subject("bent", backend, {});
  EXPECT_TRUE(subject.choose_rules().has_value());
  find_common_faults(subject);
  return subject.result.faults;
}

std::vector<std::string> ids_of(const std::vector<records::DrawingFault>& faults) {
  std::vector<std::string> ids;
  for (const records::DrawingFault& fault : faults) ids.push_back(fault.id);
  return ids;
}

// ---- Ways to go wrong.

/// Draws each case changed.
Bending drawing(void (*change)(Case& c)) {
  Bending bending;
  bending.before = [change](Case c) {
    change(c);
    return c;
  };
  return bending;
}

/// Changes each drawing.
Bending drawn(void (*change)(Fragments& drawn)) {
  Bending bending;
  bending.after = change;
  return bending;
}

Bending with_depth(float (*depth)(float right)) {
  Bending bending;
  bending.after = [depth](Fragments& drawn) {
    for (float& one : drawn.depth) one = depth(one);
  };
  return bending;
}

float with_bytes_reversed(float value) {
  auto bytes = std::bit_cast<std::array<std::uint8_t, 4>>(value);
  std::swap(bytes[0], bytes[3]);
  std::swap(bytes[1], bytes[2]);
  return std::bit_cast<float>(bytes);
}

void turn_upside_down(Case& c) {
  for (ClipVertex& p : c.positions) p.y = -p.y;
}

void mirror(Case& c) {
  for (ClipVertex& p : c.positions) p.x = -p.x;
}

/// Takes vertices' attribute values from other vertices of the triangle; the triangles must not
/// share vertices.
void turn_attributes(Case& c) {
  const std::vector<float> before = c.attribute_values;
  const std::size_t count = c.attributes.size();
  for (const cases::Triangle& t : c.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t a = 0; a < count; ++a) {
        c.attribute_values[t[i] * count + a] = before[t[(i + 1) % 3] * count + a];
      }
    }
  }
}

void exchange_attributes(Case& c) {
  const std::size_t count = c.attributes.size();
  if (count < 2) return;
  for (std::size_t i = 0; i < c.attribute_values.size(); i += count) {
    std::swap(c.attribute_values[i], c.attribute_values[i + 1]);
  }
}

/// Leaves out triangles with less than this area in a 64×64 viewport, in pixels².
void drop_below(Case& c, double least) {
  for (cases::Triangle& t : c.triangles) {
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = 32 * double{c.positions[t[i]].x} / double{c.positions[t[i]].w};
      y[i] = 32 * double{c.positions[t[i]].y} / double{c.positions[t[i]].w};
    }
    const double area = ((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])) / 2;
    if (std::abs(area) < least) t = {t[0], t[0], t[0]};
  }
}

/// A backend whose triangles own all samples on their edges: draws each case a second time, turned
/// by 180 degrees, whose edges own the other samples, and turns that drawing back.
class Inclusive : public backends::Backend {
 public:
  cases::Contract promise(const Case& c) const override {
    cases::Contract contract = cases::contract_of(c);
    contract.tie_rule = tie_rule;
    return contract;
  }
  cases::TieRule tie_rule = cases::TieRule::top_left;

 private:
  Result<Fragments> draw_fragments(const Case& c) override {
    Result<backends::Drawn> own = cpu_->draw(c);
    if (!own) return tl::unexpected(own.error());
    Case turned = c;
    turn_upside_down(turned);
    mirror(turned);
    Result<backends::Drawn> other = cpu_->draw(turned);
    if (!other) return tl::unexpected(other.error());
    Fragments& drawn = own->fragments;
    const Fragments& more = other->fragments;
    std::vector<std::array<std::uint32_t, 3>> known;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      known.push_back({drawn.triangle[i], drawn.y[i], drawn.x[i]});
    }
    for (std::size_t i = 0; i < more.size(); ++i) {
      const std::array<std::uint32_t, 3> place{
          more.triangle[i], static_cast<std::uint32_t>(c.framebuffer.height) - 1 - more.y[i],
          static_cast<std::uint32_t>(c.framebuffer.width) - 1 - more.x[i]};
      if (std::binary_search(known.begin(), known.end(), place)) continue;
      drawn.triangle.push_back(place[0]);
      drawn.y.push_back(static_cast<std::uint16_t>(place[1]));
      drawn.x.push_back(static_cast<std::uint16_t>(place[2]));
      drawn.sample.push_back(0);
      drawn.depth.push_back(more.depth[i]);
      const auto values = more.attributes_of(i);
      drawn.attributes.insert(drawn.attributes.end(), values.begin(), values.end());
    }
    drawn.derivatives.clear();
    return std::move(own->fragments);
  }

  std::unique_ptr<backends::Backend> cpu_ = std::move(*backends::make_backend("cpu"));
};

// ---- Each fault.

struct Fault {
  const char* id;
  Bending bending;
  const char* sentence;
};
std::ostream& operator<<(std::ostream& stream, const Fault& fault) { return stream << fault.id; }

class CommonFault : public ::testing::TestWithParam<Fault> {};

TEST_P(CommonFault, IsNamed) {
  Bent backend(GetParam().bending);
  const std::vector<records::DrawingFault> found = faults_of(backend);
  ASSERT_THAT(ids_of(found), ElementsAre(GetParam().id));
  EXPECT_EQ(found[0].sentence, GetParam().sentence);
  EXPECT_GE(found[0].sureness.in_favour, 16U);
  EXPECT_LE(50 * found[0].sureness.against, found[0].sureness.in_favour);
}

std::vector<Fault> all_faults() {
  return {
      {"draws-nothing", drawing([](Case& c) {
         c.triangles.assign(c.triangles.size(), {0, 0, 0});
       }),
       "It draws nothing: not one sample of 48 triangles of 120 pixels² or more."},
      {"upside-down", drawing(&turn_upside_down),
       "The picture is upside down: NDC y = -1 belongs to row 0."},
      {"mirrored", drawing(&mirror),
       "The picture is mirrored left to right: NDC x = -1 belongs to column 0."},
      {"transposed", drawing([](Case& c) {
         for (ClipVertex& p : c.positions) std::swap(p.x, p.y);
       }),
       "The picture is transposed: x and y are exchanged."},
      {"moved", drawing([](Case& c) { c.viewport.x += 0.5F; }),
       "Everything is drawn half a pixel too far right; samples lie at the centres of pixels."},
      {"moved", drawing([](Case& c) {
         c.viewport.x -= 0.5F;
         c.viewport.y -= 0.5F;
       }),
       "Everything is drawn half a pixel too far left and half a pixel too far up; samples lie at "
       "the centres of pixels."},
      {"moved", drawing([](Case& c) { c.viewport.y += 1; }),
       "Everything is drawn a pixel too far down; samples lie at the centres of pixels."},
      {"small-viewport", drawing([](Case& c) {
         c.viewport.width -= 1;
         c.viewport.height -= 1;
       }),
       "The viewport is a pixel too small in x and y: NDC from -1 to 1 must span all 64 pixels, "
       "not "
       "63."},
      {"small-viewport", drawing([](Case& c) { c.viewport.height -= 1; }),
       "The viewport is a pixel too small in y: NDC from -1 to 1 must span all 64 pixels, not 63."},
      {"culls-a-side", drawing([](Case& c) { c.cull = cases::Cull::back; }),
       "Triangles that run clockwise are left out, though no culling is asked for."},
      {"culls-a-side", drawing([](Case& c) { c.cull = cases::Cull::front; }),
       "Triangles that run counter-clockwise are left out, though no culling is asked for."},
      {"depth-signed", with_depth([](float d) { return 2 * d - 1; }),
       "Depth runs from -1 to 1, not from 0 to 1."},
      {"depth-halved", with_depth([](float d) { return (d + 1) / 2; }),
       "Depth runs from 1/2 to 1, not from 0 to 1: z/w is mapped by (z/w + 1) / 2 once too often."},
      {"depth-reversed", with_depth([](float d) { return 1 - d; }),
       "Depth is reversed: 1 is nearest and 0 farthest."},
      {"depth-constant", with_depth([](float /*d*/) { return 0.25F; }),
       "Depth is 0.25 everywhere."},
      {"depth-bytes", with_depth(&with_bytes_reversed),
       "The bytes of depths are in reverse order."},
      {"attributes-of-other-vertices", drawing(&turn_attributes),
       "Attributes are those of other vertices: vertices 0, 1 and 2 of a triangle get the values "
       "of "
       "vertices 1, 2 and 0."},
      {"attributes-in-another-order", drawing(&exchange_attributes),
       "Attributes are in another order: attribute 0 has the values of 1, 1 has the values of 0."},
      {"attribute-bytes", drawn([](Fragments& drawn) {
         for (float& value : drawn.attributes) value = with_bytes_reversed(value);
       }),
       "The bytes of attributes are in reverse order: float32 of the other endianness."},
      {"drops-small-triangles", drawing([](Case& c) { drop_below(c, 0.5); }),
       "Triangles with an area up to about 0.47 pixels² are left out, though they contain "
       "samples."},
      {"drops-small-triangles", drawing([](Case& c) { drop_below(c, 2.25); }),
       "Triangles with an area up to about 2 pixels² are left out, though they contain samples."},
  };
}
INSTANTIATE_TEST_SUITE_P(All, CommonFault, ::testing::ValuesIn(all_faults()));

TEST(CommonFaults, InclusiveEdgesAreNamed) {
  Inclusive backend;
  const std::vector<records::DrawingFault> found = faults_of(backend);
  ASSERT_THAT(ids_of(found), ElementsAre("inclusive-edges"));
  EXPECT_EQ(found[0].sentence,
            "Samples exactly on a shared edge are drawn by both triangles, not by one.");
}

// A contract may say that every edge owns its samples: then it is a row, not the end. One that only
// leaves ties open still promises that one of two neighbours draws a sample.
TEST(CommonFaults, ArePermittedByContracts) {
  Inclusive open;
  open.tie_rule = cases::TieRule::unspecified;
  EXPECT_THAT(ids_of(faults_of(open)), ElementsAre("inclusive-edges"));
  Inclusive backend;
  backend.tie_rule = cases::TieRule::all;
  Subject subject("bent", backend, {});
  ASSERT_TRUE(subject.choose_rules().has_value());
  find_common_faults(subject);
  EXPECT_THAT(subject.result.faults, IsEmpty());
  ASSERT_THAT(subject.result.rows, SizeIs(1));
  EXPECT_EQ(subject.result.rows[0].what, "samples on edges");
  EXPECT_EQ(subject.result.rows[0].declared, "permitted");
}

TEST(CommonFaults, AMoveWithinThePositionErrorIsPermitted) {
  Bent backend(drawing([](Case& c) { c.viewport.x += 0.5F; }));
  backend.declares = [](cases::Contract& contract) {
    contract.coverage = Snapping{8, cases::Rounding::unspecified, 128};
  };
  EXPECT_THAT(faults_of(backend), IsEmpty());
}

TEST(CommonFaults, AreAllNamedWhereSeveralAreVisible) {
  Bending bending = drawing([](Case& c) {
    turn_upside_down(c);
    c.viewport.x += 0.5F;
    c.cull = cases::Cull::back;
    exchange_attributes(c);
  });
  bending.after = [](Fragments& drawn) {
    for (float& depth : drawn.depth) depth = 1 - depth;
  };
  Bent backend(bending);
  EXPECT_THAT(ids_of(faults_of(backend)),
              ElementsAre("upside-down", "moved", "culls-a-side", "attributes-in-another-order",
                          "depth-reversed"));
}

TEST(CommonFaults, AreNamedOfBackendsWithFewAbilities) {
  class OnlyOpenGl : public Bent {
   public:
    OnlyOpenGl() : Bent(drawing(&turn_upside_down)) {}
    backends::About about() const override {
      backends::About about;
      about.capabilities.rules = {cases::Rules::opengl};
      about.capabilities.lacks = {cases::Feature::smooth, cases::Feature::noperspective};
      return about;
    }
  };
  OnlyOpenGl backend;
  EXPECT_THAT(ids_of(faults_of(backend)), ElementsAre("upside-down"));
}

// Nothing is measured after a fault, and there is no contract.
TEST(CommonFaults, EndTheProbe) {
  Bent backend(drawing(&mirror));
  const Result<records::Probe> result = probe("bent", backend, {}, {});
  ASSERT_TRUE(result.has_value());
  EXPECT_THAT(result->faults, SizeIs(1));
  EXPECT_THAT(result->rows, IsEmpty());
  EXPECT_EQ(result->terms, cases::ContractTerms());
}

// ---- Backends without a fault.

/// Moves each vertex by up to `most` pixels along each axis, always by the same for the same
/// vertex, in a viewport of 64 pixels.
Bending displaced(float most, int bits) {
  Bending bending;
  bending.before = [most, bits](Case c) {
    c.coverage = Snapping{bits};
    c.basis = cases::Basis::snapped;
    for (ClipVertex& p : c.positions) {
      const auto hash = [&p](float salt) {
        const float mixed = std::sin(p.x * 127.1F + p.y * 311.7F + salt) * 43758.547F;
        return 2 * (mixed - std::floor(mixed)) - 1;
      };
      const float x = hash(0);
      const float y = hash(74.7F);
      p.x += most * x / 32 * p.w;
      p.y += most * y / 32 * p.w;
    }
    return c;
  };
  return bending;
}

struct Honest {
  const char* name;
  Bending bending;
};
std::ostream& operator<<(std::ostream& stream, const Honest& honest) {
  return stream << honest.name;
}

class HonestBackend : public ::testing::TestWithParam<Honest> {};

TEST_P(HonestBackend, IsAccusedOfNothing) {
  Bent backend(GetParam().bending);
  EXPECT_THAT(ids_of(faults_of(backend)), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    All, HonestBackend,
    ::testing::Values(
        Honest{"exact", {}}, Honest{"whole pixels", displaced(0, 0)},
        Honest{"half pixels", displaced(0, 1)}, Honest{"quarters of pixels", displaced(0, 2)},
        Honest{"16 points a pixel, off by one", displaced(1.0F / 16, 4)},
        Honest{"off by a quarter of a pixel", displaced(0.25F, 8)},
        Honest{"off by half a pixel", displaced(0.5F, 8)},
        Honest{"off by a pixel", displaced(1, 8)},
        Honest{"all moved by a sixteenth", drawing([](Case& c) { c.viewport.x += 1.0F / 16; })},
        Honest{"all moved by a quarter", drawing([](Case& c) { c.viewport.y += 0.25F; })},
        Honest{"ties to other edges",
               drawing([](Case& c) { c.fill_rule = cases::TieRule::bottom_left; })}));

std::vector<std::string> own_backends() {
  std::vector<std::string> all{"cpu", "cpu:precision=float32"};
  for (const backends::Listing& listing : backends::BackendFactory().list()) {
    if (listing.specification.starts_with("method:")) all.push_back(listing.specification);
  }
  return all;
}

class OwnBackend : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnBackend, IsAccusedOfNothing) {
  const auto backend = backends::make_backend(GetParam());
  ASSERT_TRUE(backend.has_value());
  EXPECT_THAT(ids_of(faults_of(**backend)), IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(All, OwnBackend, ::testing::ValuesIn(own_backends()));

}  // namespace
}  // namespace rastercheck::properties::common_faults_test
