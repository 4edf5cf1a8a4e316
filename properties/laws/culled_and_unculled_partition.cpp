// Culled and unculled partition: a drawing with back faces culled and one with front faces culled
// together equal the drawing without culling, bit for bit, and no triangle is in both. If front
// faces get the other orientation, the two drawings change places, and the drawing without culling
// stays the same.
//
// Why. A triangle's facing is the sign of its determinant, computed from the positions that the
// basis names and compared with the orientation of front faces. The sign is the same for the whole
// triangle, whatever part of it is visible, clipped or behind the eye (RULES §1). So exactly one of
// the two drawings has each triangle with an area, and a triangle without area covers nothing.
// Culling decides only whether a triangle is drawn: a fragment's place and values do not depend on
// it. If a contract leaves a triangle's facing open, the facing must still be the same in all
// drawings.
//
// Samples: all samples of every triangle, with values and derivatives. The depth test is removed,
// since what it hides depends on which triangles remain.

#include <cstdint>
#include <set>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/same_drawing.h"

namespace rastercheck::properties::culled_and_unculled_partition_law {
namespace {

using records::FragmentClass;

cases::FrontFace turned_round(cases::FrontFace face) {
  return face == cases::FrontFace::ccw ? cases::FrontFace::cw : cases::FrontFace::ccw;
}

/// Draws the case with a given culling, and with front faces as they are or reversed.
class Drawings {
 public:
  Drawings(const cases::Case& c, backends::Backend& backend) : case_(c), backend_(&backend) {
    case_.depth_test = cases::DepthTest::none;
  }

  Result<cases::Fragments> draw_with(cases::Cull cull, bool is_turned_round) const {
    cases::Case changed = case_;
    changed.cull = cull;
    if (is_turned_round) changed.front_face = turned_round(changed.front_face);
    return backends::fragments_of(draw_promised(changed, *backend_));
  }
  const cases::Case& source() const { return case_; }

 private:
  cases::Case case_;
  backends::Backend* backend_;
};

void append(cases::Fragments& to, const cases::Fragments& from) {
  const auto add = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(to.triangle, from.triangle);
  add(to.x, from.x);
  add(to.y, from.y);
  add(to.sample, from.sample);
  add(to.depth, from.depth);
  add(to.attributes, from.attributes);
  add(to.derivatives, from.derivatives);
}

/// Reports each triangle with fragments in both drawings, once.
void find_shared(const cases::Fragments& of_fronts, const cases::Fragments& of_backs,
                 Check& check) {
  const std::set<std::uint32_t> fronts(of_fronts.triangle.begin(), of_fronts.triangle.end());
  std::set<std::uint32_t> reported;
  for (std::size_t i = 0; i < of_backs.size(); ++i) {
    const cases::SamplePlace place = of_backs.place_of(i);
    if (!fronts.contains(place.triangle) || !reported.insert(place.triangle).second) continue;
    add_violation(
        check,
        violation_at(place, FragmentClass::extra,
                     "forbidden: part of this triangle is also drawn when back faces are culled",
                     "drawn with front faces culled"));
  }
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  using cases::Cull;
  const Drawings drawings(clip, backend);
  const cases::Case& source = drawings.source();
  const Result<cases::Fragments> all = drawings.draw_with(Cull::none, false);
  if (!all) return tl::unexpected(all.error());
  const Result<cases::Fragments> fronts = drawings.draw_with(Cull::back, false);
  if (!fronts) return tl::unexpected(fronts.error());
  const Result<cases::Fragments> backs = drawings.draw_with(Cull::front, false);
  if (!backs) return tl::unexpected(backs.error());
  cases::Fragments both = *fronts;
  append(both, *backs);
  Check check =
      compare_drawings(source, *all, both,
                       "the drawings with back faces culled and with front faces culled, combined");
  find_shared(*fronts, *backs, check);
  if (fronts->size() > 0) add_label(check, "front faces");
  if (backs->size() > 0) add_label(check, "back faces");
  if (fronts->size() > 0 && backs->size() > 0) add_label(check, "both");

  struct Turned {
    Cull cull;
    const cases::Fragments* expected;
    const char* note;
  };
  for (const Turned& turned :
       {Turned{Cull::none, &*all, "the definition of front faces reversed, without culling"},
        Turned{Cull::front, &*fronts, "the definition of front faces reversed, front faces culled"},
        Turned{Cull::back, &*backs, "the definition of front faces reversed, back faces culled"}}) {
    const Result<cases::Fragments> drawn = drawings.draw_with(turned.cull, true);
    if (!drawn) return tl::unexpected(drawn.error());
    merge(check, compare_drawings(source, *turned.expected, *drawn, turned.note));
  }
  return check;
}

/// Makes cases with triangles of both orientations.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  const std::size_t count = c.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const cases::Triangle turned{c.triangles[i][1], c.triangles[i][0], c.triangles[i][2]};
    switch (draw.between(0, 3)) {
      case 0:
        c.triangles[i] = turned;
        break;
      case 1:  // visible from both sides
        if (count <= 8) c.triangles.push_back(turned);
        break;
      default:
        break;
    }
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "culled-and-unculled-partition",
     .sentence = "culled and unculled partition",
     .reason = "A triangle with an area has one facing, and culling decides of nothing but "
               "whether it is drawn.",
     .exceptions = "depth tests, which are taken away; backends that promise no invariance",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_invariantly,
     .unpromised = "the backend does not promise that irrelevant changes leave all bits unchanged",
     .excludes_outer = true,
     .covers = {cover(20, "both"), cover(30, "front faces"), cover(30, "back faces"),
                cover(10, "clipped"), cover(5, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::culled_and_unculled_partition_law
